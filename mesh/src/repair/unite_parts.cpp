// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/unite_parts.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>
#include <CGAL/Surface_mesh.h>

#include "argil/mesh/edges.h"
#include "argil/mesh/rounding.h"

namespace argil::mesh {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

struct SurfacePart {
  Surface surface;
  Box3 box;
  double volume = 0.0;
  bool is_sound = true;  ///< CGAL takes it: closed and two-manifold
};

std::vector<SurfacePart> parts_of(const TriangleMesh& mesh) {
  const EdgeTable edges(mesh);
  const MeshParts numbers = mesh_parts(mesh, edges, false);
  const std::vector<double> volumes = part_volumes(mesh, numbers);
  std::vector<SurfacePart> parts(numbers.count);
  std::vector<Surface::Vertex_index> vertex(mesh.positions.size(), Surface::null_vertex());
  std::vector<std::uint32_t> owner(mesh.positions.size(), kNoPart);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t number = numbers.of_triangle[t];
    if (number == kNoPart) continue;
    SurfacePart& part = parts[number];
    part.volume = volumes[number];
    std::array<Surface::Vertex_index, 3> corners;
    bool is_own = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[t][k];
      const Vec3& p = mesh.positions[v];
      if (owner[v] == kNoPart) {
        owner[v] = number;
        vertex[v] = part.surface.add_vertex(Point(p.x, p.y, p.z));
        part.box.include(p);
      }
      is_own = is_own && owner[v] == number;
      corners[k] = vertex[v];
    }
    // Parts that touch in a vertex are not two-manifold together, and its number in the one means
    // another vertex in the other, or none.
    if (!is_own) {
      part.is_sound = false;
      continue;
    }
    const auto face = part.surface.add_face(corners[0], corners[1], corners[2]);
    if (face == Surface::null_face()) part.is_sound = false;
  }
  for (SurfacePart& part : parts) part.is_sound = part.is_sound && CGAL::is_closed(part.surface);
  return parts;
}

void append(const Surface& from, TriangleMesh& to) {
  std::vector<std::uint32_t> number(from.number_of_vertices() + from.number_of_removed_vertices());
  for (const auto v : from.vertices()) {
    const Point& p = from.point(v);
    number[v] = static_cast<std::uint32_t>(to.positions.size());
    to.positions.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : from.faces()) {
    Triangle t{};
    std::size_t k = 0;
    for (const auto v : from.vertices_around_face(from.halfedge(f))) t[k++] = number[v];
    to.triangles.push_back(t);
  }
}

/// Takes `from` into `to`. False where both stay apart.
bool unite(SurfacePart& to, SurfacePart& from, bool takes_nested) {
  assert(to.is_sound && from.is_sound);
  if (!to.box.meets(from.box)) return false;
  // Where there are cavities, a part inside another may lie in its cavity: then only parts that
  // cross are united.
  if (!takes_nested && !PMP::do_intersect(to.surface, from.surface)) return false;
  Surface united;
  if (!PMP::corefine_and_compute_union(to.surface, from.surface, united)) return false;
  // Parts that lie apart are their own union.
  const auto faces = to.surface.number_of_faces() + from.surface.number_of_faces();
  if (united.number_of_faces() == faces && !PMP::do_intersect(to.surface, from.surface)) {
    return false;
  }
  to.surface = std::move(united);
  to.box.include(from.box.min);
  to.box.include(from.box.max);
  return true;
}

}  // namespace

std::int64_t unite_parts(TriangleMesh& mesh) {
  std::vector<SurfacePart> parts = parts_of(mesh);
  const auto is_usable = [](const SurfacePart& p) { return p.is_sound && p.volume != 0.0; };
  if (!std::all_of(parts.begin(), parts.end(), is_usable)) return 0;
  const bool takes_nested =
      std::all_of(parts.begin(), parts.end(), [](const SurfacePart& p) { return p.volume > 0.0; });
  std::stable_sort(parts.begin(), parts.end(),
                   [](const SurfacePart& a, const SurfacePart& b) { return a.volume > b.volume; });
  std::int64_t united = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = i + 1; j < parts.size();) {
      if (parts[j].volume <= 0.0 || !unite(parts[i], parts[j], takes_nested)) {
        ++j;
        continue;
      }
      ++united;
      parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
      j = i + 1;  // what did not meet it before may meet it now
    }
  }
  if (united == 0) return 0;
  TriangleMesh whole;
  for (const SurfacePart& part : parts) append(part.surface, whole);
  mesh = rounded_to_float(std::move(whole));
  return united;
}

}  // namespace argil::mesh
