// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"

#include "gallery/plate.h"

namespace argil::evaluation {

/// A plate as Argil does it.
struct Piece {
  TriangleMesh mesh;  ///< the surface that is drawn, with its normals
  int level = 0;      ///< the one that the last tool was written at
};

/// The surface of a body before any work. `voxel_mm`: the finest.
/// Errors  as Clay::from_distance; interrupted.
Result<TriangleMesh> body_surface(Body body, double voxel_mm, const Progress& progress);

/// Errors  as Clay.
Result<Piece> argil_piece(const Plate& plate, double voxel_mm, const Progress& progress);

}  // namespace argil::evaluation
