// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_crumbs.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh_compact.h"
#include "mesh_edges.h"

namespace argil::io {

Crumbs drop_crumbs(TriangleMesh& mesh, double voxel_mm) {
  const EdgeTable edges(mesh);
  const MeshParts parts = mesh_parts(mesh, edges, false);
  const std::vector<double> volumes = part_volumes(mesh, parts);
  const double least = voxel_mm * voxel_mm * voxel_mm;
  const auto is_crumb = [&](double volume) { return std::abs(volume) < least; };
  Crumbs crumbs;
  crumbs.count = std::count_if(volumes.begin(), volumes.end(), is_crumb);
  if (crumbs.count == 0) return crumbs;
  const auto in_crumb = [&](std::size_t t) { return is_crumb(volumes[parts.of_triangle[t]]); };
  crumbs.mesh = only_triangles(mesh, in_crumb);
  mesh = only_triangles(mesh, [&](std::size_t t) { return !in_crumb(t); });
  return crumbs;
}

}  // namespace argil::io
