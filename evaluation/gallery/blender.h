// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"

#include "gallery/plate.h"

namespace argil::evaluation {

/// A plate that Blender is to do.
struct BlenderPlate {
  const Plate* plate;   ///< not one without counterpart
  double aim_mm = 0.0;  ///< how far its surface is to move where the plate is matched
};

/// What it made of a plate.
struct BlenderPiece {
  std::string complaint;  ///< why there is nothing else; "" when all went well
  double strength = 0.0;  ///< of its last stroke
  TriangleMesh mesh;
};

struct BlenderGallery {
  std::string version;                  ///< "3.4.1"
  std::map<Body, TriangleMesh> starts;  ///< its remesh of each body
  std::vector<BlenderPiece> pieces;     ///< one for each plate
};

/// Runs Blender once in a window that nobody sees, on its own voxel remesh (kGalleryVoxel) of these
/// surfaces. Blender and screen end with this call and leave nothing behind.
///
/// Shapes  bodies: that of each plate is there.
/// Errors  interrupted; disk; internal with what Blender said last, where it did nothing or took
///         ten minutes. A plate that it fails at says so.
Result<BlenderGallery> run_blender_gallery(const std::map<Body, TriangleMesh>& bodies,
                                           const std::vector<BlenderPlate>& plates,
                                           const Progress& progress);

}  // namespace argil::evaluation
