// SPDX-License-Identifier: GPL-3.0-or-later
// Rounding to float may fold slivers over. The shortest edge of each triangle that crosses another,
// or has no area, is collapsed until none does.
#include "argil/mesh/collapse_folded.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "argil/mesh/intersections.h"

namespace argil::mesh {
namespace {

/// With doubles: OpenMesh's own points are floats, and would round what is checked.
struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
};
using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

/// Both triangles of each crossing pair, and those without area; ascending.
std::vector<std::uint32_t> folded_triangles(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> flat = degenerate_triangles(mesh);
  std::vector<std::uint32_t> folded = flat;
  for (const auto& [a, b] : self_intersections(mesh, flat)) {
    folded.push_back(a);
    folded.push_back(b);
  }
  std::sort(folded.begin(), folded.end());
  folded.erase(std::unique(folded.begin(), folded.end()), folded.end());
  return folded;
}

bool convert(const TriangleMesh& mesh, HalfedgeMesh& to) {
  to.reserve(mesh.positions.size(), 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  for (const Vec3& p : mesh.positions) to.add_vertex({p.x, p.y, p.z});
  using Vertex = HalfedgeMesh::VertexHandle;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto number = [](std::uint32_t v) { return Vertex(static_cast<int>(v)); };
    if (!to.add_face(number(a), number(b), number(c)).is_valid()) return false;
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

/// Shrinks the shortest edge of a face that can go. False when none can.
bool collapse_shortest(HalfedgeMesh& mesh, HalfedgeMesh::FaceHandle face, double longest_mm) {
  std::vector<std::pair<double, HalfedgeMesh::HalfedgeHandle>> edges;
  for (const auto h : mesh.fh_range(face)) edges.emplace_back(mesh.calc_edge_sqr_length(h), h);
  std::sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) {
    // Of edges equally long the one with the lower number: one result whatever the sort does
    // with ties.
    return a.first != b.first ? a.first < b.first : a.second.idx() < b.second.idx();
  });
  for (const auto& [length2, h] : edges) {
    if (length2 > longest_mm * longest_mm) break;
    if (!mesh.is_collapse_ok(h)) continue;
    mesh.collapse(h);
    return true;
  }
  return false;
}

}  // namespace

std::int64_t collapse_folded(TriangleMesh& mesh, double longest_mm) {
  const std::vector<std::uint32_t> folded = folded_triangles(mesh);
  HalfedgeMesh halfedges;
  if (folded.empty() || !convert(mesh, halfedges)) return 0;
  assert(folded.back() < halfedges.n_faces());
  std::int64_t collapsed = 0;
  for (const std::uint32_t t : folded) {
    const HalfedgeMesh::FaceHandle face(static_cast<int>(t));
    if (halfedges.status(face).deleted()) continue;
    collapsed += collapse_shortest(halfedges, face, longest_mm) ? 1 : 0;
  }
  if (collapsed > 0) mesh = convert_back(halfedges);
  return collapsed;
}

MeshVerdict check_and_collapse_folded(TriangleMesh& mesh, double longest_mm, const Pace& pace) {
  // A collapse may fold its neighbours.
  constexpr int kMostRounds = 4;
  MeshVerdict verdict;
  for (int round = 0; round < kMostRounds; ++round) {
    verdict = judge_mesh(mesh, {}, 0, wall_thickness, pace);
    const bool is_surface =
        verdict.closed && verdict.manifold && verdict.misoriented_edges + verdict.duplicate == 0;
    if (verdict.printable || !is_surface || collapse_folded(mesh, longest_mm) == 0) break;
  }
  return verdict;
}

}  // namespace argil::mesh
