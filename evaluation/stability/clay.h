// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/haptics/force/tool_force.h"
#include "argil/haptics/scene/scene.h"

namespace argil::evaluation {

/// Clay of 3 N on its surface, clamped at 8 N, whose point law has this slope there.
haptics::ForceMaterial material_of(double exponent, double slope_n_per_m);

/// The half space y < 0 as clay, felt by a ball in closed form or, with radius 0, at a point. It
/// cannot be carved.
class ClayPlane final : public haptics::ForceScene {
 public:
  ClayPlane(double radius_mm, const haptics::ForceMaterial& material);
  haptics::SceneForce force_at(const haptics::HandleState& handle) const noexcept override;

  double force_n(double height_mm) const noexcept;
  double slope_n_per_m(double height_mm) const noexcept;
  /// Where the force is `force_n`, which the clamp must allow.
  double height_mm(double force_n) const noexcept;

 private:
  haptics::ForceTool tool_;
  haptics::ForceMaterial material_;
  double radius_mm_;
};

}  // namespace argil::evaluation
