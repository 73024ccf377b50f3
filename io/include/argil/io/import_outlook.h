// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/progress.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay_options.h"

namespace argil::io {

/// What a mesh will cost as clay, told from its triangles before anything is imported: how much
/// surface it has, and how much of that is too bent for coarse levels.
///
/// Units     lengths in units of the mesh; the cost depends only on how many voxels span it.
/// Accuracy  between 100 and 800 voxels along the longest side within a quarter of what import
///           makes of the shared models (ImportOutlook.*); beyond, and where parts overlap or walls
///           are thinner than two voxels, a guess.
/// Threads   any.
class ImportOutlook {
 public:
  struct Cost {
    double vertices = 0.0;  ///< of the clay's surface
    double bytes = 0.0;     ///< of its levels: what LevelStats::bytes will add up to
  };

  /// Of nothing.
  ImportOutlook() = default;
  /// Shapes  any triangles with finite positions.
  /// Errors  throws Interrupted (pace.h) where `progress` stops it, and std::bad_alloc.
  /// Cost    about 1 us a triangle, 0.3 s at least for large meshes, and linear in the length of
  ///         thin ones; 60 bytes of memory a triangle beside its cells.
  explicit ImportOutlook(const TriangleMesh& mesh, const Progress& progress = {});

  double area() const noexcept { return area_; }

  /// Of the mesh scaled to a longest side of `voxels` voxels, at least 1.
  Cost at(double voxels, double tolerance_voxels = ClayOptions{}.tolerance_voxels) const;

 private:
  /// Leaves of one size, the most bent first.
  struct Leaves {
    std::vector<double> bend;  ///< descending; in sides of the mesh
    std::vector<double> area;  ///< of all leaves up to this one, as a fraction of the whole
  };
  double bent_fraction(double cell, double bend) const;
  double upper_nodes(double voxel) const;

  double area_ = 0.0;
  double side_ = 0.0;  ///< the longest
  Vec3 low_;
  Vec3 high_;
  double cell_ = 0.0;           ///< the smallest, in sides of the mesh
  std::vector<Leaves> leaves_;  ///< of cells that double from one to the next
};

}  // namespace argil::io
