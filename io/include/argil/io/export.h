// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/mesh/certificate.h"
#include "argil/mesh/check.h"

namespace argil::io {

/// Nothing given: the whole surface.
struct ExportOptions {
  std::int64_t triangles = 0;  ///< at most so many; 0: as many as the rest asks for
  double max_error_mm = 0.0;   ///< as few triangles as stay within this, both ways; 0: no bound

  /// 3MF only: every body, an outer shell with its cavities, becomes a part of one object, largest
  /// first (WriteOptions::parts).
  bool parts = false;
};

struct ExportReport {
  std::int64_t triangles = 0;
  double max_error_mm = 0.0;  ///< the greater of both ways, of samples (certificate.h)
  double rms_error_mm = 0.0;  ///< the same
  mesh::Certificate certificate;
  double volume_change =
      0.0;                 ///< (volume of the written mesh - of the extracted surface) / the latter
  std::int64_t parts = 1;  ///< how many objects were written
  /// Closed parts smaller than one finest voxel's volume. With a bound those stay that the clay
  /// does not tell from what is beside them within one voxel.
  std::int64_t removed_components = 0;
  std::int64_t collapsed_edges =
      0;                      ///< slivers that rounding to float had folded, shrunk to a point
  mesh::MeshVerdict verdict;  ///< of the file read back, after rounding to its floats
};

/// Surface of the clay as a printable mesh file: extracted, small components left out, triangles
/// removed where that was asked for (decimate.h), rounded to the file's floats, slivers that
/// rounding folded collapsed (OpenMesh), measured against the clay, written, read back and checked.
/// A 3MF carries the certificate as metadata. The file appears only when it was checked; a mesh
/// that is not printable is still written, and the verdict says why.
///
/// Errors   bad_input when the clay is empty, the ending unknown or the options cannot be met
///          (decimate.h); disk; interrupted.
/// Threads  as Clay; measuring spreads over TBB. Same bytes and figures for any number of threads.
/// Cost     about 2 us of CPU time for each triangle of the surface, 10 us where triangles are
///          removed; above what the clay takes 200 bytes for each of them at most, 360 with a bound
///          (measured at a million: 185 and 344, docs/printing.md).
Result<ExportReport> export_mesh(const std::filesystem::path& file, const Clay& clay,
                                 const ExportOptions& options, const Progress& progress = {});

/// The whole surface.
inline Result<ExportReport> export_mesh(const std::filesystem::path& file, const Clay& clay,
                                        const Progress& progress = {}) {
  return export_mesh(file, clay, ExportOptions{}, progress);
}

}  // namespace argil::io
