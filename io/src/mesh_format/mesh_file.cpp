// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/mesh_file.h"

#include <utility>
#include <vector>

#include "argil/core/no_throw.h"
#include "argil/io/assembly.h"
#include "argil/io/safe_file.h"

#include "file/file_bytes.h"
#include "file/temporary_name.h"
#include "mesh_format/3mf_write.h"
#include "mesh_format/mesh_frame_read.h"
#include "mesh_format/mesh_write.h"

namespace argil::io {
namespace {

template <class Write>
Result<void> write_to(const std::filesystem::path& file, const Write& write) {
  return replace_file(file, [&](const std::filesystem::path& temporary) -> Result<void> {
    OutputFile out(temporary);
    Result<void> written = write(out);
    // Closed in any case: a full disk may show only now. The first failure is reported.
    Result<void> closed = out.close();
    return written ? closed : written;
  });
}

}  // namespace

Result<TriangleMesh> read_mesh(const std::filesystem::path& file) {
  auto read = read_in_frame(file, {});
  if (!read) return read.error();
  return no_throw(file.string(), [&]() -> Result<TriangleMesh> {
    return joined(std::move(read.value().assembly));
  });
}

Result<void> write_mesh(const std::filesystem::path& file, const TriangleMesh& mesh_mm,
                        const WriteOptions& options, const Progress& progress) {
  return no_throw(file.string(), [&]() -> Result<void> {
    const Result<MeshFormat> format = mesh_format_of(file);
    if (!format) return format.error();
    return write_to(file, [&](OutputFile& out) {
      return write_format(out, format.value(), mesh_mm, options, progress);
    });
  });
}

Result<void> write_assembly(const std::filesystem::path& file, const Assembly& assembly,
                            const Progress& progress) {
  return no_throw(file.string(), [&]() -> Result<void> {
    if (auto holds = check_holds_parts(file); !holds) return holds;
    ThreemfModel model{title_of(file), {}, {}, &assembly.items};
    for (const AssemblyObject& object : assembly.objects) {
      if (Result<void> fits = check_writable(object.mesh); !fits) return fits;
      model.objects.push_back({object.name, object.color, &object.mesh});
    }
    return write_to(file, [&](OutputFile& out) { return write_3mf(out, model, progress); });
  });
}

}  // namespace argil::io
