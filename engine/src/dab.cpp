// SPDX-License-Identifier: GPL-3.0-or-later
#include "dab.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "action.h"
#include "extend.h"
#include "settle.h"

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

void apply_group(EditTarget& target, DabImages images, int tool_level) {
  switch (images.front().tool().action) {
    case Action::inflate:
      return inflate(target, images, tool_level);
    case Action::smooth:
      return smooth(target, images, tool_level);
    case Action::flatten:
    case Action::scrape:
    case Action::fill:
      return flatten(target, images, tool_level);
    case Action::pinch:
    case Action::crease:
      return crease(target, images, tool_level);
    default:
      return;
  }
}

}  // namespace

int level_of_tool(const LevelStack& stack, double smallest_radius_mm) {
  int level = 0;
  while (level < stack.top() && 8.0 * stack.voxel_mm(level + 1) <= smallest_radius_mm) ++level;
  return level;
}

void apply_dab(EditTarget& target, const Tool& tool, std::span<const Dab> images) {
  std::vector<PosedTool> posed;
  for (const Dab& dab : images) posed.emplace_back(tool, dab);
  const PosedTool& first = posed.front();
  if (first.strength() == 0.0 || first.smallest_radius_mm() <= 0.0) return;
  if (tool.action == Action::mask) return paint_mask(target, posed);
  const LevelStack& stack = target.stack;
  if (tool.action == Action::add || tool.action == Action::carve) {
    // Sharp edges and the corners of a mesh are finer than its size.
    const bool is_round = tool.shape != Shape::box && tool.shape != Shape::mesh;
    const double detail = first.shrunk_radius_mm() * (is_round ? 1.0 : 0.125);
    const int level = level_of_tool(stack, detail);
    for (const PosedTool& image : posed) add_or_carve(target, image, level);
    return;
  }
  const int level = level_of_tool(stack, first.smallest_radius_mm());
  const double margin = 2.0 * (kReach + 1) * stack.voxel_mm(stack.top());
  std::vector<Box3> reached;
  for (const PosedTool& image : posed) reached.push_back(image.bounds_mm());
  for (const auto& group : groups_of(std::move(posed), margin)) {
    apply_group(target, group, level);
  }
  settle(target, reached);
}

void apply_way(EditTarget& target, const Tool& tool, std::span<const Dab> way, std::size_t images) {
  if (tool.action == Action::grab) return grab(target, tool, way, images);
  twist(target, tool, way, images);
}

}  // namespace argil
