// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/small_components.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"

namespace argil::mesh {

SmallComponents drop_small_components(TriangleMesh& mesh, double voxel_mm) {
  assert(voxel_mm > 0.0);
  const EdgeTable edges(mesh);
  const MeshParts parts = mesh_parts(mesh, edges, false);
  const std::vector<double> volumes = part_volumes(mesh, parts);
  // The field resolves no shape smaller than a voxel: such parts are what extraction leaves where
  // the clay is thinner.
  const double least = voxel_mm * voxel_mm * voxel_mm;
  const auto is_small = [&](double volume) { return std::abs(volume) < least; };
  SmallComponents small;
  small.count = std::count_if(volumes.begin(), volumes.end(), is_small);
  if (small.count == 0) return small;
  const auto in_small = [&](std::size_t t) { return is_small(volumes[parts.of_triangle[t]]); };
  small.mesh = only_triangles(mesh, in_small);
  mesh = only_triangles(mesh, [&](std::size_t t) { return !in_small(t); });
  return small;
}

}  // namespace argil::mesh
