// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

// Notation: half-edge 3 t + k runs from corner k of triangle t to its next corner, and stands for
// that corner too. A component is what hangs together by edges.
using HalfEdge = std::uint32_t;

inline HalfEdge next_in_triangle(HalfEdge h) noexcept { return h % 3 == 2 ? h - 2 : h + 1; }
inline std::size_t triangle_of(HalfEdge h) noexcept { return h / 3; }

/// Which triangles meet at which edge, for any triangle soup, by index: vertices in one place count
/// as different until they are welded. Triangles that name a vertex twice take no part.
///
/// Shapes       every index must exist; at most 2^32 / 3 triangles. Positions are not looked at.
/// Determinism  edges and their uses are sorted: the same table every time.
/// Threads      made on the caller's alone; reading from any. May throw std::bad_alloc.
/// Cost         linear; 30 ns per triangle (measured on 0.5 M triangles, one core); 30 bytes each.
class EdgeTable {
 public:
  /// Refers to `mesh`, which must outlive it and keep its triangles; positions may move.
  explicit EdgeTable(const TriangleMesh& mesh);

  /// Edges, sorted by their lower and then their higher vertex.
  std::size_t size() const noexcept { return first_use_.size() - 1; }
  /// The half-edges along an edge, either way, in ascending order; at least one. One is a boundary,
  /// two that run opposite ways are as on a solid, and three or more are not manifold.
  std::span<const HalfEdge> uses(std::size_t edge) const noexcept {
    assert(edge < size());
    return {uses_.data() + first_use_[edge], first_use_[edge + 1] - first_use_[edge]};
  }

  /// The edge a half-edge lies on; `size()` or more when its triangle takes no part.
  std::size_t edge_of(HalfEdge h) const noexcept {
    assert(h < edge_of_.size());
    return edge_of_[h];
  }
  /// Whether the triangle names three different vertices.
  bool takes_part(std::size_t triangle) const noexcept { return edge_of_[3 * triangle] < size(); }

  /// Whether this is the table of that very mesh.
  bool is_of(const TriangleMesh& mesh) const noexcept {
    return &mesh == &mesh_ && edge_of_.size() == 3 * mesh.triangles.size();
  }

  /// The vertices at which a half-edge begins and ends, also where its triangle takes no part.
  std::uint32_t from(HalfEdge h) const noexcept {
    assert(h / 3 < mesh_.triangles.size());
    return mesh_.triangles[h / 3][h % 3];
  }
  std::uint32_t to(HalfEdge h) const noexcept { return from(next_in_triangle(h)); }
  /// Whether it runs from the lower vertex to the higher: two uses of an edge for which this is the
  /// same belong to triangles that face opposite ways.
  bool forward(HalfEdge h) const noexcept { return from(h) < to(h); }

 private:
  std::vector<HalfEdge> by_lower_vertex() const;
  const TriangleMesh& mesh_;  ///< must stay and keep its triangles
  std::vector<HalfEdge> uses_;
  std::vector<std::uint32_t> first_use_;  ///< per edge into uses_, one more at the end
  std::vector<std::uint32_t> edge_of_;
};

/// Sets of numbers 0..n-1 that grow together. Every set is named by its smallest member, so that
/// names do not depend on the order in which sets were united.
///
/// Threads      one, for asking too: `find` shortens the paths it goes.
/// Cost         4 bytes a number; logarithmic a call on average over many.
/// Source       R. Tarjan, J. van Leeuwen, "Worst-case analysis of set union algorithms", 1984:
///              path halving. Ours differs: the smaller name wins, not the larger set.
class DisjointSets {
 public:
  /// Every number a set of its own.
  explicit DisjointSets(std::size_t count);
  /// The smallest member of the set of `i`, which must be below the count.
  std::uint32_t find(std::uint32_t i) noexcept;
  /// Makes one set of two; nothing where they are one already.
  void unite(std::uint32_t a, std::uint32_t b) noexcept;

 private:
  std::vector<std::uint32_t> parent_;
};

/// Parts of a mesh that hang together by edges.
struct MeshParts {
  /// Part of each triangle, numbered from 0 in the order of their first triangles; kNoPart for
  /// those that belong to none.
  std::vector<std::uint32_t> of_triangle;
  std::uint32_t count = 0;
};

/// Components over all edges; with `cut_at_nonmanifold`, edges of three or more triangles do not
/// join. Triangles that take no part in `edges` get kNoPart. Parts that meet in a vertex only are
/// two.
///
/// Shapes       edges: the table of that very mesh.
/// Cost         nearly linear in the triangles.
inline constexpr std::uint32_t kNoPart = 0xffffffff;
MeshParts mesh_parts(const TriangleMesh& mesh, const EdgeTable& edges, bool cut_at_nonmanifold);

/// Signed volume of each part about the centre of the mesh, summed in triangle order, in the cube
/// of the positions' unit: positive where a part faces outward, negative for a cavity. Of an open
/// part it means nothing.
std::vector<double> part_volumes(const TriangleMesh& mesh, const MeshParts& parts);

}  // namespace argil::mesh
