// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/vec3.h"
#include "argil/io/import_outlook.h"
#include "argil/io/mesh_frame.h"
#include "argil/io/prepared_mesh.h"

namespace argil::viewer {

/// What a mesh looks like along an axis, as runs of cells: rows from below, columns from the left.
struct Silhouette {
  struct Run {
    int row = 0;
    int first = 0;
    int end = 0;  ///< behind the last
    friend bool operator==(const Run&, const Run&) = default;
  };
  std::vector<Run> runs;
  int columns = 0;
  int rows = 0;
};

/// What a mesh file holds, to be asked about before it is imported.
struct MeshOffer {
  std::int64_t number = 0;  ///< LookAtMesh::number
  std::filesystem::path file;
  io::FrameReport frame;  ///< as the file says, else mm and z up; what it looks like is only told
  Vec3 size_mm;           ///< in that frame
  std::int64_t triangles = 0;
  std::size_t parts = 1;  ///< that the file names, or bodies
  io::ImportOutlook outlook;
  Silhouette along_y;  ///< x to the right, z up: from the front in that frame
  Silhouette along_z;  ///< x to the right, y up: from the front where the other axis is up, or,
                       ///< where y was up, upside down
};

/// How a mesh becomes clay.
struct MeshImport {
  io::MeshPreparation preparation;
  double voxel_mm = 0.0;     ///< 0: as many along its longest side as `argil import` takes
  bool keeps_parts = false;  ///< each a piece of its own
};

/// Reads it and looks at it.
/// Errors  as read_assembly; bad_input for what has no extent; interrupted, which reading itself
///         does not hear. Threads  any. Cost  2 us a triangle beyond reading, 0.3 s at least.
Result<MeshOffer> look_at_mesh(const std::filesystem::path& file, const Progress& progress = {});

}  // namespace argil::viewer
