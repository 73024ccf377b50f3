// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/mesh_file.h"

#include <vector>

#include "argil/core/no_throw.h"
#include "argil/io/safe_file.h"

#include "file/file_bytes.h"
#include "format/mesh_read.h"
#include "format/mesh_write.h"

namespace argil::io {
namespace {

Result<TriangleMesh> parse(MeshFormat format, std::span<const std::byte> bytes,
                           const std::string& name) {
  switch (format) {
    case MeshFormat::obj:
      return parse_obj(bytes, name);
    case MeshFormat::stl:
      return parse_stl(bytes, name);
    case MeshFormat::ply:
      return parse_ply(bytes, name);
    case MeshFormat::glb:
      return parse_glb(bytes, name);
    case MeshFormat::threemf:
      break;
  }
  return parse_3mf(bytes, name);
}

}  // namespace

Result<TriangleMesh> read_mesh(const std::filesystem::path& file) {
  return no_throw(file.string(), [&]() -> Result<TriangleMesh> {
    const Result<MeshFormat> format = mesh_format_of(file);
    if (!format) return format.error();
    const Result<UnwrittenBytes> bytes = read_file_bytes(file);
    if (!bytes) return bytes.error();
    if (bytes.value().empty()) {
      return Error{ErrorKind::bad_input, file.string() + " is empty; export the mesh again"};
    }
    return parse(format.value(), bytes.value(), file.string());
  });
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
