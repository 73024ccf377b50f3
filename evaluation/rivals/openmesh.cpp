// SPDX-License-Identifier: GPL-3.0-or-later
// OpenMesh's decimater with its quadric module.
#include <cassert>
#include <cstddef>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "rivals/decimators.h"

namespace argil::evaluation {
namespace {

/// In doubles, as ours and CGAL's: floats would be a handicap of the type, not of the method.
struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
};
using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

bool convert(const TriangleMesh& mesh, HalfedgeMesh& to) {
  to.reserve(mesh.positions.size(), 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  for (const Vec3& p : mesh.positions) to.add_vertex({p.x, p.y, p.z});
  const auto handle = [](std::uint32_t v) { return OpenMesh::VertexHandle(static_cast<int>(v)); };
  for (const auto& [a, b, c] : mesh.triangles) {
    if (!to.add_face(handle(a), handle(b), handle(c)).is_valid()) return false;
  }
  return true;
}

TriangleMesh convert_back(HalfedgeMesh& from) {
  from.garbage_collection();
  TriangleMesh mesh;
  for (const auto v : from.vertices()) {
    const OpenMesh::Vec3d p = from.point(v);
    mesh.positions.push_back({p[0], p[1], p[2]});
  }
  for (const auto f : from.faces()) {
    Triangle triangle{};
    std::size_t corner = 0;
    for (const auto v : from.fv_range(f)) triangle[corner++] = static_cast<std::uint32_t>(v.idx());
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace

std::optional<TriangleMesh> openmesh_decimated(const TriangleMesh& surface,
                                               std::int64_t triangles) {
  assert(triangles > 0);
  HalfedgeMesh mesh;
  if (!convert(surface, mesh)) return std::nullopt;
  OpenMesh::Decimater::DecimaterT<HalfedgeMesh> decimater(mesh);
  OpenMesh::Decimater::ModQuadricT<HalfedgeMesh>::Handle quadric;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();  // a cost, not a bound
  if (!decimater.initialize()) return std::nullopt;
  decimater.decimate_to_faces(0, static_cast<std::size_t>(triangles));
  return convert_back(mesh);
}

}  // namespace argil::evaluation
