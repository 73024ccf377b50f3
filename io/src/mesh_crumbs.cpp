// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_crumbs.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh_edges.h"

namespace argil::io {

std::int64_t drop_crumbs(TriangleMesh& mesh, double voxel_mm) {
  const EdgeTable edges(mesh);
  const MeshParts parts = mesh_parts(mesh, edges, false);
  const std::vector<double> volumes = part_volumes(mesh, parts);
  const double least = voxel_mm * voxel_mm * voxel_mm;
  const auto is_crumb = [&](double volume) { return std::abs(volume) < least; };
  const std::int64_t crumbs = std::count_if(volumes.begin(), volumes.end(), is_crumb);
  if (crumbs == 0) return 0;
  TriangleMesh kept;
  std::vector<std::uint32_t> number(mesh.positions.size(), kNoPart);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (is_crumb(volumes[parts.of_triangle[i]])) continue;
    Triangle t = mesh.triangles[i];
    for (std::uint32_t& v : t) {
      if (number[v] == kNoPart) {
        number[v] = static_cast<std::uint32_t>(kept.positions.size());
        kept.positions.push_back(mesh.positions[v]);
      }
      v = number[v];
    }
    kept.triangles.push_back(t);
  }
  mesh = std::move(kept);
  return crumbs;
}

}  // namespace argil::io
