// SPDX-License-Identifier: GPL-3.0-or-later
// Edges that an edit makes where its shape meets the clay. On a lattice a sharp one comes out as a
// saw, so it is rounded by about a voxel, as if a ball had rolled along it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "argil/core/vec3.h"

#include "edit/level_edit.h"
#include "field/halo.h"

namespace argil {

/// The greater of two distances a and b to bodies whose normals have this cosine, with the edge of
/// what lies in both opened by a rolling ball: the distance to all balls of that radius which fit
/// in. A second time it changes nothing. Exact for planes. Wedges below 60 degrees are rounded
/// less, down to not at all, since little would be left of them.
double rounded_max(double a, double b, double cosine, double radius) noexcept;

/// The radius for the edges of what is written at a level: what is asked for, or else as little as
/// does not come out as a saw in leaves of the next finer level, if there is any; at most half of
/// the radius of the tool, which may be infinite.
double edge_radius(const LevelStack& stack, int level, std::optional<double> asked_mm,
                   double smallest_radius_mm) noexcept;

/// The widest radius where no tool bounds it: what is thinner is lost in an opening.
double widest_edge(const LevelStack& stack) noexcept;

/// Whether edges of that radius come out as well without leaves finer than the level.
bool is_fine_enough(const LevelStack& stack, int level, double radius_mm) noexcept;

/// Whether the band of a level tells all that rounding by the radius reads.
bool is_within_band(const LevelStack& stack, int level, double radius_mm) noexcept;

/// What a level says of a leaf that it does not store.
void fill_absent(const LevelStack& stack, int level, const Coord& origin, LeafValues& out);
/// Replaces what is as far as the band by what is known beyond it.
void widen(const LevelStack& stack, int level, const Coord& origin, double radius_mm,
           HaloBlock& block);

/// The value of a node as sample() has it, but where a level knows no more than "far", what the
/// next coarser one knows.
float distance_beyond_band(const LevelStack& stack, int level, const Coord& node);

/// The distances of a leaf, `own`, and of the nodes beside it, also where the level has no leaf.
/// Where rounding by the radius reads farther than the band of the level, from beyond it.
/// `values(origin)`: those of a leaf before the edit; null where the stack tells what they are.
template <class Values>
void gather_before(const LevelStack& stack, int level, const Coord& origin, const float* own,
                   double radius_mm, const Values& values, HaloBlock& out) {
  std::array<const float*, kHaloLeaves> around{};
  std::array<LeafValues, kHaloLeaves> filled;
  for_each_halo_leaf(origin, [&](std::size_t n, const Coord& at) {
    around[n] = n == 0 ? own : values(at);
    if (around[n] != nullptr) return;
    fill_absent(stack, level, at, filled[n]);
    around[n] = filled[n].data();
  });
  gather_halo(around, out);
  if (!is_within_band(stack, level, radius_mm)) widen(stack, level, origin, radius_mm, out);
}

/// The same of an edit.
inline void gather_before(const LevelEdit& level, const Coord& origin, const float* own,
                          double radius_mm, HaloBlock& out) {
  LevelEdit::Reader reader(level);
  gather_before(
      level.stack(), level.level(), origin, own, radius_mm,
      [&](const Coord& at) { return reader.filled_before(at); }, out);
}

/// How a field rises over a node of a halo, from the nodes before it to those behind.
inline Vec3 rise_in_halo(const HaloBlock& block, int i, int j, int k) noexcept {
  const float* at = block.value + HaloBlock::index(i, j, k);
  Vec3 rise;
  for (std::size_t a = 0; a < 3; ++a) {
    rise[a] = static_cast<double>(at[kHaloStride[a]]) - static_cast<double>(at[-kHaloStride[a]]);
  }
  return rise;
}

/// How far below both surfaces an edge changes anything at most, on a level: within the band, and
/// where a wide edge ends.
inline double edge_reach_mm(double voxel_mm, double radius_mm) noexcept {
  return std::max(kHalfWidthVoxels * voxel_mm, 2.0 * radius_mm);
}

/// Two bodies at the nodes of a leaf. What is kept is where both are <= 0.
struct EdgeLeaf {
  /// From the rounded surface, in voxels: beyond, no vertex and no normal reads.
  static constexpr float kFarthest = 3.0F;
  /// How much deeper than the sharp one it may lie, in radii: on the bisector of a wedge of 60
  /// degrees, the most acute that is rounded whole.
  static constexpr float kDeepest = 0.5F;

  float side;               ///< 1, or -1 where the edit works on the air: the clay counts with it
  const LeafValues& other;  ///< may be infinite
  double voxel_mm;
  double radius_mm;

  /// Whether a node lies so that rounding may change it, whatever the angle.
  bool is_near(float clay, std::size_t n) const noexcept {
    const float a = side * clay;
    const float b = other[n];
    const auto radius = static_cast<float>(radius_mm);
    const float farthest = kFarthest * static_cast<float>(voxel_mm);
    const float sharp = std::max(a, b);
    return (a + b > -2.0F * radius) & (sharp < farthest) & (sharp > -farthest - kDeepest * radius) &
           (std::min(a, b) > -static_cast<float>(edge_reach_mm(voxel_mm, radius_mm)));
  }
  /// Of all nodes, without a branch: compilers make that of whole registers.
  bool is_near_any(const float* clay) const noexcept {
    unsigned any = 0;
    for (std::size_t n = 0; n < kLeafNodes; ++n) any |= is_near(clay[n], n) ? 1U : 0U;
    return any != 0;
  }
};

/// Rounds the edge: `now` becomes side * rounded_max() where both surfaces pass near a node.
/// `slope_of(n)`: that of the other body, of any length; where it has none, nothing is rounded.
template <class SlopeOf>
void round_edge(const EdgeLeaf& leaf, const HaloBlock& clay, const SlopeOf& slope_of,
                LeafValues& now) {
  constexpr double kLeastAngle = 0.985;  // 10 degrees, where it would move less than radius / 250
  const double least_rise = 0.2 * leaf.voxel_mm;
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    const auto at = static_cast<int>(n);
    const int i = at >> 6;
    const int j = at >> 3 & 7;
    const int k = at & 7;
    const float value = clay.value[HaloBlock::index(i, j, k)];
    if (!leaf.is_near(value, n)) continue;
    const Vec3 of_clay = rise_in_halo(clay, i, j, k) * static_cast<double>(leaf.side);
    const double steep = length(of_clay);
    if (!(steep > least_rise)) continue;  // in the middle of something thin
    const Vec3 of_other = slope_of(n);
    const double cosine = dot(of_clay, of_other) / (steep * length(of_other));
    if (!(cosine < kLeastAngle)) continue;
    const double rounded = rounded_max(static_cast<double>(leaf.side * value),
                                       static_cast<double>(leaf.other[n]), cosine, leaf.radius_mm);
    now[n] = leaf.side * static_cast<float>(rounded);
  }
}

}  // namespace argil
