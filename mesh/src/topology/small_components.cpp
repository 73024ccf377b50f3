// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/small_components.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"

namespace argil::mesh {

namespace {

/// Where no two components meet in a vertex, as mesh_parts in a quarter of the time.
MeshParts parts_by_vertices(const TriangleMesh& mesh) {
  DisjointSets sets(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    sets.unite(t[0], t[1]);
    sets.unite(t[0], t[2]);
  }
  std::vector<std::uint32_t> part_of(mesh.positions.size(), kNoPart);  // by a set's name
  MeshParts parts;
  parts.of_triangle.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    std::uint32_t& part = part_of[sets.find(t[0])];
    if (part == kNoPart) part = parts.count++;
    parts.of_triangle.push_back(part);
  }
  return parts;
}

}  // namespace

SmallComponents drop_small_components(TriangleMesh& mesh, double voxel_mm) {
  assert(voxel_mm > 0.0);
  const MeshParts parts = parts_by_vertices(mesh);
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

std::int64_t put_back(TriangleMesh& mesh, SmallComponents& small,
                      std::span<const std::uint32_t> vertices) {
  assert(mesh.normals.empty() && small.mesh.normals.empty());
  std::vector<bool> is_asked(small.mesh.positions.size(), false);
  for (const std::uint32_t v : vertices) is_asked[v] = true;
  const MeshParts parts = parts_by_vertices(small.mesh);
  std::vector<bool> goes_back(parts.count, false);
  for (std::size_t t = 0; t < parts.of_triangle.size(); ++t) {
    const Triangle& of = small.mesh.triangles[t];
    if (std::any_of(of.begin(), of.end(), [&](std::uint32_t v) { return is_asked[v]; })) {
      goes_back[parts.of_triangle[t]] = true;
    }
  }
  const auto is_back = [&](std::size_t t) { return goes_back[parts.of_triangle[t]]; };
  const TriangleMesh back = only_triangles(small.mesh, is_back);
  small.mesh = only_triangles(small.mesh, [&](std::size_t t) { return !is_back(t); });
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), back.positions.begin(), back.positions.end());
  for (const auto& [a, b, c] : back.triangles) {
    mesh.triangles.push_back({first + a, first + b, first + c});
  }
  const std::int64_t count = std::count(goes_back.begin(), goes_back.end(), true);
  small.count -= count;
  assert(small.count >= 0);
  return count;
}

}  // namespace argil::mesh
