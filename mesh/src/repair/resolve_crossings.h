// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/intersections.h"

namespace argil::mesh {

struct ResolvedCrossings {
  TriangleMesh mesh;              ///< rounded to float, which may make a few triangles cross anew
  std::int64_t united_parts = 0;  ///< that crossed others and became one with them
};

/// The surface of all that a mesh has inside, where its triangles cross, lie on one another, or are
/// within other parts: cut along each other exactly, and without what is inside on both its sides.
/// What nothing crosses and nothing encloses keeps its bits. Inside is where the winding number is
/// at least 1: a cavity stays one, and matter counted twice is matter.
///
/// Shapes       a mesh that names each place once, without degenerate triangles, in which every
///              edge is run along as often one way as the other but for what these left open;
///              `pairs`: its self_intersections. Finite floats.
/// Returns      nothing where lines cross in triangles so often that it would take longer than a
///              level set, a quarter of a minute.
/// Errors       throws Interrupted where `pace` asks; std::bad_alloc.
/// Determinism  same bits every time.
/// Threads      one.
/// Cost         50 us a pair and 20 us for each crossing of lines in a triangle, 20 us a patch
///              between lines, 0.3 us a triangle.
std::optional<ResolvedCrossings> resolve_crossings(const TriangleMesh& mesh,
                                                   const std::vector<TrianglePair>& pairs,
                                                   const Pace& pace);

}  // namespace argil::mesh
