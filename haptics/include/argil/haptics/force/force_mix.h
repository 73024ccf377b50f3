// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/result.h"
#include "argil/core/vec3.h"

namespace argil::haptics {

/// Weights of contact and viscosity while the hand touches the clay (passive) and while it works it
/// (active). Touching, the surface dominates; working, it must let the tool in, and drag takes
/// over.
///
/// Ranges  contact kLeastContact to kMost, viscosity 0 to kMost; contact_passive >
///         viscosity_passive, contact_active < viscosity_active, contact_passive > contact_active,
///         viscosity_passive < viscosity_active.
/// Source  eq. 3 to 5 of Blanch et al. 2004, which give the inequalities and no values. The usual
///         values here leave each force as the material states it where it dominates.
struct ForceMix {
  /// alpha_p: contact while touching.
  double contact_passive = 1.0;
  /// beta_p: viscosity while touching.
  double viscosity_passive = 0.3;
  /// alpha_a: contact while working.
  double contact_active = 0.3;
  /// beta_a: viscosity while working.
  double viscosity_active = 1.0;

  /// A tool that feels nothing of the contact could not be pushed out again without being given
  /// energy (ServoForce::begin_tick).
  static constexpr double kLeastContact = 0.01;
  /// Twice what the material states.
  static constexpr double kMost = 2.0;

  friend bool operator==(const ForceMix&, const ForceMix&) = default;
};

/// Checks ranges and inequalities of ForceMix. For a program that takes them from its user:
/// what uses them trusts them.
///
/// Errors  bad_input naming the field or the two fields, their values, and what they must be.
Result<void> validate(const ForceMix& mix);

/// The two forces of a tick added up between passive and active.
///
/// Units    p: 0 is passive (eq. 3), 1 is active (eq. 4), linear between (eq. 5); exact at the
/// ends. Threads  Realtime; pure.
Vec3 mix_forces(const ForceMix& mix, const Vec3& contact, const Vec3& viscosity, double p) noexcept;

/// The weight of the contact there.
double contact_share(const ForceMix& mix, double p) noexcept;

/// p of eq. 5 over time: a linear ramp between 0 and 1 as the hand begins and ends to work the
/// clay, from wherever it is.
///
/// Threads  Realtime.
class ModeBlend {
 public:
  /// 1 % of the change in a tick of 1 ms.
  static constexpr double kUsualRampS = 0.1;
  /// More is felt as a tool that still works.
  static constexpr double kMostRampS = 2.0;

  /// `ramp_s`: time from one end to the other, 0 to kMostRampS. 0 switches at once, which is felt
  /// as a knock.
  explicit ModeBlend(double ramp_s = kUsualRampS) noexcept;

  /// p after a tick of `period_s`; a period that is not greater than 0 changes nothing.
  double tick(bool is_active, double period_s) noexcept;

  double p() const noexcept { return p_; }

 private:
  double ramp_s_;
  double p_ = 0.0;
};

}  // namespace argil::haptics
