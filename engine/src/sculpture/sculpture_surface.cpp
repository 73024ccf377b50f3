// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/core/no_throw.h"
#include "argil/core/pace.h"
#include "argil/engine/sculpture.h"
#include "argil/engine/surface.h"

namespace argil {

void place(const Placement& placement, TriangleMesh& mesh) {
  for (Vec3& point : mesh.positions) point = placed(placement, point);
  for (Vec3& normal : mesh.normals) normal = rotate(placement.orientation, normal);
}

Result<TriangleMesh> extract_surface(const Sculpture& sculpture, const Progress& progress) {
  return no_throw("the surface", [&]() -> Result<TriangleMesh> {
    TriangleMesh all;
    const Pace pace(progress, "surface");
    const auto count = static_cast<double>(sculpture.piece_count());
    for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
      if (!sculpture.look(n).is_visible) continue;
      const Pace part =
          pace.part(static_cast<double>(n) / count, static_cast<double>(n + 1) / count);
      auto surface = extract_surface(sculpture.clay(n), part.progress());
      if (!surface) return surface;
      TriangleMesh& mesh = surface.value();
      place(sculpture.look(n).placement, mesh);
      const auto base = static_cast<std::uint32_t>(all.positions.size());
      for (Triangle& triangle : mesh.triangles) {
        for (std::uint32_t& corner : triangle) corner += base;
      }
      all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
      all.normals.insert(all.normals.end(), mesh.normals.begin(), mesh.normals.end());
      all.triangles.insert(all.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
    }
    return all;
  });
}

}  // namespace argil
