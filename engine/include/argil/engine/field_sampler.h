// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>

#include "argil/core/distance_probe.h"
#include "argil/core/vec3.h"
#include "argil/engine/clay.h"

namespace argil {

/// The cell between whose corners phi is interpolated at a point: of the finest level that stores a
/// leaf there.
struct FieldCell {
  /// phi in mm; corner 4 i + 2 j + k is i, j, k nodes above the low one.
  std::array<float, 8> corners{};
  /// Of the point within the cell: 0 to 1 from the low corner.
  Vec3 fraction;
  /// Cells in a mm; 0 where no level has a leaf: phi is one value there.
  double per_mm = 0.0;
  int level = 0;
};

/// phi between the eight corners of a cell, as differences along the axes:
/// c0 + x cx + y cy + z cz + xy cxy + ...; points are fractions of the cell, 0 to 1. Beyond the
/// cell the polynomial goes on, which the field does not.
///
/// Units        phi in mm; `slope` in mm a cell: FieldCell::per_mm times it is the gradient.
/// Threads      any; all noexcept, none allocates.
struct Trilinear {
  double c0, cx, cy, cz, cxy, cxz, cyz, cxyz;

  /// Corners as FieldCell has them.
  explicit Trilinear(const std::array<float, 8>& corners) noexcept {
    const auto at = [&](std::size_t i) { return static_cast<double>(corners[i]); };
    c0 = at(0);
    cx = at(4) - c0;
    cy = at(2) - c0;
    cz = at(1) - c0;
    cxy = at(6) - at(4) - cy;
    cxz = at(5) - at(4) - cz;
    cyz = at(3) - at(2) - cz;
    cxyz = at(7) - at(6) - (at(5) - at(4)) - cyz;
  }
  /// phi at a point of the cell. At a corner it is the corner's value but for rounding.
  double value(const Vec3& s) const noexcept {
    return c0 + s.z * cz + s.y * (cy + s.z * cyz) +
           s.x * (cx + s.z * cxz + s.y * (cxy + s.z * cxyz));
  }
  /// How far rounding may take a value: what is nearer to 0 has no sign of its own.
  double rounding() const noexcept {
    return 1e-14 * (std::abs(c0) + std::abs(cx) + std::abs(cy) + std::abs(cz));
  }
  /// The derivatives along the cell's axes at a point. They jump at the faces between cells.
  Vec3 slope(const Vec3& s) const noexcept {
    return {cx + s.y * cxy + s.z * (cxz + s.y * cxyz), cy + s.x * cxy + s.z * (cyz + s.x * cxyz),
            cz + s.x * cxz + s.y * (cyz + s.x * cxyz)};
  }
};

/// Clay::distance_at many times: leaves are remembered from one point to the next.
///
/// Units        mm; the gradient in mm per mm.
/// Accuracy     distance_mm is Clay::distance_at but for the rounding of doubles.
/// Determinism  the same value for a point whatever was asked before.
/// Threads      one for each thread, while nobody edits the clay, which must stay.
/// Cost         50 ns a point when it is near the one before, 150 ns when not.
class FieldSampler final : public DistanceProbe {
 public:
  /// Refers to the clay's levels: an edit or undo of the clay ends its use.
  explicit FieldSampler(const Clay& clay);
  ~FieldSampler() override;
  FieldSampler(const FieldSampler&) = delete;
  FieldSampler& operator=(const FieldSampler&) = delete;

  /// Of a finite point. Where no level has a leaf all corners are one value of the coarsest level,
  /// inside or outside, and per_mm is 0.
  FieldCell cell_at(const Vec3& point_mm);
  double distance_mm(const Vec3& point_mm) override;
  FieldValue value(const Vec3& point_mm) override;

  /// The point with phi = 0 that Newton's rule leads to along the gradient, or where that strays,
  /// as it may at sharp edges, the nearest change of sign along the gradient; nothing when there is
  /// none within 7/8 of a voxel. The voxel is that of the level at `point_mm`, which must be
  /// finite.
  ///
  /// Accuracy  |phi| at the point is at most 0.001 voxel, or 0.01 where the search along the
  ///           gradient found it.
  /// Cost      up to 5 values, and up to 23 more where it has to search.
  std::optional<Vec3> on_surface(const Vec3& point_mm);

 private:
  std::optional<Vec3> sign_change(const Vec3& point_mm, const FieldValue& at);
  struct State;
  std::unique_ptr<State> state_;
};

/// Where rays leave the clay.
///
/// Threads      any, while nobody edits the clay, which must stay.
/// Cost         1 to 10 us a ray, by the cells that it meets.
class RayExits {
 public:
  /// As FieldSampler: refers to the clay's levels.
  explicit RayExits(const Clay& clay);
  ~RayExits();
  RayExits(const RayExits&) = delete;
  RayExits& operator=(const RayExits&) = delete;

  /// How far along the ray the field first goes from inside (< 0) to outside at or after the
  /// origin, which is the far side of the solid that the ray begins in or, when it begins outside,
  /// enters first; nothing where it never does.
  ///
  /// Units        origin and result in finest voxels (ClayOptions::voxel_mm); `direction` of unit
  ///              length.
  /// Accuracy     every cell that the ray meets is looked at, and the cubic that trilinear values
  ///              are along a line is solved: nothing is missed however thin (FieldRay*).
  std::optional<double> first_voxels(const Vec3& origin_voxels, const Vec3& direction) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace argil
