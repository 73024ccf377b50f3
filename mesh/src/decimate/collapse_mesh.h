// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/edges.h"

namespace argil::mesh {

/// A closed two-manifold of triangles whose edges can be shrunk to a point, as flat arrays of half
/// edges: 3 t + k runs from corner k of triangle t to the next one, and stays there until its
/// triangle goes. What is left is closed and two-manifold after every step.
///
/// Threads      a step reads and writes only at the two ends of its edge and their neighbours:
/// steps
///              may run at the same time where no vertex is such a one of two.
class CollapseMesh {
 public:
  static constexpr std::uint32_t kGone = 0xffffffff;

  /// Nothing when `mesh` is not closed, two-manifold and turned one way.
  static std::optional<CollapseMesh> build(const TriangleMesh& mesh);

  std::size_t half_edges() const noexcept { return from_.size(); }
  std::size_t vertices() const noexcept { return positions_.size(); }  ///< those gone included

  bool is_gone(HalfEdge h) const noexcept { return from_[h] == kGone; }
  HalfEdge twin(HalfEdge h) const noexcept { return twin_[h]; }
  std::uint32_t from(HalfEdge h) const noexcept { return from_[h]; }
  std::uint32_t to(HalfEdge h) const noexcept { return from_[next_in_triangle(h)]; }
  const Vec3& position(std::uint32_t v) const noexcept { return positions_[v]; }
  const std::vector<Vec3>& positions() const noexcept { return positions_; }
  HalfEdge any_from(std::uint32_t v) const noexcept { return out_[v]; }  ///< kGone where v is

  /// The next half-edge from the same vertex, turning one way round it.
  HalfEdge next_around(HalfEdge h) const noexcept {
    assert(!is_gone(h));
    return twin_[next_in_triangle(next_in_triangle(h))];
  }

  /// Whether the surface stays two-manifold when `h` shrinks: the two ends have two neighbours in
  /// common, neither of which is left with two triangles. `ring` is memory to work in.
  bool can_collapse(HalfEdge h, std::vector<std::uint32_t>& ring) const;

  /// Shrinks `h`, which must be allowed: its two triangles and the vertex it runs to go, the one
  /// it comes from moves to `position`.
  void collapse(HalfEdge h, const Vec3& position) noexcept;

  void move(std::uint32_t v, const Vec3& position) noexcept { positions_[v] = position; }
  void round_to_float();  ///< all positions, as a file will have them

  /// The vertex that `v` became by steps, itself where it is still there.
  std::uint32_t became(std::uint32_t v) const noexcept {
    while (into_[v] != v) v = into_[v];
    return v;
  }
  /// Makes became() a short way for all.
  void shorten_ways() noexcept;

  /// Takes back the steps since `before` by which the vertices marked in `goes_back` came to be:
  /// all that became one of them is a vertex again, where it was, with the triangles around it. The
  /// rest stays as it is. Where that would not be two-manifold neighbours are marked and go back as
  /// well. Returns the vertices that went back, ascending. Throws Interrupted; what is left then is
  /// of no use.
  ///
  /// Cost  1 ns for each vertex of all, 1 us for each that goes back.
  std::vector<std::uint32_t> restore(const CollapseMesh& before,
                                     std::vector<std::uint8_t>& goes_back, const Pace& pace);

  /// The same without what is gone, in the old order. `number` becomes the new number of what each
  /// vertex has become.
  CollapseMesh compacted(std::vector<std::uint32_t>& number) const;

  /// What is left, in the old order; `kept` becomes the old number of each vertex.
  TriangleMesh mesh(std::vector<std::uint32_t>& kept) const;

 private:
  class Restoring;
  void glue(HalfEdge a, HalfEdge b) noexcept;
  bool has_three_triangles(std::uint32_t v) const noexcept;

  std::vector<Vec3> positions_;
  std::vector<std::uint32_t> from_;
  std::vector<HalfEdge> twin_;
  std::vector<HalfEdge> out_;
  std::vector<std::uint32_t> into_;  ///< of each vertex: what it was shrunk into, or itself
};

}  // namespace argil::mesh
