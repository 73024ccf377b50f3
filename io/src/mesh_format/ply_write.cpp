// SPDX-License-Identifier: GPL-3.0-or-later
#include <cassert>
#include <cstdint>

#include "argil/mesh/rounding.h"

#include "mesh_format/chunks.h"

namespace argil::io {

Result<void> write_ply(Chunks& chunks, const TriangleMesh& mesh, const WriteOptions& options) {
  const bool has_colors = !options.colors.empty();
  assert(!has_colors || options.colors.size() == mesh.positions.size());
  const Vec3* const first = mesh.positions.data();
  // PLY has no field for a unit; a comment says it.
  chunks.text("ply\nformat binary_little_endian 1.0\ncomment Argil, unit millimetre\n");
  chunks.text("element vertex ").number(mesh.positions.size());
  chunks.text("\nproperty float x\nproperty float y\nproperty float z\n");
  if (has_colors) {
    chunks.text("property uchar red\nproperty uchar green\nproperty uchar blue\n");
  }
  chunks.text("element face ");
  chunks.number(mesh.triangles.size());
  chunks.text("\nproperty list uchar int vertex_indices\nend_header\n");
  Result<void> written = write_each(chunks, mesh.positions, [&](const Vec3& p, Piece& to) {
    to.raw(mesh::floats_of(p));
    if (has_colors) to.raw(options.colors[static_cast<std::size_t>(&p - first)]);
  });
  if (!written) return written;
  return write_each(chunks, mesh.triangles,
                    [](const Triangle& t, Piece& to) { to.raw(std::uint8_t{3}).raw(t); });
}

}  // namespace argil::io
