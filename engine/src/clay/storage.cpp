// SPDX-License-Identifier: GPL-3.0-or-later
// What a clay stores, as plain data.
#include "argil/engine/storage.h"

#include <algorithm>
#include <cassert>
#include <set>
#include <utility>

#include "clay/clay_access.h"
#include "clay/node_coord.h"
#include "clay/tree_walk.h"
#include "field/level_stack.h"
#include "field/mask.h"

namespace argil {
namespace {

static_assert(storage::kLeafSide == kLeafSide && storage::kLeafNodes == kLeafNodes);
static_assert(storage::kLowerSide == VdbLowerNode::DIM && storage::kUpperSide == VdbUpperNode::DIM);
static_assert(storage::kLowerSlots == VdbLowerNode::NUM_VALUES &&
              storage::kUpperSlots == VdbUpperNode::NUM_VALUES);
static_assert(storage::kMostLevels == kMostLevels && storage::kMaskVoxels == kMaskVoxels);

/// Where upper branches of a level are, and, while they are few, where the clay passes. The
/// coarsest level covers all of it.
std::set<Coord> upper_origins(const LevelStack& stack, int level) {
  constexpr std::int64_t kMostBoxes = 64;
  constexpr int kLog = VdbUpperNode::TOTAL;
  std::set<Coord> origins;
  for (auto upper = stack.grid(level).tree().root().cbeginChildOn(); upper; ++upper) {
    origins.insert(upper->origin());
  }
  openvdb::CoordBBox box;
  if (!stack.grid(stack.top()).tree().evalLeafBoundingBox(box)) return origins;
  const int steps = stack.top() - level;
  const openvdb::CoordBBox boxes{(box.min() << steps) >> kLog, (box.max() << steps) >> kLog};
  if (static_cast<std::int64_t>(boxes.volume()) > kMostBoxes) return origins;
  for (auto at = boxes.begin(); at; ++at) origins.insert(*at << kLog);
  return origins;
}

}  // namespace

StoredClay::StoredClay(const Clay& clay) noexcept : stack_(&levels_of(clay)) {}

int StoredClay::level_count() const noexcept { return stack_->count(); }

double StoredClay::voxel_mm(int level) const noexcept {
  assert(level >= 0 && level < stack_->count());
  return stack_->voxel_mm(level);
}

float StoredClay::band_mm(int level) const noexcept {
  assert(level >= 0 && level < stack_->count());
  return stack_->band_mm(level);
}

void StoredClay::show_level(int level, LevelVisitor& to) const {
  assert(level >= 0 && level < stack_->count());
  const VdbTree& tree = stack_->grid(level).tree();
  if (level == stack_->top()) return show_tree(tree, to);
  TileSigns signs(*stack_, level);
  TreeWalk walk(tree, &signs, to);
  for (const Coord& origin : upper_origins(*stack_, level)) {
    const auto* upper = tree.root().probeConstNode<VdbUpperNode>(origin);
    if (upper != nullptr) {
      walk.show(*upper);
    } else {
      walk.show(VdbUpperNode(origin, tree.background(), false));
    }
  }
}

std::vector<NodeCoord> StoredClay::leaf_origins(int level) const {
  assert(level >= 0 && level < stack_->count());
  const std::vector<Coord> sorted = stack_->sorted_origins(level);
  std::vector<NodeCoord> origins(sorted.size());
  std::transform(sorted.begin(), sorted.end(), origins.begin(), node_coord);
  return origins;
}

const float* StoredClay::leaf(int level, const NodeCoord& origin) const {
  assert(level >= 0 && level < stack_->count() && is_aligned(origin, kLeafSide));
  const VdbLeaf* found = stack_->leaf(level, coord_of(origin));
  return found != nullptr ? found->buffer().data() : nullptr;
}

bool StoredClay::has_mask() const noexcept { return stack_->mask() != nullptr; }

float StoredClay::mask_elsewhere() const {
  assert(has_mask());
  return stack_->mask()->elsewhere();
}

void StoredClay::show_mask(LevelVisitor& to) const {
  assert(has_mask());
  show_tree(stack_->mask()->grid().tree(), to);
}

}  // namespace argil
