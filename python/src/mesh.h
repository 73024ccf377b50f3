// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "argil/core/triangle_mesh.h"
#include "argil/mesh/printer.h"

#include "binding.h"

namespace argil::python {

/// A mesh that never changes, so that its arrays can be shown in place and any thread may read it.
class SharedMesh {
 public:
  explicit SharedMesh(TriangleMesh mesh) : mesh_(std::move(mesh)) {}
  const TriangleMesh& mesh() const noexcept { return mesh_; }

 private:
  const TriangleMesh mesh_;
};

void add_meshes(py::module_& module);

/// What a printer asks for: of the profile in `file` ("": of none), and a least wall and a least
/// gap that count more where they are above 0.
mesh::Printer printer_of(const std::string& file, double min_wall_mm, double min_gap_mm,
                         double overhang_deg);

}  // namespace argil::python
