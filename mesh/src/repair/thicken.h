// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/triangle_mesh.h"
#include "argil/mesh/thickening.h"

namespace argil::mesh {

/// Whether a part is a sheet by its open edges, which are long for its area: L^2 / (4 pi A), which
/// is 1 for a disc, 1/2 for half a ball and 0 for what is closed, is at least a quarter.
bool is_sheet_by_rim(double rim_mm, double area_mm2);

/// Gives a thickness to the parts that are sheets by their rim. Each becomes a closed part with
/// both sides and a rim; sides that fold into themselves where the sheet bends more than its
/// thickness allows are for resolve_crossings. Returns how many parts.
///
/// Shapes       any triangle soup whose positions are welded. Parts are cut where three triangles
///              meet.
/// Accuracy     both sides are the thickness apart where the sheet is flat or bends along one edge
///              at a vertex, at corners of up to 70 degrees too; sharper ones are cut off at three
///              times as far from the vertex (ThickenedSheets.*).
/// Determinism  same bits every time.
/// Threads      one. Linear.
std::int64_t thicken_sheets(TriangleMesh& mesh, const Thickening& how);

}  // namespace argil::mesh
