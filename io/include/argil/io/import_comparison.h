// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/io/prepared_mesh.h"
#include "argil/mesh/part_gaps.h"

namespace argil::io {

struct MeasuredPoint {
  Vec3 at_mm;
  double distance_mm = 0.0;
};

/// How far clay is from the mesh that it was made of. What a repair added is expected there.
struct ImportComparison {
  /// A point farther off is more than an edge that voxels round off.
  static constexpr double kMostVoxelsOff = 1.5;

  double volume_mm3 = 0.0;                 ///< of the clay
  std::optional<double> given_volume_mm3;  ///< as of the PreparedMesh
  /// Fraction of the given volume that rounded edges may change: a tenth of a voxel all over the
  /// surface, but 0.5 to 5 %.
  double volume_margin = 0.0;
  double extent_off_mm = 0.0;  ///< the farthest that a side of the clay's box is from the mesh's

  // The farthest point of each kind; 0 mm where there is none.
  /// Of the mesh, outside the clay: on a wall or tip that the voxels did not hold.
  MeasuredPoint lost;
  /// Of the mesh, within the clay, where the mesh has not solid on both sides: in a gap or cavity
  /// that was filled.
  MeasuredPoint filled;
  /// Of the clay's surface, from the mesh. Not of what bridges an opening.
  MeasuredPoint added;

  bool has_inner_walls = false;              ///< parts overlap or touch: their volumes count twice
  std::int64_t bodies = 0;                   ///< of the clay; specks below a voxel are none
  std::optional<std::int64_t> given_bodies;  ///< of the mesh, where it is closed
  /// Pairs of parts that are one body in the clay, and where they come nearest: less than two
  /// voxels apart. The nearest first. Parts are those that the file names, and pairs of them that
  /// touch or overlap are fused too; else the bodies of the mesh, which join where they do so on
  /// purpose.
  std::vector<mesh::PartGap> fused;
  std::vector<std::string> part_names;  ///< of the parts that `fused` numbers; empty where none is
};

/// Compares volumes, boxes, bodies, parts and some 2000 triangles of each surface with the other.
///
/// Shapes   `surface` is extract_surface of the clay; `is_bridged` as ImportReport has it.
/// Errors   memory.
/// Threads  as Clay. Same numbers for any number of threads.
/// Cost     under a twentieth of the import: a tree over the mesh; more where something is amiss,
/// as
///          part_gaps has it where parts are one in the clay.
Result<ImportComparison> compare_import(const PreparedMesh& prepared, const Clay& clay,
                                        const TriangleMesh& surface, bool is_bridged);

}  // namespace argil::io
