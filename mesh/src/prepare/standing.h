// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/print_orientation.h"

namespace argil::mesh {

/// What does not depend on how a piece stands: to measure many orientations of one mesh by.
class StandingPiece {
 public:
  /// Looks at the mesh from all around (exposure). Refers to it.
  StandingPiece(const TriangleMesh& mesh, const Pace& pace);

  const TriangleMesh& mesh() const noexcept { return mesh_; }
  const Vec3& centre_of_mass() const noexcept { return centre_; }
  PrintOrientation measure(const Vec3& up, const OrientationOptions& options) const;

 private:
  const TriangleMesh& mesh_;
  Vec3 centre_;
  double area_ = 0.0;
  double volume_ = 0.0;
  double diagonal_ = 0.0;
  std::vector<double> exposure_;  ///< of each triangle, 0 hidden to 1 seen from everywhere
};

/// The middle of a closed mesh's volume; of one without volume, of its box.
Vec3 centre_of_mass(const TriangleMesh& mesh);

/// The mesh turned so that `up` is z.
TriangleMesh turned_up(const TriangleMesh& mesh, const Vec3& up);

/// Of each triangle the share of 48 directions, of the half space it faces, from which nothing of
/// the mesh hides it.
std::vector<double> exposure(const TriangleMesh& mesh, const Pace& pace);

}  // namespace argil::mesh
