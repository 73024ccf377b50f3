// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"

namespace argil::io {

/// The greatest distance that a point of some triangles has from a mesh, in mm; both 0 for none.
struct GreatestDistance {
  double at_least_mm = 0.0;  ///< of a point that was looked at
  double at_most_mm = 0.0;   ///< of all points, but for the rounding of doubles
};

/// Of the named triangles of `from` to all of `to`, which has at least one. The two answers differ
/// by at most `slack_mm` > 0, or a fiftieth where that is more.
///
/// Errors       throws Interrupted where `pace` asks.
/// Determinism  same bits for any number of threads.
/// Threads      any thread; spreads over TBB.
/// Cost         some microseconds a triangle, more for those that may have the farthest point.
/// Source       M. Tang, M. Lee, Y. J. Kim, "Interactive Hausdorff distance computation for general
///              polygonal models", 2009. Ours differs: the distance from one triangle is convex, so
///              that corners bound it for all of another; what that does not decide is halved.
GreatestDistance greatest_distance(const TriangleMesh& from,
                                   const std::vector<std::uint32_t>& triangles,
                                   const TriangleMesh& to, double slack_mm, const Pace& pace);

/// Of all triangles.
GreatestDistance greatest_distance(const TriangleMesh& from, const TriangleMesh& to,
                                   double slack_mm);

}  // namespace argil::io
