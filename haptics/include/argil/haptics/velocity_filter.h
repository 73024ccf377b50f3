// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"

namespace argil::haptics {

/// Velocity from positions: the difference from the last one over the time between them, and an
/// exponential mean of these that is late by `lag_s` on a steady acceleration (half a period more
/// for the difference itself), whatever the periods are.
///
/// Lag against noise: one count of the encoder, quantum / period, appears as a speed of 0.06 m/s at
/// 1 kHz; the mean scales it by period / (period + lag). kUsualLagS is the shortest, in whole ms,
/// that keeps what the default clay's 10 N s/m make of 0.06 mm, beside a stiffness of 3000 N/m,
/// within the 0.5 N that are felt as buzz (quantisation_buzz_n). A longer one lets damping come too
/// late to damp a stiff contact.
///
/// Threads  Realtime.
/// Source   ../shared/facts/theory.md section B.4.
class VelocityFilter {
 public:
  static constexpr double kUsualLagS = 3e-3;

  /// Positions closer in time than this count as taken at the same time.
  static constexpr double kLeastPeriodS = 1e-6;

  explicit VelocityFilter(double lag_s = kUsualLagS) noexcept;  ///< >= 0; 0 is the raw difference

  /// Velocity in mm/s at a position `period_s` after the last one; 0 at the first. A position that
  /// is not finite, and one at the same time, leave the velocity as it was; the next one is
  /// compared with the last that counted, over all the time since.
  Vec3 velocity(const Vec3& position_mm, double period_s) noexcept;

  /// Forgets the past: for a jump of the positions that is no motion (homing).
  void reset() noexcept;

 private:
  double lag_s_;
  Vec3 last_mm_;
  Vec3 velocity_mm_per_s_;
  double since_s_ = 0.0;  ///< the last position
  bool has_last_ = false;
};

/// Largest damping B that is stable on a free mass, from raw differences of the position, when the
/// force is held for a tick and comes `delay_ticks` >= 0 ticks late: g m / T with g = 2 tan(pi / (4
/// (1 + d))): 2, 0.83, 0.54 for 0, 1, 2 ticks. With a filter's lag a little less: 0.70 for 1 tick
/// and kUsualLagS at 1 kHz.
///
/// Source  own: (z - 1) z^(d+1) + B T / (2 m) (z + 1) = 0 with z on the unit circle.
double most_damping_n_s_per_m(double mass_kg, double period_s, int delay_ticks) noexcept;

/// Force from peak to peak that one step of the encoder makes as it comes and goes: 2 c quantum / T
/// share + K quantum, `share` being that of a velocity filter of this lag.
double quantisation_buzz_n(double damping_n_s_per_m, double stiffness_n_per_m, double quantum_mm,
                           double period_s, double lag_s = 0.0) noexcept;

}  // namespace argil::haptics
