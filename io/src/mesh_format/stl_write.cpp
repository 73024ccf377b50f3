// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cassert>
#include <cstdint>
#include <string>

#include "argil/mesh/rounding.h"

#include "mesh_format/chunks.h"

namespace argil::io {

Result<void> write_stl(Chunks& chunks, const TriangleMesh& mesh) {
  std::string header = "Argil binary STL, unit millimetre";  // never beginning with "solid"
  assert(header.size() <= 80 && !header.starts_with("solid"));
  header.resize(80);
  chunks.text(header).raw(static_cast<std::uint32_t>(mesh.triangles.size()));
  return write_each(chunks, mesh.triangles, [&](const Triangle& t, Piece& to) {
    const std::array<std::array<float, 3>, 3> corners{mesh::floats_of(mesh.positions[t[0]]),
                                                      mesh::floats_of(mesh.positions[t[1]]),
                                                      mesh::floats_of(mesh.positions[t[2]])};
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      // The normal is of the rounded corners, which are what the file holds.
      p[i] = {double{corners[i][0]}, double{corners[i][1]}, double{corners[i][2]}};
    }
    to.raw(mesh::floats_of(normalized(cross(p[1] - p[0], p[2] - p[0])))).raw(corners);
    to.raw(std::uint16_t{0});
  });
}

}  // namespace argil::io
