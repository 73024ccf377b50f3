// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "surface/contour_cell.h"
#include "surface/contour_loop.h"

namespace argil {

/// What the pyramids of a cell need to know about it. Spans are indexed as in the ContourCell.
struct PyramidInput {
  std::span<const LoopCorner> cuts;  ///< by cut of the cell as first traced: its vertex
  Vec3 low_mm;                       ///< the cell's low corner
  double size_mm = 0.0;              ///< its side
  std::span<const float> values;     ///< by node id: the field there (used for nodes of polygons)
};

/// Fills a cell by splitting it into pyramids, one over each polygon of its boundary, with the apex
/// at the cell's centre, and contouring each by the rules of a cell. Pyramids are convex with at
/// most one cut per edge, so nothing can cross; the polygons' segments, all that neighbours see,
/// stay as they are. Dearer and with more triangles: only for cells whose loops would cross.
void fill_by_pyramids(ContourCell& cell, const PyramidInput& input, ContourMesh& mesh);

}  // namespace argil
