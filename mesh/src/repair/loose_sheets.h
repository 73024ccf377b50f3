// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// Whether a part has so little surface for its openings that it is a sheet: `cones` are its
/// boundary_cones, and more than three fifths of its area.
bool has_sheets(const TriangleMesh& mesh, const std::vector<Vec3>& positions,
                const std::vector<Triangle>& cones);

/// Whether the mesh is a few sheets, none beside another, and nothing else: their rims are long for
/// their area (thicken_sheets).
bool is_open_sheets(const TriangleMesh& mesh);

/// Leaves out sheets whose rims lie apart from all other parts, by more than twice the rim's edges
/// or 3 % of it, where there are parts that are none: nothing printable is meant by them. Patches
/// that lie on one another stay, and so do more than 64 that are more than half of all surface, or
/// nine tenths where the rest is closed: a soup. Returns how many went.
///
/// Errors       throws Interrupted where `pace` asks.
/// Determinism  same bits every time.
/// Threads      one. Linear, but for the search around rims.
std::int64_t drop_loose_sheets(TriangleMesh& mesh, const Pace& pace);

}  // namespace argil::mesh
