// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/io/assembly.h"

#include "file/unwritten_bytes.h"

namespace argil::io {

/// Triangles, and vertices, of all placements of meshes: a file may place one object in
/// another again and again, and a small one could so ask for 2^60 triangles.
inline constexpr std::size_t kMostPlaced = 100'000'000;

/// Reads a file that another names, by its name in the same folder.
using ReadBeside = std::function<Result<UnwrittenBytes>(const std::string& file)>;

/// How long the unit of a file's numbers is, for formats that state one.
struct StatedUnit {
  std::optional<double> instead_mm;  ///< taken instead of what the file states
  double mm = 1.0;                   ///< what the file states, set by the reader
};

// The mesh formats, from bytes in memory. `name` is the file as errors should call it.
//
// Errors   bad_input "NAME:LINE: ..." for text, "NAME: byte N: ..." for binary data.
// Safety   never reads outside `bytes`; memory grows with what was really read, so a header that
//          promises more than the file holds costs nothing (tests: MeshTruncation.*).
Result<TriangleMesh> parse_obj(std::span<const std::byte> bytes, const std::string& name);
Result<TriangleMesh> parse_stl(std::span<const std::byte> bytes, const std::string& name);
Result<TriangleMesh> parse_ply(std::span<const std::byte> bytes, const std::string& name);
/// Objects and places in mm: the unit of each model part is applied. `unit` is that of the part the
/// archive starts from.
struct ThreemfAssembly {
  Assembly assembly;
  std::vector<std::string> notes;  ///< as of ReadAssembly
};
Result<ThreemfAssembly> parse_3mf(std::span<const std::byte> bytes, const std::string& name,
                                  StatedUnit& unit);
/// Positions in mm with z up: the file has metres and y up. Nodes are placed as it says, skins and
/// shapes as they are at rest; vertices at one point are welded. Materials, lines and points are
/// passed over.
Result<TriangleMesh> parse_glb(std::span<const std::byte> bytes, const std::string& name);
/// The same in another unit than metres.
Result<TriangleMesh> parse_glb_in(std::span<const std::byte> bytes, const std::string& name,
                                  const ReadBeside& beside, double unit_mm);
/// As parse_glb_in for the form in text, whose buffers are encoded in it or lie beside it.
Result<TriangleMesh> parse_gltf_in(std::span<const std::byte> bytes, const std::string& name,
                                   const ReadBeside& beside, double unit_mm);

}  // namespace argil::io
