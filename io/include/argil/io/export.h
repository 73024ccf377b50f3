// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/io/mesh_check.h"

namespace argil::io {

struct ExportReport {
  std::int64_t triangles = 0;
  double max_error_mm =
      0.0;  ///< largest |phi| of the clay over vertices, edge middles and centroids
  double rms_error_mm = 0.0;
  double volume_change =
      0.0;  ///< (volume of the written mesh - of the extracted surface) / the latter
  std::int64_t removed_crumbs = 0;  ///< closed parts smaller than one finest voxel's volume
  std::int64_t collapsed_edges =
      0;                ///< slivers that rounding to float had folded, shrunk to a point
  MeshVerdict verdict;  ///< of the file read back, after rounding to its floats
};

/// Surface of the clay as a printable mesh file: extracted, rounded to the file's floats, crumbs
/// removed, slivers that rounding folded collapsed (OpenMesh), written, read back and checked.
/// The file appears only when it was checked; a mesh that is not printable is still written, and
/// the verdict says why. Errors  bad_input when the clay is empty or the ending unknown; disk;
/// interrupted. Threads as Clay; measuring spreads over TBB. Same bytes and figures for any number
/// of threads.
Result<ExportReport> export_mesh(const std::filesystem::path& file, const Clay& clay,
                                 const Progress& progress = {});

}  // namespace argil::io
