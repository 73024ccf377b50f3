// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's corefinement, as its manual sets it up.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include "rivals/cgal_solids.h"
#include "rivals/cgal_surface_mesh.h"

namespace argil::evaluation {

std::optional<TriangleMesh> cgal_united(const TriangleMesh& a, const TriangleMesh& b) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  auto first = surface_mesh_of<Point>(a);
  auto second = surface_mesh_of<Point>(b);
  if (!first || !second) return std::nullopt;
  CGAL::Surface_mesh<Point> both;
  if (!CGAL::Polygon_mesh_processing::corefine_and_compute_union(*first, *second, both)) {
    return std::nullopt;
  }
  return triangle_mesh_of(both);
}

}  // namespace argil::evaluation
