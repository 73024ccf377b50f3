// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace argil::mesh {

/// Distances of the points of one surface from another, in mm. Mean and rms are over its area.
struct DistanceSummary {
  double max_mm = 0.0;
  double mean_mm = 0.0;
  double rms_mm = 0.0;
};

/// How far a mesh and the clay it was made of lie apart.
///
/// mesh_to_field  |phi| of the clay at the points of the mesh: what the mesh has that the clay has
///                not.
/// field_to_mesh  distance of the points with phi = 0 from the nearest triangle: what the clay has
///                that the mesh has not, such as a spike that was cut off.
struct MeshError {
  DistanceSummary mesh_to_field;
  DistanceSummary field_to_mesh;

  double max_mm() const noexcept {
    return mesh_to_field.max_mm > field_to_mesh.max_mm ? mesh_to_field.max_mm
                                                       : field_to_mesh.max_mm;
  }
  double rms_mm() const noexcept {
    return mesh_to_field.rms_mm > field_to_mesh.rms_mm ? mesh_to_field.rms_mm
                                                       : field_to_mesh.rms_mm;
  }
};

/// What goes with an exported mesh: what it is, of what, and how exact.
struct Certificate {
  MeshError error;
  double volume_change = 0.0;  ///< (volume of the mesh - of the clay's surface) / the latter
  std::int64_t triangles = 0;
  std::int64_t surface_triangles = 0;  ///< of the clay's own surface, before anything was left out
  double voxel_mm = 0.0;               ///< the clay's finest
  double tolerance_voxels = 0.0;       ///< what the clay itself may miss, in finest voxels
  double asked_max_error_mm = 0.0;     ///< 0: not asked
  std::int64_t asked_triangles = 0;    ///< 0: not asked
  std::uint64_t clay_hash = 0;
};

/// The certificate as it stands in the metadata of a 3MF: names with the prefix "argil:" and their
/// values in mm, the shortest decimals that give the number back.
std::vector<std::pair<std::string, std::string>> metadata_of(const Certificate& certificate);

}  // namespace argil::mesh
