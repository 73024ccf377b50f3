// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"

namespace argil::io {

/// Reads OBJ, STL (binary or ASCII), PLY, glTF or 3MF, chosen by the file name's ending. Polygons
/// become triangles; STL and glTF vertices are welded where their bits agree.
///
/// Units    as in the file, except 3MF and glTF, whose units are converted to mm, and glTF's y up
///          to z up; read_framed_mesh (mesh_frame.h) takes others.
/// Errors   bad_input naming file, line or byte, and remedy: unknown ending, empty, truncated, NaN
///          or infinite coordinate, a face naming a missing vertex, a binary STL whose count does
///          not fit its size, no triangles; disk when it cannot be opened.
/// Safety   never crashes, never reads past the data, never allocates more than the file's size
///          needs (MeshTruncation.*).
/// Threads  any.
Result<TriangleMesh> read_mesh(const std::filesystem::path& file);

struct WriteOptions {
  std::string title = "Argil";  ///< stored where the format has a place for it

  /// Red, green and blue of each vertex in sRGB, or none. PLY has a place for them.
  std::vector<std::array<std::uint8_t, 3>> colors = {};

  /// Which part each triangle belongs to, numbered from 0 without gaps, or none for one whole. 3MF
  /// has a place for them: an object for each, named by title and number from 1, and one object of
  /// components, the only item of the build, that holds them where they are.
  std::vector<std::uint32_t> parts = {};

  /// Further names and values for 3MF; other formats leave them out. A name is one that the 3MF
  /// core specification lists, or begins with "argil:".
  std::vector<std::pair<std::string, std::string>> metadata;
};

/// Writes 3MF (unit millimetre, zlib), binary STL, OBJ, binary PLY or GLB by the file name's
/// ending, in mm, coordinates rounded to float. Written to a temporary file beside it, synced, then
/// renamed: an error, an interrupt or a full disk leaves the old file whole.
///
/// Errors   bad_input for an unknown ending, or what the format cannot hold; disk; interrupted.
/// Threads  any.
Result<void> write_mesh(const std::filesystem::path& file, const TriangleMesh& mesh_mm,
                        const WriteOptions& options = {}, const Progress& progress = {});

}  // namespace argil::io
