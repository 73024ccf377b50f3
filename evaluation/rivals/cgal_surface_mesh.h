// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's mesh of ours, and back. For the sources of one library that includes CGAL.
#pragma once

#include <cassert>
#include <cstddef>
#include <optional>

#include <CGAL/Surface_mesh.h>

#include "argil/core/triangle_mesh.h"

namespace argil::evaluation {

/// None when the mesh is not a two-manifold to CGAL.
template <class Point>
std::optional<CGAL::Surface_mesh<Point>> surface_mesh_of(const TriangleMesh& mesh) {
  using Mesh = CGAL::Surface_mesh<Point>;
  using Vertex = typename Mesh::Vertex_index;
  Mesh made;
  made.reserve(static_cast<typename Mesh::size_type>(mesh.positions.size()),
               static_cast<typename Mesh::size_type>(3 * mesh.triangles.size() / 2),
               static_cast<typename Mesh::size_type>(mesh.triangles.size()));
  for (const Vec3& p : mesh.positions) made.add_vertex(Point(p.x, p.y, p.z));
  for (const auto& [a, b, c] : mesh.triangles) {
    if (made.add_face(Vertex(a), Vertex(b), Vertex(c)) == Mesh::null_face()) return std::nullopt;
  }
  return made;
}

/// Leaves what CGAL has removed out of `from` as well.
template <class Point>
TriangleMesh triangle_mesh_of(CGAL::Surface_mesh<Point>& from) {
  from.collect_garbage();
  TriangleMesh mesh;
  for (const auto v : from.vertices()) {
    const Point& p = from.point(v);
    mesh.positions.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : from.faces()) {
    Triangle triangle{};
    std::size_t corner = 0;
    for (const auto v : from.vertices_around_face(from.halfedge(f))) {
      assert(corner < 3);
      triangle[corner++] = v.idx();
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace argil::evaluation
