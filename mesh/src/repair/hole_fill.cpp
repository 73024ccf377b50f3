// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/hole_fill.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <tuple>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include "repair/cgal.h"

namespace argil::mesh {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;
using Vertex = SurfaceMesh::Vertex_index;
using Face = SurfaceMesh::Face_index;

// The search space that always has a solution grows with the cube of the rim's length.
constexpr std::size_t kLongestForCubic = 400;

Point to_point(const Vec3& p) { return {p.x, p.y, p.z}; }

/// Corners at a vertex, joined across edges of two triangles turned alike. Each set becomes a
/// vertex of its own, since CGAL's meshes know no vertex where two fans touch.
DisjointSets fans_of(const TriangleMesh& mesh, const EdgeTable& edges) {
  DisjointSets fans(3 * mesh.triangles.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::span<const HalfEdge> uses = edges.uses(e);
    if (uses.size() != 2 || edges.forward(uses[0]) == edges.forward(uses[1])) continue;
    fans.unite(uses[0], next_in_triangle(uses[1]));
    fans.unite(uses[1], next_in_triangle(uses[0]));
  }
  return fans;
}

}  // namespace

struct HoleFiller::State {
  SurfaceMesh surface;
  std::vector<Vertex> vertex_of_corner;
  std::vector<std::uint32_t> number_of_vertex;  ///< in the TriangleMesh; new ones at the end
};

HoleFiller::HoleFiller(const TriangleMesh& mesh, const EdgeTable& edges)
    : mesh_(mesh), edges_(edges), state_(std::make_unique<State>()) {
  assert(edges.is_of(mesh));
  DisjointSets fans = fans_of(mesh, edges);
  const auto corners = static_cast<HalfEdge>(3 * mesh.triangles.size());
  state_->vertex_of_corner.resize(corners);
  for (HalfEdge corner = 0; corner < corners; ++corner) {
    const HalfEdge first = fans.find(corner);  // the smallest, so it has its vertex already
    if (first == corner) {
      const std::uint32_t v = edges.from(corner);
      state_->vertex_of_corner[corner] = state_->surface.add_vertex(to_point(mesh.positions[v]));
      state_->number_of_vertex.push_back(v);
    } else {
      state_->vertex_of_corner[corner] = state_->vertex_of_corner[first];
    }
  }
  // A triangle CGAL refuses is missing there; rims that run along it are then filled flat.
  for (HalfEdge corner = 0; corner < corners; corner += 3) {
    state_->surface.add_face(state_->vertex_of_corner[corner], state_->vertex_of_corner[corner + 1],
                             state_->vertex_of_corner[corner + 2]);
  }
}

HoleFiller::~HoleFiller() = default;

HolePatch HoleFiller::fill_smoothly(const std::vector<HalfEdge>& rim) {
  assert(rim.size() >= 2);
  SurfaceMesh& surface = state_->surface;
  const auto along = surface.halfedge(state_->vertex_of_corner[rim[0]],
                                      state_->vertex_of_corner[next_in_triangle(rim[0])]);
  if (along == SurfaceMesh::null_halfedge()) return {};
  // The hole lies on the other side of the half-edge that belongs to a triangle.
  const auto border = surface.opposite(along);
  if (!surface.is_border(border)) return {};
  std::vector<Face> faces;
  std::vector<Vertex> added;
  const auto around = CGAL::halfedges_around_face(border, surface);
  // Longer where the rim touches itself: there CGAL's hole is not ours.
  if (std::distance(around.begin(), around.end()) != std::ssize(rim)) return {};
  fill_hole_fairly(surface, border, rim.size() > kLongestForCubic, faces, added);
  HolePatch patch;
  const auto base = static_cast<std::uint32_t>(mesh_.positions.size());
  // Vertices that refinement adds come after all others.
  state_->number_of_vertex.resize(surface.num_vertices());
  for (const Vertex v : added) {
    const Point& p = surface.point(v);
    state_->number_of_vertex[v] = base + static_cast<std::uint32_t>(patch.added.size());
    patch.added.push_back({p.x(), p.y(), p.z()});
    // Fairing solves a linear system, which a degenerate hole makes singular.
    if (!is_finite(patch.added.back())) return {};
  }
  for (const Face f : faces) {
    Triangle triangle{};
    std::size_t corner = 0;
    for (const Vertex v : CGAL::vertices_around_face(surface.halfedge(f), surface)) {
      triangle[corner++] = state_->number_of_vertex[v];
    }
    patch.triangles.push_back(triangle);
  }
  return patch;
}

/// Triangles on a closed polygon that visits each vertex once; none when there is no solution.
std::vector<Triangle> HoleFiller::fill_flat(const std::vector<std::uint32_t>& vertices) const {
  std::vector<Point> points;
  for (const std::uint32_t v : vertices) points.push_back(to_point(mesh_.positions[v]));
  using Indices = CGAL::Triple<int, int, int>;
  std::vector<Indices> found;
  pmp::triangulate_hole_polyline(
      points, std::back_inserter(found),
      CGAL::parameters::do_not_use_cubic_algorithm(points.size() > kLongestForCubic));
  std::vector<Triangle> triangles;
  const auto number = [&](int i) { return vertices[static_cast<std::size_t>(i)]; };
  for (const Indices& t : found) {
    triangles.push_back({number(t.first), number(t.second), number(t.third)});
  }
  return triangles;
}

/// Of a cut, or of a face that was left out: what was there is likely to have been flat.
bool HoleFiller::is_plane(const std::vector<HalfEdge>& rim) const {
  constexpr double kMostOff = 1e-4;  // of the box around the rim
  Box3 box;
  Vec3 twice_area;
  const Vec3 origin = mesh_.positions[edges_.from(rim[0])];
  for (const HalfEdge h : rim) {
    box.include(mesh_.positions[edges_.from(h)]);
    twice_area +=
        cross(mesh_.positions[edges_.from(h)] - origin, mesh_.positions[edges_.to(h)] - origin);
  }
  const Vec3 normal = normalized(twice_area);
  const double most = kMostOff * length(box.size());
  return std::all_of(rim.begin(), rim.end(), [&](HalfEdge h) {
    return std::abs(dot(mesh_.positions[edges_.from(h)] - origin, normal)) <= most;
  });
}

HolePatch HoleFiller::fill(const std::vector<HalfEdge>& rim, bool may_curve) {
  HolePatch patch;
  if (may_curve && !is_plane(rim)) patch = fill_smoothly(rim);
  if (!patch.triangles.empty()) return patch;
  std::vector<std::uint32_t> backwards;  // as the patch must run against its neighbours
  for (auto h = rim.rbegin(); h != rim.rend(); ++h) backwards.push_back(edges_.to(*h));
  return {{}, fill_flat(backwards), 1};
}

}  // namespace argil::mesh
