// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/result.h"
#include "argil/core/vec3.h"

namespace argil::haptics {

/// How much of the contact and of the viscosity is felt while the hand touches (passive) and while
/// it works the clay (active): eq. 3 to 5 of the report. Touching, the surface dominates; working,
/// it must let the tool in, and the drag takes over.
///
/// All are finite and at least 0, and contact_passive > viscosity_passive, contact_active <
/// viscosity_active, contact_passive > contact_active, viscosity_passive < viscosity_active. The
/// report gives no values; these keep the forces as the material states them where they dominate.
struct ForceMix {
  double contact_passive = 1.0;    ///< alpha_p
  double viscosity_passive = 0.3;  ///< beta_p
  double contact_active = 0.3;     ///< alpha_a
  double viscosity_active = 1.0;   ///< beta_a
};

/// Bad input, with the fields and their values, where one of the inequalities does not hold.
Result<void> validate(const ForceMix& mix);

/// Eq. 5: the sum of both forces at `p` between passive (0: eq. 3) and active (1: eq. 4). Exact at
/// both ends. Threads: Realtime.
Vec3 mix_forces(const ForceMix& mix, const Vec3& contact, const Vec3& viscosity, double p) noexcept;

/// p of eq. 5: ramps linearly between 0 and 1 as the hand begins and ends to work the clay, from
/// wherever it is.
///
/// Threads  Realtime.
class ModeBlend {
 public:
  static constexpr double kUsualRampS = 0.1;

  /// `ramp_s`: from one end to the other, >= 0. Usual 0.1: 1 % of the change in a tick of 1 ms. 0
  /// switches at once, which is felt as a knock.
  explicit ModeBlend(double ramp_s = kUsualRampS) noexcept;

  /// p after a tick of `period_s`; a period that is not greater than 0 changes nothing.
  double tick(bool is_active, double period_s) noexcept;

  double p() const noexcept { return p_; }

 private:
  double ramp_s_;
  double p_ = 0.0;
};

}  // namespace argil::haptics
