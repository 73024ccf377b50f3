// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's edge collapse with plane quadrics (M. Garland, P. Heckbert, 1997), as its manual sets
// it up.
#include <cassert>
#include <cstddef>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "rivals/decimators.h"

namespace argil::evaluation {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = SurfaceMesh::Vertex_index;

/// CGAL 5 and 6 have this under different names.
struct StopBelowEdges {
  std::size_t edges;

  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile&, std::size_t, std::size_t now) const noexcept {
    return now < edges;
  }
};

bool convert(const TriangleMesh& mesh, SurfaceMesh& to) {
  to.reserve(static_cast<SurfaceMesh::size_type>(mesh.positions.size()),
             static_cast<SurfaceMesh::size_type>(3 * mesh.triangles.size() / 2),
             static_cast<SurfaceMesh::size_type>(mesh.triangles.size()));
  for (const Vec3& p : mesh.positions) to.add_vertex(Kernel::Point_3(p.x, p.y, p.z));
  for (const auto& [a, b, c] : mesh.triangles) {
    if (to.add_face(Vertex(a), Vertex(b), Vertex(c)) == SurfaceMesh::null_face()) return false;
  }
  return true;
}

TriangleMesh convert_back(SurfaceMesh& from) {
  from.collect_garbage();
  TriangleMesh mesh;
  for (const Vertex v : from.vertices()) {
    const Kernel::Point_3& p = from.point(v);
    mesh.positions.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : from.faces()) {
    Triangle triangle{};
    std::size_t corner = 0;
    for (const Vertex v : from.vertices_around_face(from.halfedge(f))) {
      assert(corner < 3);
      triangle[corner++] = v.idx();
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace

std::optional<TriangleMesh> cgal_decimated(const TriangleMesh& surface, std::int64_t triangles) {
  assert(triangles > 0);
  SurfaceMesh mesh;
  if (!convert(surface, mesh)) return std::nullopt;
  const sms::GarlandHeckbert_plane_policies<SurfaceMesh, Kernel> policies(mesh);
  // It stops below a count of edges, of which a closed mesh has three for two triangles.
  const StopBelowEdges stop{3 * static_cast<std::size_t>(triangles) / 2 + 1};
  sms::edge_collapse(mesh, stop,
                     CGAL::parameters::get_cost(policies.get_cost())
                         .get_placement(policies.get_placement())
                         // Without it triangles fold over.
                         .filter(sms::Bounded_normal_change_filter<>()));
  return convert_back(mesh);
}

}  // namespace argil::evaluation
