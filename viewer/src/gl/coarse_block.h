// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/triangle_mesh.h"

#include "picture/renderer.h"

namespace argil::viewer {

/// Triangles between some of a block's vertices, about a third as many, for pictures that are
/// shown for a moment. The vertices along the block's open edges all stay, so that no gap shows
/// beside another block, whichever of the two is drawn so. Those inside are merged by cells of a
/// third of the block, each cell into the one nearest to its mean: what is closed stays closed,
/// seen from outside too, since triangles only move with their corners.
///
/// Cost     some 10 us for a leaf's block. One of more triangles than any leaf has stays as it is.
/// Source   vertex clustering: J. Rossignac and P. Borrel, "Multi-resolution 3D approximations for
///          rendering complex scenes" (1993).
std::vector<Triangle> coarse_triangles(const BlockMesh& block);

}  // namespace argil::viewer
