// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "argil/core/triangle_mesh.h"
#include "argil/engine/operation.h"

namespace argil::evaluation {

/// OpenVDB's own level sets of half width 3 and its tools for them, with their default settings:
/// one level of voxels in floats.
class OpenvdbLevels {
 public:
  /// meshToLevelSet.
  OpenvdbLevels(const TriangleMesh& mesh_mm, double voxel_mm);
  OpenvdbLevels(OpenvdbLevels&&) noexcept;
  OpenvdbLevels& operator=(OpenvdbLevels&&) noexcept;
  ~OpenvdbLevels();

  OpenvdbLevels copy() const;

  /// LevelSetFilter::offset; outward positive.
  void offset(double distance_mm);
  /// GridTransformer brings the placed copy to this lattice, csgUnion joins them.
  void unite_with_copy(const Placement& placement);
  /// levelSetRebuild, as resampleToMatch: meshes the surface and measures distances from it.
  void resample(double voxel_mm);
  /// A copy that is offset inward, and csgDifference.
  void hollow(double wall_mm);

  /// volumeToMesh without its adaptivity, quads as two triangles.
  TriangleMesh surface() const;

 private:
  struct Grid;
  explicit OpenvdbLevels(std::unique_ptr<Grid> grid);
  std::unique_ptr<Grid> grid_;
};

}  // namespace argil::evaluation
