// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"

namespace argil::test {

/// One small valid file of a format, in memory, with its reader.
struct MeshSample {
  std::string id;    ///< "obj", "stl_binary", ...
  std::string name;  ///< what errors call it
  std::string bytes;
  std::function<Result<TriangleMesh>(std::span<const std::byte>, const std::string&)> parse;

  /// Whether the first `length` bytes are a smaller valid file, or one whose loss cannot be seen:
  /// a last number that is still a number. docs/files.md lists these cases.
  std::function<bool(std::size_t length)> may_pass_cut;
};

/// The same tetrahedron in every format and flavour that can be read.
std::vector<MeshSample> mesh_samples();

std::ostream& operator<<(std::ostream& out, const MeshSample& sample);

}  // namespace argil::test
