// SPDX-License-Identifier: GPL-3.0-or-later
// An estimate, calibrated against exact windows of shapes with known distances.
#include "window/window_error.h"

#include <array>
#include <cmath>

namespace argil {
namespace {

/// Voxels of a level within which it is sure to hold a distance, not its clamp.
constexpr float kSure = static_cast<float>(kHalfWidthVoxels - 1);
/// Voxels within which a node is near.
constexpr float kNear = 2.5F;
/// Calibrated on plane, ball, torus, edge, rough plane, slot and sheet.
constexpr float kBend = 0.08F;
constexpr double kFloor = 0.002;

/// What the finest level that is sure of this node of `level` says less what `level` says. Levels
/// that hold no distance as long as `value`, and half a voxel of `level` more, are not asked.
float lost_by_averaging(LevelReader& reader, int level, const Coord& node, float value) {
  const LevelStack& stack = reader.stack();
  const float least = std::abs(value) - 0.5F * static_cast<float>(stack.voxel_mm(level));
  for (int finer = 0; finer < level; ++finer) {
    const float sure = kSure * static_cast<float>(stack.voxel_mm(finer));
    if (least >= sure) continue;
    const Coord fine = node << (level - finer);
    const VdbLeaf* leaf = reader.leaf(finer, fine);
    if (leaf == nullptr) continue;
    const float known = values_of(*leaf)[leaf_offset(fine)];
    if (std::abs(known) < sure) return known - value;
  }
  return 0.0F;
}

/// The sum over the axes of the second differences at a node, each without its sign; none where a
/// neighbour is not known.
float bend_at(const float* at, float band) noexcept {
  float sum = 0.0F;
  for (const int stride : {100, 10, 1}) {
    const bool is_known = std::abs(at[-stride]) < band && std::abs(at[stride]) < band;
    if (is_known) sum += std::abs(at[-stride] - 2.0F * *at + at[stride]);
  }
  return sum;
}

}  // namespace

ErrorSum leaf_error(LevelReader& reader, int level, const Coord& origin,
                    const LeafAndFaces& values) {
  const float near = kNear * static_cast<float>(reader.stack().voxel_mm(level));
  const float band = reader.stack().band_mm(level);
  ErrorSum sum;
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    const Coord node = node_of(origin, n);
    const Coord in_leaf = node - origin;
    const float* at = &values[static_cast<std::size_t>((in_leaf.x() + 1) * 100 +
                                                       (in_leaf.y() + 1) * 10 + in_leaf.z() + 1)];
    if (!(std::abs(*at) < near)) continue;
    const auto averaged = static_cast<double>(lost_by_averaging(reader, level, node, *at));
    const auto bent = static_cast<double>(kBend * bend_at(at, band));
    sum.squares_mm2 += averaged * averaged + bent * bent;
    ++sum.nodes;
  }
  return sum;
}

double window_error_mm(const ErrorSum& sum, double voxel_mm) noexcept {
  const double floor = kFloor * voxel_mm;
  if (sum.nodes == 0) return floor;
  return std::sqrt(sum.squares_mm2 / sum.nodes + floor * floor);
}

}  // namespace argil
