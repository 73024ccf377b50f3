// SPDX-License-Identifier: GPL-3.0-or-later
// A leaf is judged by the distance at its middle and its half diagonal before its nodes are asked.
#include "operation/solid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "edit/edge_rounding.h"
#include "field/dense_block.h"
#include "field/prolongation.h"

namespace argil {
namespace {

/// A distance changes by no more than the length moved, so the middle and the half diagonal tell.
template <class Distance>
Side side_by_middle(const LevelStack& lattice, int level, const Coord& origin, double reach_mm,
                    const Distance& distance) {
  assert(is_leaf_origin(origin) && reach_mm >= static_cast<double>(lattice.band_mm(level)));
  const double voxel = lattice.voxel_mm(level);
  const double half = 0.5 * (kLeafSide - 1) * voxel;
  const double middle = distance(node_mm(origin, voxel) + Vec3{half, half, half});
  const double reach = half * std::sqrt(3.0) + reach_mm;
  if (middle > reach) return Side::outside;
  return middle < -reach ? Side::inside : Side::near;
}

template <class Distance>
void fill_from(const LevelStack& lattice, int level, const Coord& origin, LeafValues& out,
               const Distance& distance) {
  const double voxel = lattice.voxel_mm(level);
  const auto band = static_cast<double>(lattice.band_mm(level));
  for (int n = 0; n < kLeafNodes; ++n) {
    const Coord node = origin.offsetBy(n >> 6, (n >> 3) & 7, n & 7);
    const double value = std::clamp(distance(node_mm(node, voxel)), -band, band);
    out[static_cast<std::size_t>(n)] = static_cast<float>(value);
  }
}

template <class Distance>
float value_at(const LevelStack& lattice, int level, const Coord& node, const Distance& distance) {
  const auto band = static_cast<double>(lattice.band_mm(level));
  return static_cast<float>(
      std::clamp(distance(node_mm(node, lattice.voxel_mm(level))), -band, band));
}

}  // namespace

openvdb::CoordBBox nodes_covering(const Box3& box_mm, double voxel_mm) {
  assert(is_finite(box_mm.min) && is_finite(box_mm.max));  // else it has no nodes
  const Vec3 low = box_mm.min / voxel_mm;
  const Vec3 high = box_mm.max / voxel_mm;
  return {Coord::floor(openvdb::Vec3d(low.x, low.y, low.z)),
          Coord::ceil(openvdb::Vec3d(high.x, high.y, high.z))};
}

CoarseNodes Solid::coarse(int coarser, const Coord& origin) const {
  CoarseNodes nodes;
  const Coord low = argil::coarser(origin);
  for (int n = 0; n < kCoarseNodesSide * kCoarseNodesSide * kCoarseNodesSide; ++n) {
    nodes[static_cast<std::size_t>(n)] = at(coarser, low.offsetBy(n / 25, n / 5 % 5, n % 5));
  }
  return nodes;
}

Side PlaneSolid::side_of(int level, const Coord& origin, double reach_mm) const {
  return side_by_middle(lattice_, level, origin, reach_mm,
                        [this](const Vec3& p) { return distance(p); });
}

void PlaneSolid::fill(int level, const Coord& origin, LeafValues& out) const {
  fill_from(lattice_, level, origin, out, [this](const Vec3& p) { return distance(p); });
}

float PlaneSolid::at(int level, const Coord& node) const {
  return value_at(lattice_, level, node, [this](const Vec3& p) { return distance(p); });
}

float PlaneSolid::beyond_band(int level, const Coord& node) const {
  return static_cast<float>(distance(node_mm(node, lattice_.voxel_mm(level))));
}

RodSolid::RodSolid(const LevelStack& lattice, const Rod& rod, double tolerance_mm)
    : lattice_(lattice), rod_(rod) {
  assert(is_finite(rod.from_mm) && is_finite(rod.axis));
  assert(rod.length_mm >= 0.0 && rod.radius_mm > 0.0 && tolerance_mm > 0.0);
  const auto holds = [&](int level) {
    const double voxel = lattice.voxel_mm(level);
    // The second: what a chord of one voxel misses of the circle.
    return 8.0 * voxel <= rod.radius_mm && voxel * voxel <= 8.0 * tolerance_mm * rod.radius_mm;
  };
  while (level_ < lattice.top() && holds(level_ + 1)) ++level_;
}

double RodSolid::distance(const Vec3& p) const noexcept {
  const Vec3 from = p - rod_.from_mm;
  const double along = dot(from, rod_.axis);
  const Vec3 across = from - along * rod_.axis;
  const double beside = length(across) - rod_.radius_mm;
  const double beyond = std::abs(along - 0.5 * rod_.length_mm) - 0.5 * rod_.length_mm;
  const double a = std::max(beside, 0.0);
  const double b = std::max(beyond, 0.0);
  return std::sqrt(a * a + b * b) + std::min(0.0, std::max(beside, beyond));
}

Side RodSolid::side_of(int level, const Coord& origin, double reach_mm) const {
  return side_by_middle(lattice_, level, origin, reach_mm,
                        [this](const Vec3& p) { return distance(p); });
}

void RodSolid::fill(int level, const Coord& origin, LeafValues& out) const {
  fill_from(lattice_, level, origin, out, [this](const Vec3& p) { return distance(p); });
}

float RodSolid::at(int level, const Coord& node) const {
  return value_at(lattice_, level, node, [this](const Vec3& p) { return distance(p); });
}

float RodSolid::beyond_band(int level, const Coord& node) const {
  return static_cast<float>(distance(node_mm(node, lattice_.voxel_mm(level))));
}

std::vector<Coord> RodSolid::detailed_origins(int level) const {
  std::vector<Coord> origins;
  if (level < level_) return origins;
  const double voxel = lattice_.voxel_mm(level);
  const double reach = rod_.radius_mm + kHalfWidthVoxels * voxel;
  Box3 box;
  for (const double end : {-reach, rod_.length_mm + reach}) {
    const Vec3 at = rod_.from_mm + end * rod_.axis;
    box.include(at - Vec3{reach, reach, reach});
    box.include(at + Vec3{reach, reach, reach});
  }
  const auto band = static_cast<double>(lattice_.band_mm(level));
  for_each_leaf_origin(nodes_covering(box, voxel), [&](const Coord& origin) {
    if (side_of(level, origin, band) == Side::near) origins.push_back(origin);
  });
  return origins;
}

Side StackSolid::side_of(int level, const Coord& origin, double reach_mm) const {
  if (stack_.has_leaf(level, origin)) return Side::near;
  const int top = stack_.top();
  if (level == top) {
    return stack_.grid(level).tree().getValue(origin) < 0.0F ? Side::inside : Side::outside;
  }
  // The finest coarser level whose band tells as much as is asked.
  int above = level + 1;
  while (above < top && static_cast<double>(stack_.band_mm(above)) < reach_mm) ++above;
  const Coord low = origin >> (above - level);
  const Coord high = (origin.offsetBy(kLeafSide - 1) >> (above - level)).offsetBy(1);
  // Tiles say no more than the band.
  const auto reach =
      static_cast<float>(std::min(reach_mm, 0.999 * static_cast<double>(stack_.band_mm(top))));
  const bool is_inside = stack_.sample(above, low) < 0.0F;
  if (may_be_below(stack_, above, {low, high}, is_inside ? -1.0F : 1.0F, reach)) return Side::near;
  return is_inside ? Side::inside : Side::outside;
}

CoarseNodes StackSolid::coarse(int coarser, const Coord& origin) const {
  CoarseNodes nodes = coarse_nodes(stack_, coarser, origin);
  const float band = stack_.band_mm(coarser);
  for (float& value : nodes) value = std::clamp(value, -band, band);
  return nodes;
}

void StackSolid::fill(int level, const Coord& origin, LeafValues& out) const {
  if (const VdbLeaf* leaf = stack_.leaf(level, origin)) {
    std::copy_n(leaf->buffer().data(), kLeafNodes, out.begin());
  } else {
    prolong_leaf(stack_, level, origin, out);
  }
}

float StackSolid::at(int level, const Coord& node) const {
  const float band = stack_.band_mm(level);
  return std::clamp(stack_.sample(level, node), -band, band);
}

float StackSolid::beyond_band(int level, const Coord& node) const {
  return distance_beyond_band(stack_, level, node);
}

std::optional<openvdb::CoordBBox> StackSolid::top_nodes() const {
  openvdb::CoordBBox box;
  const int finer = stack_.top() - top_;
  for (const Coord& origin : stack_.sorted_origins(stack_.top())) {
    box.expand(openvdb::CoordBBox(origin << finer, origin.offsetBy(kLeafSide) << finer));
  }
  return box;
}

}  // namespace argil
