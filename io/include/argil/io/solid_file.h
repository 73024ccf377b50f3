// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"

namespace argil::io {

/// The other solid of a combination; one of the two is there.
struct Operand {
  std::shared_ptr<const Clay> clay;
  std::shared_ptr<const TriangleMesh> mesh;
};

/// What becomes of the openings of a mesh.
enum class Closing {
  as_import,  ///< closed by close_mesh, as `argil import` does
  none        ///< the mesh stays as it is, bit for bit
};

/// Reads the clay of a project (a name that ends in .vdb, in any case of letters), else a mesh. A
/// journal beside that project is not looked at: what counts is what was saved.
/// Errors  as load_project, read_mesh and close_mesh.
Result<Operand> read_operand(const std::filesystem::path& file,
                             Closing closing = Closing::as_import);

}  // namespace argil::io
