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

#include "rivals/cgal_surface_mesh.h"
#include "rivals/decimators.h"

namespace argil::evaluation {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// CGAL 5 and 6 have this under different names.
struct StopBelowEdges {
  std::size_t edges;

  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile&, std::size_t, std::size_t now) const noexcept {
    return now < edges;
  }
};

}  // namespace

std::optional<TriangleMesh> cgal_decimated(const TriangleMesh& surface, std::int64_t triangles) {
  assert(triangles > 0);
  auto made = surface_mesh_of<Kernel::Point_3>(surface);
  if (!made) return std::nullopt;
  SurfaceMesh& mesh = *made;
  const sms::GarlandHeckbert_plane_policies<SurfaceMesh, Kernel> policies(mesh);
  // It stops below a count of edges, of which a closed mesh has three for two triangles.
  const StopBelowEdges stop{3 * static_cast<std::size_t>(triangles) / 2 + 1};
  sms::edge_collapse(mesh, stop,
                     CGAL::parameters::get_cost(policies.get_cost())
                         .get_placement(policies.get_placement())
                         // Without it triangles fold over.
                         .filter(sms::Bounded_normal_change_filter<>()));
  return triangle_mesh_of(mesh);
}

}  // namespace argil::evaluation
