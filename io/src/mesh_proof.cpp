// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_proof.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

namespace argil::io {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Corners = std::array<std::uint32_t, 3>;
using IndexPair = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Point> points_of(const TriangleMesh& mesh) {
  std::vector<Point> points;
  points.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
  return points;
}

/// The pairwise test, by index: what two triangles share is not an intersection.
class PairTest {
 public:
  PairTest(const TriangleMesh& mesh, const std::vector<Point>& points)
      : mesh_(mesh), points_(points) {}

  bool operator()(std::uint32_t a, std::uint32_t b) const {
    const Corners& p = mesh_.triangles[a];
    const Corners& q = mesh_.triangles[b];
    std::array<std::size_t, 3> shared_p{};
    std::array<std::size_t, 3> shared_q{};
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto found = std::find(q.begin(), q.end(), p[i]);
      if (found == q.end()) continue;
      shared_p[shared] = i;
      shared_q[shared++] = static_cast<std::size_t>(found - q.begin());
    }
    if (shared == 0) return CGAL::do_intersect(triangle(p), triangle(q));
    if (shared == 1) return meet_beyond_vertex(p, shared_p[0], q, shared_q[0]);
    if (shared == 2)
      return folded_over_edge(p, 3 - shared_p[0] - shared_p[1], q, 3 - shared_q[0] - shared_q[1]);
    return false;
  }

 private:
  const Point& at(const Corners& c, std::size_t i) const { return points_[c[i % 3]]; }
  Kernel::Triangle_3 triangle(const Corners& c) const { return {at(c, 0), at(c, 1), at(c, 2)}; }

  /// One shared vertex: does the side opposite to it in one triangle touch the other?
  bool meet_beyond_vertex(const Corners& p, std::size_t i, const Corners& q, std::size_t j) const {
    const Kernel::Segment_3 opposite_p(at(p, i + 1), at(p, i + 2));
    const Kernel::Segment_3 opposite_q(at(q, j + 1), at(q, j + 2));
    return CGAL::do_intersect(triangle(p), opposite_q) ||
           CGAL::do_intersect(triangle(q), opposite_p);
  }

  /// A shared edge: both lie in one plane and on the same side of it? `i` and `j` are the corners
  /// that are not shared.
  bool folded_over_edge(const Corners& p, std::size_t i, const Corners& q, std::size_t j) const {
    const Point& a = at(p, i + 1);
    const Point& b = at(p, i + 2);
    return CGAL::coplanar(a, b, at(p, i), at(q, j)) &&
           CGAL::coplanar_orientation(a, b, at(p, i), at(q, j)) == CGAL::POSITIVE;
  }

  const TriangleMesh& mesh_;
  const std::vector<Point>& points_;
};

using Box =
    CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t,
                                              CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

std::vector<Box> boxes_of(const TriangleMesh& mesh, const std::vector<Point>& points,
                          const std::vector<std::uint32_t>& left_out) {
  std::vector<Box> boxes;
  boxes.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (std::binary_search(left_out.begin(), left_out.end(), t)) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    boxes.emplace_back(points[a].bbox() + points[b].bbox() + points[c].bbox(), t);
  }
  return boxes;
}

}  // namespace

std::vector<std::uint32_t> degenerate_triangles(const TriangleMesh& mesh) {
  const std::vector<Point> points = points_of(mesh);
  std::vector<std::uint32_t> degenerate;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (CGAL::collinear(points[a], points[b], points[c])) degenerate.push_back(t);
  }
  return degenerate;
}

std::vector<IndexPair> self_intersections(const TriangleMesh& mesh,
                                          const std::vector<std::uint32_t>& left_out) {
  const std::vector<Point> points = points_of(mesh);
  std::vector<Box> boxes = boxes_of(mesh, points, left_out);
  std::vector<Box*> pointers;
  pointers.reserve(boxes.size());
  for (Box& box : boxes) pointers.push_back(&box);
  std::vector<IndexPair> pairs;
  const PairTest meets(mesh, points);
  constexpr std::ptrdiff_t kCutoff =
      2000;  // below this many boxes scanning beats splitting further
  CGAL::box_self_intersection_d(
      pointers.begin(), pointers.end(),
      [&](const Box* a, const Box* b) {
        const std::uint32_t low = std::min(a->info(), b->info());
        const std::uint32_t high = std::max(a->info(), b->info());
        if (meets(low, high)) pairs.emplace_back(low, high);
      },
      kCutoff);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

bool bounds_a_volume(const TriangleMesh& mesh) {
  CGAL::Surface_mesh<Point> surface;
  surface.reserve(static_cast<unsigned>(mesh.positions.size()),
                  static_cast<unsigned>(3 * mesh.triangles.size() / 2),
                  static_cast<unsigned>(mesh.triangles.size()));
  using Vertex = CGAL::Surface_mesh<Point>::Vertex_index;
  for (const Point& p : points_of(mesh)) surface.add_vertex(p);
  for (const auto& [a, b, c] : mesh.triangles) {
    if (surface.add_face(Vertex(a), Vertex(b), Vertex(c)) == surface.null_face()) return false;
  }
  return CGAL::Polygon_mesh_processing::does_bound_a_volume(surface);
}

}  // namespace argil::io
