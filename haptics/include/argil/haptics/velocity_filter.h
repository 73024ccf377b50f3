// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"

namespace argil::haptics {

struct VelocityFilterOptions {
  /// Time constant of the mean, >= 0. 0 gives raw differences, which jump by a quantum a tick: with
  /// a damper of 50 N s/m one count of 60 um flips the force by 3 N at 1 kHz. More is quieter, but
  /// a late damper is a weaker one: at 10 ms a wall with 50 N s/m holds a quarter of the stiffness.
  double lag_s = 3e-3;
};

/// Velocity from positions: the difference over the time that really passed, in an exponential
/// mean. Of a steady motion it is exact; a change shows after lag_s (and half a tick) on average.
///
/// Threads  Realtime.
class VelocityFilter {
 public:
  explicit VelocityFilter(const VelocityFilterOptions& options) noexcept : options_(options) {}

  /// `elapsed_s` since the last position; where it is not above 0 the velocity stays as it was. The
  /// first position gives zero.
  Vec3 update(const Vec3& position_mm, double elapsed_s) noexcept;
  void reset() noexcept;

 private:
  VelocityFilterOptions options_;
  Vec3 last_mm_;
  Vec3 velocity_mm_per_s_;
  bool has_last_ = false;
};

/// Force that a held handle chatters by, peak to peak, where a law K x + c v meets an encoder of
/// this quantum with raw velocities: 2 c quantum / T + K quantum (theory B.4).
/// Units  N s/m, N/m, mm, s.
double quantisation_buzz_n(double damping_n_s_per_m, double stiffness_n_per_m, double quantum_mm,
                           double period_s) noexcept;

}  // namespace argil::haptics
