// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/rounding.h"

#include "mesh_format/chunks.h"

namespace argil::io {

Result<void> write_obj(Chunks& chunks, const TriangleMesh& mesh) {
  chunks.text("# Argil, unit millimetre\n");
  Result<void> written = write_each(chunks, mesh.positions, [&](const Vec3& p, Piece& to) {
    const auto [x, y, z] = mesh::floats_of(p);
    to.text("v ").number(x).text(" ").number(y).text(" ").number(z).text("\n");
  });
  if (!written) return written;
  return write_each(chunks, mesh.triangles, [&](const Triangle& t, Piece& to) {
    // OBJ counts vertices from 1.
    to.text("f ").number(t[0] + 1ULL).text(" ").number(t[1] + 1ULL).text(" ");
    to.number(t[2] + 1ULL).text("\n");
  });
}

}  // namespace argil::io
