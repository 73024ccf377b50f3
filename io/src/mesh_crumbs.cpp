// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_crumbs.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh_edges.h"

namespace argil::io {

namespace {

/// Copies the triangles for which `is_wanted` to a mesh of their own, in order.
template <class IsWanted>
TriangleMesh only(const TriangleMesh& mesh, const IsWanted& is_wanted) {
  TriangleMesh kept;
  std::vector<std::uint32_t> number(mesh.positions.size(), kNoPart);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!is_wanted(i)) continue;
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
  return kept;
}

}  // namespace

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
  crumbs.mesh = only(mesh, in_crumb);
  mesh = only(mesh, [&](std::size_t t) { return !in_crumb(t); });
  return crumbs;
}

}  // namespace argil::io
