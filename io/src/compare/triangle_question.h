// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "argil/core/vec3.h"
#include "argil/engine/field_sampler.h"
#include "argil/mesh/triangle_geometry.h"

#include "compare/triangle_cells.h"

namespace argil::io {

/// Proves of one triangle after another that |phi| is within a bound all over it, cell by cell of
/// level 0.
///
/// On the triangle phi is what phi - s L is, where L is the signed distance from its plane and s
/// any number: the slope of phi along the normal takes nearly all that varies. In a box, where phi
/// is trilinear, phi - s L is so as well, and greatest and least at corners. A box that this does
/// not settle is cut in eight, of which those count that the triangle may pass through.
///
/// Accuracy     on the safe side but for the rounding of doubles; exact to a fiftieth of the bound.
/// Threads      one each.
/// Cost         some 50 ns for each cell of level 0 that the triangle passes through.
class TriangleQuestion {
 public:
  /// `field` must outlive this.
  TriangleQuestion(double bound_mm, double voxel_mm, FieldSampler& field);

  bool is_near(const mesh::Corners& corners);

 private:
  /// phi around the middle of a cell.
  struct Around {
    Vec3 middle_mm;
    Vec3 fraction;  ///< of the middle, in the cell that phi is interpolated in
    double per_mm = 0.0;
    Trilinear phi{{}};
    double slope = 0.0;  ///< along the normal

    double phi_at(const Vec3& point_mm) const noexcept {
      return phi.value(fraction + per_mm * (point_mm - middle_mm));
    }
  };

  void take(const mesh::Corners& corners);
  bool is_cell_near(const CellIndex& index);
  bool is_box_near(const Around& at, const Vec3& middle_mm, const Vec3& half_mm) const;
  bool may_pass(const Vec3& middle_mm, const Vec3& half_mm) const;
  bool may_pass_sliver(const Vec3& middle_mm, const Vec3& half_mm) const;

  double bound_mm_;
  double voxel_mm_;
  FieldSampler& field_;
  // Of the triangle that is asked for.
  Box3 box_;
  std::array<Vec3, 3> corners_;
  bool is_sliver_ = false;      ///< its area tells no normal
  Vec3 normal_;                 ///< of unit length, or 0
  double off_mm_ = 0.0;         ///< how far rounding takes the corners from the plane
  std::array<Vec3, 3> inward_;  ///< along the plane and normal to the side from each corner
};

}  // namespace argil::io
