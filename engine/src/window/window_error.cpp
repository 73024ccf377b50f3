// SPDX-License-Identifier: GPL-3.0-or-later
// An estimate, calibrated against exact windows of shapes with known distances.
#include "window/window_error.h"

#include <algorithm>
#include <cmath>

namespace argil {
namespace {

/// Voxels of a level within which it is sure to hold a distance, not its clamp.
constexpr double kSure = kHalfWidthVoxels - 1;
/// Calibrated on plane, ball, torus, edge, rough plane, slot and sheet.
constexpr double kBend = 0.08;
constexpr double kFloor = 0.002;

/// What the finest level that is sure of this node of `level` says less what `level` says.
double lost_by_averaging(const LevelStack& stack, int level, const Coord& node, double value) {
  for (int finer = 0; finer < level; ++finer) {
    const Coord fine = node << (level - finer);
    const VdbLeaf* leaf = stack.leaf(finer, fine);
    if (leaf == nullptr) continue;
    const auto known = static_cast<double>(leaf->buffer().data()[leaf_offset(fine)]);
    if (std::abs(known) < kSure * stack.voxel_mm(finer)) return known - value;
  }
  return 0.0;
}

/// The sum over the axes of the second differences of the block, each without its sign.
double bend(const LevelBlock& block, const Coord& node) {
  const auto at = [&](const Coord& n) {
    return static_cast<double>(block.nodes.value[block.index(n)]);
  };
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    Coord step(0, 0, 0);
    step[axis] = 1;
    sum += std::abs(at(node - step) - 2.0 * at(node) + at(node + step));
  }
  return sum;
}

}  // namespace

/// The border has no second differences.
double block_error_mm(const LevelStack& stack, int level, const LevelBlock& block, double near_mm) {
  const double voxel = stack.voxel_mm(level);
  double squares = 0.0;
  std::size_t nodes = 0;
  for_each_node(block.box.grown(-1), [&](const Coord& node) {
    const auto value = static_cast<double>(block.nodes.value[block.index(node)]);
    if (!(std::abs(value) < near_mm)) return;
    const double averaged = lost_by_averaging(stack, level, node, value);
    const double bent = kBend * bend(block, node);
    squares += averaged * averaged + bent * bent;
    ++nodes;
  });
  const double floor = kFloor * voxel;
  if (nodes == 0) return floor;
  return std::sqrt(squares / static_cast<double>(nodes) + floor * floor);
}

}  // namespace argil
