// SPDX-License-Identifier: GPL-3.0-or-later
// Which level an action works at, which images are applied together, and what follows each dab.
#include "brush/dab.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "brush/action.h"
#include "edit/redistance.h"

namespace argil {
namespace {

/// Whether two images reach nodes in common, on the coarsest level that either is solved on.
bool meet(const PosedTool& a, const PosedTool& b, double margin_mm) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a.bounds_mm().min[axis] > b.bounds_mm().max[axis] + margin_mm) return false;
    if (b.bounds_mm().min[axis] > a.bounds_mm().max[axis] + margin_mm) return false;
  }
  return true;
}

/// Images that meet, directly or by others, are applied at once: one after the other they would not
/// leave a mirror image.
std::vector<std::vector<PosedTool>> groups_of(std::vector<PosedTool> images, double margin_mm) {
  std::vector<std::vector<PosedTool>> groups;
  for (PosedTool& image : images) {
    std::vector<PosedTool> group{std::move(image)};
    for (auto other = groups.begin(); other != groups.end();) {
      const bool joins = std::any_of(other->begin(), other->end(), [&](const PosedTool& member) {
        return meet(member, group.front(), margin_mm);
      });
      if (!joins) {
        ++other;
        continue;
      }
      // The image itself stays in front while others are compared with it, then goes last.
      group.insert(group.end(), other->begin(), other->end());
      other = groups.erase(other);
    }
    std::rotate(group.begin(), group.begin() + 1, group.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

/// How one dab of each kind is applied.
class DabOfKind {
 public:
  DabOfKind(EditTarget& target, std::vector<PosedTool> images)
      : target_(target), images_(std::move(images)) {}

  void operator()(ActionFunction<ActionKind::stamped>* stamp) const {
    // Sharp edges and the corners of a mesh are finer than its size.
    const Shape shape = first().tool().shape;
    const bool is_round = shape != Shape::box && shape != Shape::mesh;
    const double detail = first().shrunk_radius_mm() * (is_round ? 1.0 : 0.125);
    const int level = level_of_tool(target_.stack, detail);
    for (const PosedTool& image : images_) stamp(target_, image, level);
  }

  void operator()(ActionFunction<ActionKind::local>* work) {
    const LevelStack& stack = target_.stack;
    const int level = level_of_tool(stack, first().smallest_radius_mm());
    // Two images meet where redistancing after one would read what the other changed.
    const double margin = 2.0 * (kReach + 1) * stack.voxel_mm(stack.top());
    std::vector<Box3> reached;
    for (const PosedTool& image : images_) reached.push_back(image.bounds_mm());
    for (const auto& group : groups_of(std::move(images_), margin)) work(target_, group, level);
    flush_queue(target_, reached);
  }

  void operator()(ActionFunction<ActionKind::painted>* paint) const { paint(target_, images_); }

  void operator()(ActionFunction<ActionKind::anchored>*) const {
    assert(false);  // apply_path has them
  }

 private:
  const PosedTool& first() const { return images_.front(); }

  EditTarget& target_;
  std::vector<PosedTool> images_;
};

}  // namespace

int level_of_tool(const LevelStack& stack, double smallest_radius_mm) {
  assert(std::isfinite(smallest_radius_mm));
  int level = 0;
  while (level < stack.top() && 8.0 * stack.voxel_mm(level + 1) <= smallest_radius_mm) ++level;
  return level;
}

void apply_dab(EditTarget& target, const Tool& tool, std::span<const Dab> images) {
  assert(!images.empty() && !is_anchored(tool.action));
  std::vector<PosedTool> posed;
  for (const Dab& dab : images) posed.emplace_back(tool, dab);
  // Images differ in pose only: what the first says of strength and size holds for all.
  const PosedTool& first = posed.front();
  if (first.strength() == 0.0 || first.smallest_radius_mm() <= 0.0) return;
  std::visit(DabOfKind(target, std::move(posed)), function_of(tool.action));
}

void apply_path(EditTarget& target, const Tool& tool, std::span<const Dab> path,
                std::size_t images) {
  assert(is_anchored(tool.action) && images > 0 && path.size() % images == 0);
  const AnyActionFunction function = function_of(tool.action);
  const auto* anchored = std::get_if<ActionFunction<ActionKind::anchored>*>(&function);
  assert(anchored != nullptr);
  (*anchored)(target, tool, path, images);
}

}  // namespace argil
