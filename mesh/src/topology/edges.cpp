// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/edges.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>
#include <vector>

namespace argil::mesh {
namespace {

bool repeats_vertex(const Triangle& t) noexcept {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

}  // namespace

/// All half-edges that take part, grouped by the lower vertex of their edge; within a group by the
/// higher one. A counting sort: groups have about three members, so sorting them costs nothing.
std::vector<HalfEdge> EdgeTable::by_lower_vertex() const {
  std::vector<std::uint32_t> begin(mesh_.positions.size() + 1, 0);
  const auto count = static_cast<HalfEdge>(3 * mesh_.triangles.size());
  const auto each = [&](const auto& act) {
    for (HalfEdge h = 0; h < count; ++h) {
      if (!repeats_vertex(mesh_.triangles[h / 3])) act(h, std::min(from(h), to(h)));
    }
  };
  each([&](HalfEdge, std::uint32_t lower) { ++begin[lower + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<HalfEdge> sorted(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  each([&](HalfEdge h, std::uint32_t lower) { sorted[next[lower]++] = h; });
  std::vector<std::pair<std::uint32_t, HalfEdge>> group;  // the higher vertex first
  for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
    group.clear();
    for (std::uint32_t i = begin[v]; i < begin[v + 1]; ++i) {
      group.emplace_back(std::max(from(sorted[i]), to(sorted[i])), sorted[i]);
    }
    std::sort(group.begin(), group.end());
    for (std::size_t i = 0; i < group.size(); ++i) sorted[begin[v] + i] = group[i].second;
  }
  return sorted;
}

EdgeTable::EdgeTable(const TriangleMesh& mesh) : mesh_(mesh) {
  // Half-edges are numbered 3 t + k in 32 bits.
  assert(mesh.triangles.size() <= 0xffffffff / 3);
  uses_ = by_lower_vertex();
  // Triangles that name a vertex twice keep this: no edge.
  edge_of_.assign(3 * mesh.triangles.size(), 0xffffffff);
  for (std::size_t i = 0; i < uses_.size(); ++i) {
    const HalfEdge h = uses_[i];
    const bool same = i > 0 && std::minmax({from(h), to(h)}) ==
                                   std::minmax({from(uses_[i - 1]), to(uses_[i - 1])});
    if (!same) first_use_.push_back(static_cast<std::uint32_t>(i));
    edge_of_[h] = static_cast<std::uint32_t>(first_use_.size() - 1);
  }
  first_use_.push_back(static_cast<std::uint32_t>(uses_.size()));
  assert(std::is_sorted(first_use_.begin(), first_use_.end()));
}

DisjointSets::DisjointSets(std::size_t count) : parent_(count) {
  std::iota(parent_.begin(), parent_.end(), 0U);
}

std::uint32_t DisjointSets::find(std::uint32_t i) noexcept {
  assert(i < parent_.size());
  while (parent_[i] != i) {
    parent_[i] = parent_[parent_[i]];
    i = parent_[i];
  }
  return i;
}

/// The lower root stays, whatever the sizes: callers rely on each set being named by its first
/// member. Path halving alone keeps the cost logarithmic (R. Tarjan, J. van Leeuwen, 1984).
void DisjointSets::unite(std::uint32_t a, std::uint32_t b) noexcept {
  a = find(a);
  b = find(b);
  parent_[std::max(a, b)] = std::min(a, b);
  assert(parent_[std::min(a, b)] == std::min(a, b));
}

MeshParts mesh_parts(const TriangleMesh& mesh, const EdgeTable& edges, bool cut_at_nonmanifold) {
  assert(edges.is_of(mesh));
  DisjointSets sets(mesh.triangles.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::span<const HalfEdge> uses = edges.uses(e);
    if (cut_at_nonmanifold && uses.size() > 2) continue;
    for (const HalfEdge h : uses) sets.unite(uses[0] / 3, h / 3);
  }
  MeshParts parts;
  parts.of_triangle.assign(mesh.triangles.size(), kNoPart);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!edges.takes_part(t)) continue;
    const std::uint32_t first = sets.find(t);  // the smallest, so it has its number already
    parts.of_triangle[t] = first == t ? parts.count++ : parts.of_triangle[first];
  }
  return parts;
}

std::vector<double> part_volumes(const TriangleMesh& mesh, const MeshParts& parts) {
  assert(parts.of_triangle.size() == mesh.triangles.size());
  // Relative to the centre: far from the origin the terms would cancel and lose their digits.
  const Vec3 o = bounds(mesh).center();
  std::vector<double> volumes(parts.count, 0.0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (parts.of_triangle[i] == kNoPart) continue;
    assert(parts.of_triangle[i] < parts.count);
    const Triangle& t = mesh.triangles[i];
    volumes[parts.of_triangle[i]] +=
        dot(mesh.positions[t[0]] - o, cross(mesh.positions[t[1]] - o, mesh.positions[t[2]] - o)) /
        6.0;
  }
  return volumes;
}

}  // namespace argil::mesh
