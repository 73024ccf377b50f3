// SPDX-License-Identifier: GPL-3.0-or-later
// First the leaves that reach farthest each way, then those whose cells reach beyond what these
// have: a leaf's surface lies in its cells.
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "argil/engine/surface.h"

#include "clay/clay_access.h"
#include "surface/block_extractor.h"
#include "surface/shown_leaves.h"

namespace argil {
namespace {

struct LeafPlace {
  int level = 0;
  Coord origin;
};

/// Calls `visit(place, low_mm, high_mm)` for all leaves, with the ends of their cells.
template <class Visit>
void for_each_leaf_box(const LevelStack& stack, const Visit& visit) {
  for (int level = 0; level < stack.count(); ++level) {
    const double voxel = stack.voxel_mm(level);
    for (auto leaf = stack.grid(level).tree().cbeginLeaf(); leaf; ++leaf) {
      const Coord& origin = leaf->origin();
      visit(LeafPlace{level, origin}, node_mm(origin, voxel),
            node_mm(origin.offsetBy(kLeafSide), voxel));
    }
  }
}

/// The farthest each way: down and up along x, y and z.
std::vector<LeafPlace> farthest_leaves(const LevelStack& stack) {
  std::array<LeafPlace, 6> farthest;
  Box3 box;
  for_each_leaf_box(stack, [&](const LeafPlace& place, const Vec3& low, const Vec3& high) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (box.empty() || low[axis] < box.min[axis]) farthest[2 * axis] = place;
      if (box.empty() || high[axis] > box.max[axis]) farthest[2 * axis + 1] = place;
    }
    box.include(low);
    box.include(high);
  });
  if (box.empty()) return {};
  return {farthest.begin(), farthest.end()};
}

bool reaches_beyond(const Box3& box, const Vec3& low, const Vec3& high) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (low[axis] < box.min[axis] || high[axis] > box.max[axis]) return true;
  }
  return false;
}

}  // namespace

Box3 surface_bounds_mm(const Clay& clay) {
  const LevelStack& stack = levels_of(clay);
  BlockExtractor extractor{ShownLeaves(stack)};
  Box3 box;
  const auto take = [&](const LeafPlace& place) {
    const SurfaceBlock* block = extractor.extract(place.level, place.origin);
    if (block == nullptr) return;
    for (const Vec3& p : block->mesh.positions) box.include(p);
  };
  for (const LeafPlace& place : farthest_leaves(stack)) take(place);
  for_each_leaf_box(stack, [&](const LeafPlace& place, const Vec3& low, const Vec3& high) {
    if (reaches_beyond(box, low, high)) take(place);
  });
  return box;
}

}  // namespace argil
