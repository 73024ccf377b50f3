// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/mesh_file.h"

#include <utility>
#include <vector>

#include "argil/core/no_throw.h"
#include "argil/io/safe_file.h"

#include "file/file_bytes.h"
#include "mesh_format/mesh_frame_read.h"
#include "mesh_format/mesh_write.h"

namespace argil::io {

Result<TriangleMesh> read_mesh(const std::filesystem::path& file) {
  FrameReport report;
  return read_in_frame(file, {}, report);
}

Result<void> write_mesh(const std::filesystem::path& file, const TriangleMesh& mesh_mm,
                        const WriteOptions& options, const Progress& progress) {
  return no_throw(file.string(), [&]() -> Result<void> {
    const Result<MeshFormat> format = mesh_format_of(file);
    if (!format) return format.error();
    return replace_file(file, [&](const std::filesystem::path& temporary) -> Result<void> {
      OutputFile out(temporary);
      Result<void> written = write_format(out, format.value(), mesh_mm, options, progress);
      // Closed in any case: a full disk may show only now. The first failure is reported.
      Result<void> closed = out.close();
      return written ? closed : written;
    });
  });
}

}  // namespace argil::io
