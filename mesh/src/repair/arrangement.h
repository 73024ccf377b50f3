// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/intersections.h"

namespace argil::mesh {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint = Exact::Point_3;

inline ExactPoint exact_point_of(const Vec3& p) { return {p.x, p.y, p.z}; }

/// Of the exact number: CGAL's own to_double is content with 1e-5 where it knows no better yet.
inline double nearest_double(const Exact::FT& number) { return CGAL::to_double(number.exact()); }
inline Vec3 nearest_doubles(const ExactPoint& p) {
  return {nearest_double(p.x()), nearest_double(p.y()), nearest_double(p.z())};
}

/// A piece of the surface that nothing crosses any more.
struct ArrangedFace {
  Triangle corners;
  /// By how much more often it is inside behind the face than in front of it; > 0.
  std::int32_t jump;
};

/// The triangles of a mesh cut along all lines in which they meet, exactly: two faces of it have a
/// vertex, an edge or nothing in common. Where several triangles lie on one another there is one
/// face, or none where as many of them face one way as the other.
///
/// Determinism  same faces every time.
/// Threads      one: CGAL's lazy numbers are not shared. Throws Interrupted where `pace` asks.
/// Cost         50 us a pair.
/// Source       Q. Zhou, E. Grinspun, D. Zorin, A. Jacobson, "Mesh Arrangements for Solid
///              Geometry", 2016.
class Arrangement {
 public:
  /// Of a mesh that names each place once and has no degenerate triangles, with its
  /// `self_intersections` and the pairs of triangles on the same vertices.
  Arrangement(const TriangleMesh& mesh, const std::vector<TrianglePair>& pairs, const Pace& pace);

  /// First the triangles that nothing touches, in their order.
  const std::vector<ArrangedFace>& faces() const noexcept { return faces_; }
  /// The vertices of the mesh first, under their own numbers.
  std::size_t points() const noexcept { return mesh_.positions.size() + added_.size(); }
  ExactPoint point(std::uint32_t number) const;
  Vec3 rounded_point(std::uint32_t number) const;

 private:
  struct Lines;
  struct Plane;
  std::uint32_t number_of(const ExactPoint& p);
  void meet(const TrianglePair& pair, Lines& lines);
  void cut(const Plane& plane, const Lines& lines);

  const TriangleMesh& mesh_;
  std::vector<ArrangedFace> faces_;
  std::vector<ExactPoint> added_;
  std::map<ExactPoint, std::uint32_t> numbers_;  ///< of what is in triangles that meet others
};

}  // namespace argil::mesh
