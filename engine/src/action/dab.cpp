// SPDX-License-Identifier: GPL-3.0-or-later
// Which level an action works at, which images are applied together, and what follows each dab.
#include "action/dab.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "action/action.h"
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
  /// `posed`: of each dab its images.
  DabOfKind(EditTarget& target, std::vector<PosedTool> posed, std::size_t images)
      : target_(target), images_(std::move(posed)), count_(images) {}

  void operator()(ActionFunction<ActionKind::stamped>* stamp) const {
    for_each_path([this](const PosedTool& tool) { return stamped_level(tool); },
                  [&](ToolPath path, int level) { stamp(target_, path, level); });
  }

  void operator()(ActionFunction<ActionKind::profiled>* lay) const {
    assert(target_.stroke_step != nullptr);
    const StrokeStart start(target_.stack, *target_.stroke_step);
    for_each_path(
        [this](const PosedTool& tool) {
          return level_of_tool(target_.stack, tool.smallest_radius_mm());
        },
        [&](ToolPath path, int level) { lay(target_, start, path, level); });
  }

  void operator()(ActionFunction<ActionKind::local>* work) {
    assert(images_.size() == count_);
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
  /// Calls apply(path, level) for each image of the joined dabs, in pieces of one level: where
  /// pressure changes the size, all of a long path is not to be as fine as its thin end.
  template <class LevelOf, class Apply>
  void for_each_path(const LevelOf& level_of, const Apply& apply) const {
    for (std::size_t image = 0; image < count_; ++image) {
      std::vector<PosedTool> path;
      int level = 0;
      for (std::size_t n = image; n < images_.size(); n += count_) {
        const int wanted = level_of(images_[n]);
        if (wanted != level && !path.empty()) {
          apply(ToolPath{path}, level);
          path.clear();
        }
        level = wanted;
        path.push_back(images_[n]);
      }
      apply(ToolPath{path}, level);
    }
  }
  /// Sharp edges and the corners of a mesh are finer than its size.
  int stamped_level(const PosedTool& tool) const {
    const Shape shape = tool.tool().shape;
    const bool is_round = shape != Shape::box && shape != Shape::mesh;
    return level_of_tool(target_.stack, tool.shrunk_radius_mm() * (is_round ? 1.0 : 0.125));
  }

  EditTarget& target_;
  std::vector<PosedTool> images_;
  std::size_t count_;  ///< of one dab
};

}  // namespace

void apply_dab(EditTarget& target, const Tool& tool, std::span<const Dab> dabs,
               std::size_t images) {
  assert(images > 0 && dabs.size() >= images && dabs.size() % images == 0);
  assert(!is_anchored(tool.action));
  std::vector<PosedTool> posed;
  for (std::size_t first = 0; first < dabs.size(); first += images) {
    // Images differ in pose only: what the first says of strength and size holds for all.
    const PosedTool tool_there(tool, dabs[first]);
    if (tool_there.strength() == 0.0 || tool_there.smallest_radius_mm() <= 0.0) continue;
    for (const Dab& dab : dabs.subspan(first, images)) posed.emplace_back(tool, dab);
  }
  if (posed.empty()) return;
  std::visit(DabOfKind(target, std::move(posed), images), function_of(tool.action));
}

bool can_be_carried(Action action) noexcept {
  switch (action) {
    case Action::grab:
    case Action::twist:
    case Action::elastic:
    case Action::slide:
      return true;
    default:
      return false;
  }
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
