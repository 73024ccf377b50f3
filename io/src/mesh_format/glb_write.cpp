// SPDX-License-Identifier: GPL-3.0-or-later
// Binary glTF 2.0: one node with one mesh, its vertices as floats and its indices as
// 32-bit numbers.
#include <array>
#include <cassert>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>

#include <nlohmann/json.hpp>

#include "argil/mesh/rounding.h"

#include "mesh_format/chunks.h"

namespace argil::io {
namespace {

/// A corner of the box as JSON, exactly. glTF requires the box of the positions, and means that of
/// the floats: it is rounded as they are.
std::string corner_text(const Vec3& corner) {
  std::string text = "[";
  for (std::size_t a = 0; a < 3; ++a) {
    std::array<char, 32> digits;
    const double value = double{static_cast<float>(corner[a])};
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    text.append(a == 0 ? "" : ",").append(digits.data(), end);
  }
  return text + "]";
}

/// Vertices stay in mm with z up, bit for bit; a node brings them to glTF's metres and y up.
std::string glb_json(const TriangleMesh& mesh, const WriteOptions& options) {
  const std::string vertices = std::to_string(mesh.positions.size());
  const std::string points = std::to_string(12 * mesh.positions.size());
  const std::string triangles = std::to_string(12 * mesh.triangles.size());
  Box3 box;
  for (const Vec3& p : mesh.positions) box.include(p);
  std::string text =
      R"({"asset":{"version":"2.0","generator":"Argil"},"scene":0,)"
      R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":)" +
      nlohmann::json(options.title).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) +
      R"(,"matrix":[0.001,0,0,0,0,0,-0.001,0,0,0.001,0,0,0,0,0,1]}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
      R"("buffers":[{"byteLength":)" +
      std::to_string(12 * (mesh.positions.size() + mesh.triangles.size())) +
      R"(}],"bufferViews":[{"buffer":0,"byteLength":)" + points +
      R"(,"target":34962},{"buffer":0,"byteOffset":)" + points + R"(,"byteLength":)" + triangles +
      R"(,"target":34963}],)" + R"("accessors":[{"bufferView":0,"componentType":5126,"count":)" +
      vertices + R"(,"type":"VEC3","min":)" + corner_text(box.min) + R"(,"max":)" +
      corner_text(box.max) + R"(},{"bufferView":1,"componentType":5125,"count":)" +
      std::to_string(3 * mesh.triangles.size()) + R"(,"type":"SCALAR"}]})";
  // Chunks are multiples of four bytes; JSON is padded with blanks.
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return text;
}

}  // namespace

Result<void> write_glb(Chunks& chunks, const TriangleMesh& mesh, const WriteOptions& options) {
  const std::string json = glb_json(mesh, options);
  assert(json.size() % 4 == 0);
  const std::size_t binary = 12 * (mesh.positions.size() + mesh.triangles.size());
  const std::size_t whole = 12 + 8 + json.size() + 8 + binary;
  if (whole > std::numeric_limits<std::uint32_t>::max()) {
    return Error{ErrorKind::bad_input,
                 "the mesh takes more than the 4 GB of a GLB file; write .stl or .ply"};
  }
  const auto size = [](std::size_t bytes) { return static_cast<std::uint32_t>(bytes); };
  chunks.text("glTF").raw(std::uint32_t{2}).raw(size(whole));
  chunks.raw(size(json.size())).text("JSON").text(json);
  chunks.raw(size(binary)).text(std::string_view("BIN\0", 4));
  Result<void> written = write_each(chunks, mesh.positions,
                                    [](const Vec3& p, Piece& to) { to.raw(mesh::floats_of(p)); });
  if (!written) return written;
  return write_each(chunks, mesh.triangles, [](const Triangle& t, Piece& to) { to.raw(t); });
}

}  // namespace argil::io
