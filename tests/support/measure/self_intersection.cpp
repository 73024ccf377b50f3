// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/measure/self_intersection.h"

#include <iterator>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

namespace argil::test {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Face = CGAL::Surface_mesh<Point>::Face_index;

double rounded(double v) { return static_cast<double>(static_cast<float>(v)); }

}  // namespace

SoupFaults find_soup_faults(const TriangleMesh& mesh) {
  CGAL::Surface_mesh<Point> copy;
  for (const Vec3& p : mesh.positions) copy.add_vertex(Point(p.x, p.y, p.z));
  using Vertex = CGAL::Surface_mesh<Point>::Vertex_index;
  SoupFaults faults;
  for (const Triangle& t : mesh.triangles) {
    const Vertex a(t[0]);
    const Vertex b(t[1]);
    const Vertex c(t[2]);
    if (CGAL::collinear(copy.point(a), copy.point(b), copy.point(c))) ++faults.degenerate;
    if (!copy.add_face(a, b, c).is_valid()) ++faults.refused;
  }
  std::vector<std::pair<Face, Face>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(copy, std::back_inserter(pairs));
  faults.crossing_pairs = pairs.size();
  return faults;
}

TriangleMesh rounded_to_float(const TriangleMesh& mesh, const Vec3& offset_mm) {
  TriangleMesh made = mesh;
  for (Vec3& p : made.positions) {
    p += offset_mm;
    p = {rounded(p.x), rounded(p.y), rounded(p.z)};
  }
  return made;
}

}  // namespace argil::test
