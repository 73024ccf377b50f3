// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/mesh/edges.h"

namespace argil::mesh {

/// Triangles for one hole. Numbers below the mesh's vertex count are its vertices; those from there
/// on are `added`.
struct HolePatch {
  std::vector<Vec3> added;
  std::vector<Triangle> triangles;  ///< none: the hole could not be filled
  std::int64_t holes = 1;           ///< that they close
};

/// Fills holes of a mesh whose triangles are turned alike across every edge of two.
/// `mesh` and `edges` must stay as they are meanwhile.
class HoleFiller {
 public:
  HoleFiller(const TriangleMesh& mesh, const EdgeTable& edges);
  ~HoleFiller();
  HoleFiller(const HoleFiller&) = delete;
  HoleFiller& operator=(const HoleFiller&) = delete;

  /// The hole whose rim are the boundary half-edges `rim`, in order, each vertex once. Tried first,
  /// where it may curve and the rim does not lie in a plane: a patch as fine as its surroundings
  /// that continues the curvature of the rim; then triangles on the vertices of the rim alone.
  /// Source  P. Liepa, "Filling holes in meshes", 2003, as CGAL has it.
  HolePatch fill(const std::vector<HalfEdge>& rim, bool may_curve);

 private:
  bool is_plane(const std::vector<HalfEdge>& rim) const;
  HolePatch fill_smoothly(const std::vector<HalfEdge>& rim);
  std::vector<Triangle> fill_flat(const std::vector<std::uint32_t>& vertices) const;
  struct State;
  const TriangleMesh& mesh_;
  const EdgeTable& edges_;
  std::unique_ptr<State> state_;
};

}  // namespace argil::mesh
