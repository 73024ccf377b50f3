// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"

namespace argil::haptics {

/// Velocity from positions: the difference from the last position over the time between them, and
/// an exponential mean of these differences, which on a steady acceleration is late by `lag_s` and
/// half a period (for the difference itself), whatever the periods are.
///
/// Lag against noise: one count of the encoder, quantum / period, appears as a speed of 0.06 m/s at
/// 1 kHz; the mean scales it by period / (period + lag). kUsualLagS is the shortest lag, in whole
/// ms, that keeps the noise of the default clay's 10 N s/m, at 0.06 mm and beside a stiffness of
/// 3000 N/m, within the 0.5 N that are felt as buzz (QuantisationBuzz.*). A longer lag lets damping
/// come too late to damp a stiff contact.
///
/// Threads  Realtime.
/// Source   docs/theory.md, "Damping".
class VelocityFilter {
 public:
  static constexpr double kUsualLagS = 3e-3;

  /// Positions closer in time than this count as taken at the same time.
  static constexpr double kLeastPeriodS = 1e-6;

  /// `lag_s`: >= 0; 0 is the raw difference.
  explicit VelocityFilter(double lag_s = kUsualLagS) noexcept;

  /// Velocity in mm/s at a position `period_s` after the last one; 0 at the first. A position that
  /// is not finite, and one at the same time, leave the velocity as it was; the next one is
  /// compared with the last that counted, over all the time since.
  Vec3 velocity(const Vec3& position_mm, double period_s) noexcept;

  /// Forgets the past: for a jump of the positions that is not a motion (homing).
  void reset() noexcept;

 private:
  double lag_s_;
  Vec3 last_mm_;
  Vec3 velocity_mm_per_s_;
  double since_s_ = 0.0;  ///< the last position
  bool has_last_ = false;
};

}  // namespace argil::haptics
