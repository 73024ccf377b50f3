// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace argil::mesh {

/// Distances of the points of one surface from another, in mm. Mean and rms are over its area, the
/// greatest is over all points that were looked at.
struct DistanceSummary {
  double max_mm = 0.0;
  double mean_mm = 0.0;
  double rms_mm = 0.0;
  /// Spread over the surface; where the error may be greatest more points were looked at.
  std::int64_t samples = 0;
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

  /// The greater of both ways: the Hausdorff distance, as far as it was measured.
  double max_mm() const noexcept {
    return mesh_to_field.max_mm > field_to_mesh.max_mm ? mesh_to_field.max_mm
                                                       : field_to_mesh.max_mm;
  }
  /// The greater of both ways, which is not the rms over both surfaces together.
  double rms_mm() const noexcept {
    return mesh_to_field.rms_mm > field_to_mesh.rms_mm ? mesh_to_field.rms_mm
                                                       : field_to_mesh.rms_mm;
  }
};

/// What goes with an exported mesh: what it is, of what, and how exact. All of it is about the mesh
/// as the file holds it, coordinates rounded to float.
struct Certificate {
  MeshError error;
  /// (volume of the mesh - of the clay's surface) / the latter: 0.01 is one per cent too large.
  double volume_change = 0.0;
  std::int64_t triangles = 0;
  /// Of the clay's own surface, before anything was left out.
  std::int64_t surface_triangles = 0;
  /// The clay's finest, in mm: what `error` is to be compared with.
  double voxel_mm = 0.0;
  /// What the clay itself may miss where it stores less detail, in finest voxels
  /// (ClayOptions::tolerance_voxels). Not part of `error`, which is against the clay as stored.
  double tolerance_voxels = 0.0;
  /// No point of the mesh or of the clay is farther from the other, which is proven and not
  /// measured; components that were left out do not count. 0: nothing is, `error` is of samples.
  double proven_max_mm = 0.0;
  /// What was asked for; 0: not asked.
  double asked_max_error_mm = 0.0;
  std::int64_t asked_triangles = 0;
  /// Clay::hash of the clay that it was made of.
  std::uint64_t clay_hash = 0;
};

/// The certificate as it stands in the metadata of a 3MF: names with the prefix "argil:" and their
/// values in mm, the shortest decimals that give the number back. What was not asked is left out;
/// "argil:units" says "mm", and the hash is in hexadecimal (hash_text).
///
/// Determinism  same names in the same order every time; no locale changes the decimals.
std::vector<std::pair<std::string, std::string>> metadata_of(const Certificate& certificate);

}  // namespace argil::mesh
