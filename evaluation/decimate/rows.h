// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/mesh/certificate.h"

#include "chart/sheet.h"

namespace argil::evaluation {

/// What removes triangles; `none`: the whole surface as it was.
enum class Decimator { argil, openmesh, cgal, meshoptimizer, none };
const char* decimator_name(Decimator decimator);

/// What a decimator, but none, leaves of the whole surface of a clay: `triangles` or a few fewer.
/// Errors  bad_input where it cannot, or is not there.
Result<TriangleMesh> decimated(Decimator decimator, const Clay& clay, const TriangleMesh& surface,
                               std::int64_t triangles);

/// One run from the whole surface of a piece to a fraction of its triangles.
struct DecimateRow {
  std::string piece;
  Decimator decimator = Decimator::none;
  double fraction = 1.0;  ///< asked for
  std::int64_t triangles = 0;
  double voxel_mm = 0.0;  ///< the clay's finest
  mesh::MeshError error;  ///< against the clay's field
  bool printable = false;
  std::int64_t self_intersections = 0;
  double cpu_s = 0.0;  ///< all threads, from mesh to mesh; median of the runs
  std::uint64_t hash = 0;

  /// The larger mean of the two directions, mesh to field and back, in finest voxels.
  double mean_voxels() const noexcept;
};

struct DecimateResult {
  std::vector<DecimateRow> rows;
  std::vector<std::string> skipped;  ///< what could not be had, and why
};

/// A ball with waves, a block with sharp rims and, unless `project` is "", that project.
Result<DecimateResult> measure_decimate(bool quick, const std::filesystem::path& project,
                                        const Progress& progress);
std::string decimate_csv(const std::vector<DecimateRow>& rows);

/// The chart of removing triangles as a gnuplot script that carries its data.
Script decimate_script(const std::vector<DecimateRow>& rows);

}  // namespace argil::evaluation
