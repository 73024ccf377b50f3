// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/intersections.h"

namespace argil::mesh {

struct ResolvedCrossings {
  TriangleMesh mesh;              ///< rounded to float, which may make a few triangles cross anew
  std::int64_t united_parts = 0;  ///< that became one with others, or lay within them
};

/// The surface of all that a mesh has inside, where its triangles cross, lie on one another, or are
/// within other parts: cut along each other exactly, and without what is inside on both its sides.
/// What nothing crosses and nothing encloses keeps its bits. Inside is where the winding number is
/// at least 1: a cavity stays one, and matter counted twice is matter.
///
/// Shapes       a mesh that names each place once, without degenerate triangles, in which every
///              edge is run along as often one way as the other but for what these left open;
///              `pairs`: its self_intersections. Finite floats.
/// Errors       throws Interrupted where `pace` asks; std::bad_alloc.
/// Determinism  same bits every time.
/// Threads      one.
/// Cost         50 us a pair, 20 us a patch between lines of crossing, 0.3 us a triangle.
ResolvedCrossings resolve_crossings(const TriangleMesh& mesh,
                                    const std::vector<TrianglePair>& pairs, const Pace& pace);

}  // namespace argil::mesh
