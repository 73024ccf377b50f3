// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"

namespace argil::haptics {

struct PositionFilterOptions {
  /// tau of eq. 6: the share of the gap that the damped position closes in a tick of 1 ms; above 0,
  /// at most 1 (no filter). Small is smoother and later: 0.1 is a lag of 9.5 ms.
  double gain = 0.1;
  double lambda_mm = 0.3;  ///< eq. 7: motions well above it are not filtered; > 0
};

/// The filtered position of the sculpting report, eq. 6 to 8. The report's tau is a gain per tick,
/// so that the same number is another filter at another rate: here it is for 1 ms and converted,
/// tau' = 1 - (1 - tau)^(T' / T).
///
/// The filtered position stays within (1 - tau') lambda of the real one: eq. 10 as printed lacks
/// the factor 1 - tau (it takes the gap before the tick for the one after it), and so does the
/// bound of eq. 12, which holds but is not reached.
///
/// Use    it cuts the noise of a wavering sensor two to nine times; it does not stop a contact from
///        vibrating, as the report has it, but slows the vibration and makes it larger
///        (docs/stability.md).
/// Threads  Realtime.
class PositionFilter {
 public:
  explicit PositionFilter(const PositionFilterOptions& options) noexcept : options_(options) {}

  /// eq. 8 for a tick of `period_s` (>= 0). The first position comes out as it is.
  Vec3 filter(const Vec3& position_mm, double period_s) noexcept;
  void reset() noexcept { has_damped_ = false; }

  /// Of the last tick: the damped position (6) and the confidence in it (7), 0 to 1.
  const Vec3& damped_mm() const noexcept { return damped_mm_; }
  double confidence() const noexcept { return confidence_; }

 private:
  PositionFilterOptions options_;
  Vec3 damped_mm_;
  double confidence_ = 1.0;
  bool has_damped_ = false;
};

/// tau for another tick.
double gain_for_period(double gain_per_ms, double period_s) noexcept;

/// eq. 7: 1 / (gap / lambda + 1).
double filter_confidence(double gap_mm, double lambda_mm) noexcept;

}  // namespace argil::haptics
