// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/io/mesh_frame.h"
#include "argil/mesh/close.h"

namespace argil::io {

/// Finest voxels along a mesh's largest side, where nobody says otherwise.
inline constexpr int kUsualResolution = 256;

struct MeshPreparation {
  double size_mm = 0.0;  ///< of the largest side, > 0; 0: as the file says
  bool repairs = true;   ///< closes openings; else a mesh that has any is refused
  MeshFrame frame = {};  ///< units and axes of the file
};

/// A mesh that import_mesh can make clay of.
struct PreparedMesh {
  TriangleMesh mesh;
  TriangleMesh given;  ///< at that size as the file has it, for comparison with what becomes of it
  FrameReport frame;   ///< of the file, before that size
  mesh::CloseReport closing;  ///< all 0 without repairs
  double scale = 1.0;         ///< that it was brought to its size by, about the file's origin
  double largest_side_mm = 0.0;
  /// Of `given`: parts that overlap count twice. Nothing where it is open, so that it encloses
  /// none.
  std::optional<double> given_volume_mm3;
  /// Of a file of several parts their names (assembly.h), and which of them each triangle of
  /// `given` is of; else empty.
  std::vector<std::string> part_names;
  std::vector<std::uint32_t> part_of;
  std::vector<std::string> notes;  ///< as of ReadAssembly
};

/// Reads a mesh, brings it to size and closes it.
/// Errors  as read_framed_mesh, close_mesh; bad_input for a largest side that is not 0.01 to 10 000
/// mm,
///         which is a mistake about units, and for openings that nobody may close.
Result<PreparedMesh> read_prepared_mesh(const std::filesystem::path& file,
                                        const MeshPreparation& wanted = {});

/// The parts of a file, each ready to become clay of its own, where they stand together.
struct PreparedParts {
  std::vector<std::string> names;  ///< of each, as of placed_parts (assembly.h)
  std::vector<PreparedMesh> parts;
  FrameReport frame;               ///< of the file, before its size
  double largest_side_mm = 0.0;    ///< of all together
  std::vector<std::string> notes;  ///< as of ReadAssembly
};

/// The same for each part by itself: those that a 3MF names, or the bodies of what names none
/// (body_parts.h). The size is that of all together.
/// Errors  as read_prepared_mesh, naming the part; bad_input for more than mesh::kMostParts.
Result<PreparedParts> read_prepared_parts(const std::filesystem::path& file,
                                          const MeshPreparation& wanted = {});

/// Names under which parts can be pieces of a sculpture, one for each: cut where they are too long,
/// numbered where they are none or would be taken.
std::vector<std::string> piece_names(const std::vector<std::string>& part_names);

/// Whether import_mesh would find room for its estimate at this voxel size. Asked before it, tells
/// its refusal of a voxel size, which is somebody's number, from memory that ran out under way.
bool is_likely_to_fit(const PreparedMesh& prepared, double voxel_mm);

}  // namespace argil::io
