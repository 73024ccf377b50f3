// SPDX-License-Identifier: GPL-3.0-or-later
#include "nearest_point.h"

#include <algorithm>
#include <cmath>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <tbb/parallel_for.h>

namespace argil::io {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point_of(const Vec3& p) { return {p.x, p.y, p.z}; }

}  // namespace

double farthest_from(const TriangleMesh& mesh, const std::vector<Vec3>& points) {
  Triangles triangles;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Kernel::Triangle_3 triangle(point_of(mesh.positions[a]), point_of(mesh.positions[b]),
                                      point_of(mesh.positions[c]));
    if (!triangle.is_degenerate()) triangles.push_back(triangle);
  }
  if (triangles.empty() || points.empty()) return 0.0;
  Tree tree(triangles.cbegin(), triangles.cend());
  tree.build();
  tree.accelerate_distance_queries();
  std::vector<double> squares(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) {
    squares[n] = tree.squared_distance(point_of(points[n]));
  });
  return std::sqrt(*std::max_element(squares.begin(), squares.end()));
}

}  // namespace argil::io
