// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "argil/core/vec3.h"
#include "argil/engine/clay.h"

#include "field_ray.h"

namespace argil::io {

struct FieldValue {
  double distance_mm = 0.0;
  Vec3 gradient;          ///< of the trilinear values of the cell; zero far from the surface
  double voxel_mm = 0.0;  ///< of the level that the value comes from
};

/// The cell whose corners phi is interpolated between at a place.
struct FieldCell {
  std::array<float, 8> corners{};
  Vec3 share;  ///< of the place: 0 to 1 from the low corner
  double per_mm = 0.0;
  int level = 0;
};

/// Clay::distance_at many times: leaves are remembered from one place to the next. One for each
/// thread, while nobody edits the clay.
/// Cost  50 ns a place when it is near the one before, 150 ns when not.
class FieldSampler {
 public:
  explicit FieldSampler(const Clay& clay)
      : stack_(clay.levels()), cells_(stack_), per_mm_(1.0 / stack_.voxel_mm(0)) {}

  FieldCell cell_at(const Vec3& place_mm);
  double distance_mm(const Vec3& place_mm);
  FieldValue value(const Vec3& place_mm);

  /// The place with phi = 0 that Newton's rule leads to along the gradient, or where that strays,
  /// as it may at sharp edges, the nearest change of sign along the gradient; nothing when there is
  /// none within 7/8 of a voxel.
  std::optional<Vec3> on_surface(const Vec3& place_mm);

 private:
  std::optional<Vec3> sign_change(const Vec3& place_mm, const FieldValue& at);

  const LevelStack& stack_;
  LeafCells cells_;
  double per_mm_;  ///< cells of level 0
};

}  // namespace argil::io
