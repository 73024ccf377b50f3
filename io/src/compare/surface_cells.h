// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>

#include "argil/engine/field_sampler.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::io {

/// A cell and where it lies; no side where phi has none.
struct PlacedCell {
  FieldCell field;
  Vec3 low_mm;
  double side_mm = 0.0;
};

inline PlacedCell placed_cell_at(const Vec3& at, FieldSampler& field) {
  PlacedCell cell{field.cell_at(at), {}, 0.0};
  if (cell.field.per_mm == 0.0) return cell;
  cell.side_mm = 1.0 / cell.field.per_mm;
  cell.low_mm = at - cell.side_mm * cell.field.fraction;
  return cell;
}

/// Whether phi = 0 passes between the corners. What is 0 counts as outside.
inline bool is_crossed(const FieldCell& cell) noexcept {
  const auto inside =
      std::count_if(cell.corners.begin(), cell.corners.end(), [](float v) { return v < 0.0F; });
  return inside != 0 && inside != 8;
}

/// How far beside its cell a triangle of an extracted surface may lie, in sides: its vertices move
/// 0.15 off their edges (docs/surface.md), and inward_of() moves a little more.
inline constexpr double kBesideCell = 0.16;

/// A little inward of the middle: a triangle in the face between two cells belongs to the one with
/// clay in it.
inline constexpr double kInwardVoxels = 0.001;
inline Vec3 inward_of(const mesh::Corners& c, double voxel_mm) noexcept {
  return mesh::middle(c) - kInwardVoxels * voxel_mm * normalized(mesh::area_normal(c));
}

/// Calls `use(cell, distance)` for cells that phi = 0 passes through and that are no farther than
/// kBesideCell from a point in `own`, in sides of it along the axes.
template <class Use>
void for_each_crossed_beside(const Vec3& at, const PlacedCell& own, FieldSampler& field,
                             const Use& use) {
  assert(own.side_mm > 0.0);
  const Vec3& fraction = own.field.fraction;
  // Along each axis: how far it is to the cell before or behind, where that is near, and where to.
  std::array<std::optional<double>, 3> steps;
  for (std::size_t k = 0; k < 3; ++k) {
    if (fraction[k] <= kBesideCell) steps[k] = -fraction[k];
    if (fraction[k] >= 1.0 - kBesideCell) steps[k] = 1.0 - fraction[k];
  }
  for (unsigned axes = 1; axes < 8; ++axes) {
    Vec3 to = at;
    double distance = 0.0;
    bool is_near = true;
    for (std::size_t k = 0; k < 3; ++k) {
      if ((axes >> k & 1U) == 0) continue;
      is_near = is_near && steps[k].has_value();
      const double step = steps[k].value_or(0.0);
      distance = std::max(distance, std::abs(step));
      to[k] += own.side_mm * (step + (fraction[k] < 0.5 ? -0.01 : 0.01));
    }
    if (!is_near) continue;
    const PlacedCell beside = placed_cell_at(to, field);
    if (beside.side_mm > 0.0 && is_crossed(beside.field)) use(beside, distance);
  }
}

}  // namespace argil::io
