// SPDX-License-Identifier: GPL-3.0-or-later
// What CGAL's manual offers for broken meshes, in the order in which it does.
#include <array>
#include <cstddef>
#include <iostream>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Surface_mesh.h>

#include "argil/io/mesh_file.h"

#include "arena/contestants.h"
#include "repair/cgal.h"
#include "rivals/cgal_surface_mesh.h"

namespace argil::arena {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

void fill_holes(Surface& surface) {
  constexpr std::size_t kLongRim = 400;
  std::vector<Surface::Halfedge_index> rims;
  pmp::extract_boundary_cycles(surface, std::back_inserter(rims));
  for (const Surface::Halfedge_index rim : rims) {
    std::size_t edges = 0;
    Surface::Halfedge_index at = rim;
    do {
      ++edges;
      at = surface.next(at);
    } while (at != rim);
    std::vector<Surface::Face_index> faces;
    std::vector<Surface::Vertex_index> vertices;
    mesh::fill_hole_fairly(surface, rim, edges > kLongRim, faces, vertices);
  }
}

Surface repaired_by_cgal(const TriangleMesh& mesh) {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
  for (const Vec3& p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) polygons.push_back({a, b, c});
  pmp::repair_polygon_soup(points, polygons);
  pmp::orient_polygon_soup(points, polygons);
  Surface surface;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, surface);
  pmp::stitch_borders(surface);
  pmp::duplicate_non_manifold_vertices(surface);
  fill_holes(surface);
  pmp::remove_degenerate_faces(surface);
  pmp::experimental::remove_self_intersections(surface);
  if (!pmp::does_self_intersect(surface)) {
    if (CGAL::is_closed(surface)) pmp::orient_to_bound_a_volume(surface);
    return surface;
  }
  pmp::experimental::autorefine_and_remove_self_intersections(surface);
  fill_holes(surface);
  return surface;
}

}  // namespace

int run_cgal_repair(const std::filesystem::path& broken, const std::filesystem::path& repaired) {
  const auto mesh = io::read_mesh(broken);
  if (!mesh) return 3;
  Surface surface = repaired_by_cgal(mesh.value());
  const auto written = io::write_mesh(repaired, evaluation::triangle_mesh_of(surface));
  if (!written) std::cerr << written.error().message << '\n';
  return written ? 0 : 3;
}

}  // namespace argil::arena
