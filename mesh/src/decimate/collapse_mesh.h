// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/mesh/edges.h"

namespace argil::mesh {

/// A closed two-manifold of triangles whose edges can be shrunk to a point, as flat arrays of half
/// edges: 3 t + k runs from corner k of triangle t to the next one, and stays there until its
/// triangle goes. What is left is closed and two-manifold after every step.
class CollapseMesh {
 public:
  static constexpr std::uint32_t kGone = 0xffffffff;

  /// Nothing when `mesh` is not closed, two-manifold and turned one way.
  static std::optional<CollapseMesh> build(const TriangleMesh& mesh);

  std::size_t half_edges() const noexcept { return from_.size(); }
  std::size_t triangles() const noexcept { return triangles_; }
  std::size_t vertices() const noexcept { return positions_.size(); }  ///< those gone included

  bool is_gone(HalfEdge h) const noexcept { return from_[h] == kGone; }
  HalfEdge twin(HalfEdge h) const noexcept { return twin_[h]; }
  std::uint32_t from(HalfEdge h) const noexcept { return from_[h]; }
  std::uint32_t to(HalfEdge h) const noexcept { return from_[next_in_triangle(h)]; }
  const Vec3& position(std::uint32_t v) const noexcept { return positions_[v]; }
  HalfEdge any_from(std::uint32_t v) const noexcept { return out_[v]; }

  /// The next half-edge from the same vertex, turning one way round it.
  HalfEdge next_around(HalfEdge h) const noexcept {
    assert(!is_gone(h));
    return twin_[next_in_triangle(next_in_triangle(h))];
  }

  /// Whether the surface stays two-manifold when `h` shrinks: the two ends have two neighbours in
  /// common, neither of which is left with two triangles.
  bool can_collapse(HalfEdge h) noexcept;

  /// Shrinks `h`, which must be allowed: its two triangles and the vertex it runs to go, the one
  /// it comes from moves to `position`.
  void collapse(HalfEdge h, const Vec3& position) noexcept;

  /// What is left, in the old order; `kept` becomes the old number of each vertex.
  TriangleMesh mesh(std::vector<std::uint32_t>& kept) const;

 private:
  void glue(HalfEdge a, HalfEdge b) noexcept;
  std::size_t degree(std::uint32_t v) const noexcept;
  bool is_one_fan_each() const;

  std::vector<Vec3> positions_;
  std::vector<std::uint32_t> from_;
  std::vector<HalfEdge> twin_;
  std::vector<HalfEdge> out_;
  std::vector<std::uint32_t> mark_;  ///< the call of can_collapse that last met a vertex
  std::uint32_t call_ = 0;
  std::size_t triangles_ = 0;
};

}  // namespace argil::mesh
