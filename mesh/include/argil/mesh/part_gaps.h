// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// Where two parts of an assembly come nearest.
struct PartGap {
  std::uint32_t a = 0;  ///< the parts, a < b
  std::uint32_t b = 0;
  double gap_mm = 0.0;     ///< 0 where they cross, or one lies in the solid of the other
  bool is_within = false;  ///< one lies in the other, and their surfaces do not cross
  Vec3 at_mm;              ///< the middle of the gap; a place where they cross; of what lies within

  /// Nearer than the floats of a file can part them.
  bool meet() const noexcept { return gap_mm < 1e-4; }
};

/// All pairs of parts whose surfaces come nearer than `reach_mm`, or of which one lies in the solid
/// of the other; the nearest first, then by number.
///
/// Shapes       any triangles with finite positions; each part by itself, at most kMostParts.
/// Accuracy     exact but for rounding: every pair of triangles that might be nearest is measured,
///              also where edges are (PartGaps.*). Of what crosses, any place is named.
/// Determinism  same bits every time.
/// Threads      any thread; works on the caller's.
/// Errors       throws Interrupted and std::bad_alloc: to be called within no_throw.
/// Cost         2 us a triangle for trees of parts that have a neighbour; then by what lies near:
///              0.3 us for each pair of triangles that might be nearest. Parts side by side at an
///              even gap are the slowest.
std::vector<PartGap> part_gaps(std::span<const TriangleMesh> parts, double reach_mm,
                               const Pace& pace);

/// Each of a million parts has half a million neighbours to look at.
inline constexpr std::size_t kMostParts = 1000;

}  // namespace argil::mesh
