// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/solid_file.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

#include "argil/core/no_throw.h"
#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"
#include "argil/mesh/close.h"

#include "file/file_error.h"

namespace argil::io {
namespace {

bool is_project(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".vdb";
}

}  // namespace

Result<Operand> read_operand(const std::filesystem::path& file, Closing closing) {
  return no_throw(file.string(), [&]() -> Result<Operand> {
    if (is_project(file)) {
      auto clay = load_project(file);
      if (!clay) return clay.error();
      return Operand{std::make_shared<const Clay>(std::move(clay).value()), nullptr};
    }
    auto mesh = read_mesh(file);
    if (!mesh) return mesh.error();
    TriangleMesh kept = std::move(mesh).value();
    if (closing == Closing::as_import) {
      // A field needs an inside; with a hash the bits that the step was made with count.
      auto closed = mesh::close_mesh(kept);
      if (!closed) return file_error(closed.error().kind, file, ": " + closed.error().message);
      kept = std::move(closed).value().mesh;
    }
    return Operand{nullptr, std::make_shared<const TriangleMesh>(std::move(kept))};
  });
}

}  // namespace argil::io
