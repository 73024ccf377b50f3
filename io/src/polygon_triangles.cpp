// SPDX-License-Identifier: GPL-3.0-or-later
#include "polygon_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace argil::io {
namespace {

constexpr int kNotSeen = -1;

using PlaneKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CornerBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, PlaneKernel>;
/// How many edges lie between a face and the outside.
using DepthBase = CGAL::Triangulation_face_base_with_info_2<int, PlaneKernel>;
using PlaneFaceBase = CGAL::Constrained_triangulation_face_base_2<PlaneKernel, DepthBase>;
using PlaneStructure = CGAL::Triangulation_data_structure_2<CornerBase, PlaneFaceBase>;
using Crossing = CGAL::No_constraint_intersection_requiring_constructions_tag;
using PlaneTriangles =
    CGAL::Constrained_Delaunay_triangulation_2<PlaneKernel, PlaneStructure, Crossing>;
using CornerHandle = PlaneTriangles::Vertex_handle;
using FaceHandle = PlaneTriangles::Face_handle;
/// How often the polygon goes along an edge of the triangulation, by its corners.
using EdgeUses = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

/// Twice the area as a vector (Newell), from the first corner, which keeps digits of small polygons
/// far away.
Vec3 area_of_polygon(std::span<const Vec3> corners) {
  Vec3 sum;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    sum += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  }
  return sum;
}

/// The two axes that see the polygon counter-clockwise along its normal.
std::pair<std::size_t, std::size_t> axes_of(const Vec3& area) {
  std::size_t away = 0;
  for (std::size_t a = 1; a < 3; ++a) {
    if (std::abs(area[a]) > std::abs(area[away])) away = a;
  }
  const std::size_t first = (away + 1) % 3;
  const std::size_t second = (away + 2) % 3;
  return area[away] > 0.0 ? std::pair{first, second} : std::pair{second, first};
}

std::pair<std::uint32_t, std::uint32_t> edge_name(std::uint32_t a, std::uint32_t b) {
  return std::minmax(a, b);
}

/// Depths of all faces, from the outside inwards.
void count_depths(const PlaneTriangles& plane, const EdgeUses& uses) {
  std::vector<FaceHandle> next{plane.infinite_face()};
  next.front()->info() = 0;
  while (!next.empty()) {
    const FaceHandle face = next.back();
    next.pop_back();
    for (int side = 0; side < 3; ++side) {
      const FaceHandle other = face->neighbor(side);
      if (other->info() != kNotSeen) continue;
      int crossed = 0;
      if (face->is_constrained(side)) {
        const auto found = uses.find(edge_name(face->vertex(PlaneTriangles::ccw(side))->info(),
                                               face->vertex(PlaneTriangles::cw(side))->info()));
        // A corner that lies on another edge halves it: each half is gone along once.
        crossed = found != uses.end() ? found->second : 1;
      }
      other->info() = face->info() + crossed;
      next.push_back(other);
    }
  }
}

std::vector<Triangle> inside_of(const PlaneTriangles& plane) {
  std::vector<Triangle> triangles;
  for (const FaceHandle face : plane.finite_face_handles()) {
    if (face->info() % 2 == 0) continue;
    triangles.push_back(
        {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  return triangles;
}

}  // namespace

std::vector<Triangle> triangulated(std::span<const Vec3> corners) {
  const Vec3 area = area_of_polygon(corners);
  if (area == Vec3{}) return {};
  const auto [x, y] = axes_of(area);
  PlaneTriangles plane;
  std::vector<CornerHandle> handles;
  handles.reserve(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t before = plane.number_of_vertices();
    handles.push_back(plane.insert({corners[i][x], corners[i][y]},
                                   handles.empty() ? FaceHandle() : handles.back()->face()));
    if (plane.number_of_vertices() > before) handles.back()->info() = static_cast<std::uint32_t>(i);
  }
  EdgeUses uses;
  try {
    for (std::size_t i = 0; i < handles.size(); ++i) {
      const CornerHandle from = handles[i];
      const CornerHandle to = handles[(i + 1) % handles.size()];
      if (from == to) continue;
      if (++uses[edge_name(from->info(), to->info())] == 1) plane.insert_constraint(from, to);
    }
  } catch (const PlaneTriangles::Intersection_of_constraints_exception&) {
    return {};
  }
  if (plane.dimension() < 2) return {};
  for (const FaceHandle face : plane.all_face_handles()) face->info() = kNotSeen;
  count_depths(plane, uses);
  return inside_of(plane);
}

}  // namespace argil::io
