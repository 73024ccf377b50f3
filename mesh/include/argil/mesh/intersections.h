// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

// Questions about a mesh that only exact arithmetic answers: CGAL's exact predicates on the given
// coordinates, all of which must be finite.

/// Where so many pairs of triangles cross there is nothing left to be counted: a mesh of n
/// triangles through one point has n^2 / 2.
inline constexpr std::int64_t kMostCrossings = 1'000'000;

/// Triangles whose corners lie on one line, or that name a vertex twice; ascending.
std::vector<std::uint32_t> degenerate_triangles(const TriangleMesh& mesh);

/// Two triangles, the lower number first.
using TrianglePair = std::pair<std::uint32_t, std::uint32_t>;

/// Pairs of triangles that meet elsewhere than in the vertices or the edge they share by index;
/// sorted. Pairs with all three vertices in common are passed over.
///
/// Shapes       left_out: triangles that are not looked at, ascending.
/// Returns      at most kMostCrossings pairs; so many mean that there may be more.
/// Errors       throws Interrupted where `pace` asks to stop.
/// Determinism  same pairs for any number of threads.
/// Threads      any thread; slabs of the mesh spread over TBB.
/// Accuracy     exact: flat fans and separating planes decide in doubles only what their bounds of
///              the rounding allow (SelfIntersectionsProperty.EqualAskingPairByPair).
/// Cost         about 0.25 us per triangle of a smooth surface, 1 us of one whose triangles are of
///              very different size; 30 bytes a triangle, and 80 for each of those in the few slabs
///              that are looked at at a time. 0.2 us for each pair whose boxes overlap and that
///              shares nothing, crossing or not: long triangles that lie askew are slow.
/// Source       A. Zomorodian, H. Edelsbrunner, "Fast software for box intersections", 2002, as
///              CGAL has it, where a grid does not fit. Ours differs: the mesh goes through either
///              slab by slab, so that memory grows with the largest slab.
std::vector<TrianglePair> self_intersections(const TriangleMesh& mesh,
                                             const std::vector<std::uint32_t>& left_out,
                                             const Pace& pace);
std::vector<TrianglePair> self_intersections(const TriangleMesh& mesh,
                                             const std::vector<std::uint32_t>& left_out);

/// Whether the components of a closed, two-manifold mesh without self-intersections are turned so
/// that outside and inside alternate: outer shells outward, cavities in them inward, and so on.
bool bounds_a_volume(const TriangleMesh& mesh);

/// Of such a mesh, which triangles would have to be turned for that; with all of a component.
std::vector<bool> wrongly_turned(const TriangleMesh& mesh);

}  // namespace argil::mesh
