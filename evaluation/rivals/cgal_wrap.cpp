// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's alpha wrapping, as its manual sets it up.
#include <cassert>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include "rivals/cgal_solids.h"
#include "rivals/cgal_surface_mesh.h"

namespace argil::evaluation {

TriangleMesh cgal_wrapped(const TriangleMesh& mesh_mm, double alpha_mm, double offset_mm) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  assert(alpha_mm > 0.0 && offset_mm > 0.0);
  std::vector<Point> points;
  points.reserve(mesh_mm.positions.size());
  for (const Vec3& p : mesh_mm.positions) points.emplace_back(p.x, p.y, p.z);
  CGAL::Surface_mesh<Point> wrap;
  CGAL::alpha_wrap_3(points, mesh_mm.triangles, alpha_mm, offset_mm, wrap);
  return triangle_mesh_of(wrap);
}

}  // namespace argil::evaluation
