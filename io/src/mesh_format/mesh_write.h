// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/io/mesh_file.h"

#include "file/file_bytes.h"

namespace argil::io {

enum class MeshFormat { obj, stl, ply, glb, threemf };

/// The format a file name's ending means, in any case of letters.
/// Errors  bad_input naming the endings that are known.
Result<MeshFormat> mesh_format_of(const std::filesystem::path& file);

/// Whether the format can hold parts by their names.
/// Errors  bad_input for an ending other than .3mf.
Result<void> check_holds_parts(const std::filesystem::path& file);

/// Whether any format can hold a mesh.
/// Errors  bad_input for coordinates no float can hold, missing vertices, no or too many triangles.
Result<void> check_writable(const TriangleMesh& mesh_mm);

/// Whether the format can hold so large a mesh as one object, before anything is written.
/// Errors  bad_input; interrupted.
/// Cost    as check_3mf_size (3mf_write.h).
Result<void> check_size(MeshFormat format, const TriangleMesh& mesh_mm, const Progress& progress);

/// Writes `mesh_mm` to `out`, rounding to float on the way. The order of vertices and triangles is
/// kept; the same mesh gives the same bytes.
/// Errors  as check_writable; bad_input for what the format cannot hold, which of a 3MF shows when
/// part of it is
///         in `out`; interrupted. Disk errors stay in `out`.
Result<void> write_format(OutputFile& out, MeshFormat format, const TriangleMesh& mesh_mm,
                          const WriteOptions& options, const Progress& progress);

}  // namespace argil::io
