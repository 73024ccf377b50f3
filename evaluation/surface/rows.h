// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "chart/sheet.h"

namespace argil::evaluation {

/// What makes the surface, and of which clay.
enum class Mesher {
  argil,     ///< ours, the surface everywhere at the finest voxel
  openvdb,   ///< volumeToMesh of the same field
  blender,   ///< Blender's voxel remesher of the surface that `argil` makes, at the same voxel
  adaptive,  ///< ours, the clay as it is kept: as coarse as its tolerance allows
};
const char* mesher_name(Mesher mesher);

/// Where a vertex of ours lies: on an edge of the lattice, or off it, because it kept away from an
/// end of its edge and went back to the surface, or is the centre of a loop (docs/surface.md).
enum class VertexKind : std::uint8_t { on_edge, off_edge };
inline constexpr std::size_t kVertexKinds = 2;

/// One extraction of a whole surface.
///
/// Units  errors are distances of vertices to the exact body in h^2 / R_curv, where h is the finest
///        voxel and R_curv the smallest radius of curvature: that of the ball, that of the tube.
struct SurfaceRow {
  std::string scene;
  Mesher mesher = Mesher::argil;
  double detail = 0.0;            ///< R/h, R the radius of the ball or of the torus' ring
  double curvature_voxels = 0.0;  ///< R_curv/h
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
  double error_max = 0.0;
  double error_rms = 0.0;
  std::array<double, kVertexKinds> kind_error_max{};  ///< argil only
  double off_edge_fraction = 0.0;                     ///< argil only: of the vertices
  double least_angle_deg = 0.0;
  double sliver_fraction = 0.0;  ///< of the triangles: with an angle under 5 degrees
  double cpu_us = 0.0;           ///< all threads, median of the runs; Blender's operator alone
  double wall_us = 0.0;
  std::uint64_t hash = 0;  ///< of the positions

  double error_voxels() const noexcept { return error_max / curvature_voxels; }
  double error_of_radius() const noexcept {
    return error_max / (curvature_voxels * curvature_voxels);
  }
  double cpu_us_per_vertex() const noexcept { return cpu_us / static_cast<double>(vertices); }
};

struct SurfaceResult {
  std::vector<SurfaceRow> rows;
  std::vector<std::string> skipped;  ///< what is not there, and why
};

/// Errors  interrupted; disk. Where Blender is not there or fails it is named among what was
///         skipped.
Result<SurfaceResult> measure_surface(bool quick, const Progress& progress);
std::string surface_csv(const std::vector<SurfaceRow>& rows);

/// The chart of the surface as a gnuplot script that carries its data.
Script surface_script(const std::vector<SurfaceRow>& rows);

}  // namespace argil::evaluation
