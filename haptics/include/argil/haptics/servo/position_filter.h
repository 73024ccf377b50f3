// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/result.h"
#include "argil/core/vec3.h"

namespace argil::haptics {

struct PositionFilterOptions {
  /// tau of eq. 6: fraction of the gap that the damped position closes in a tick of 1 ms; usual 0.2
  /// (a time constant of 4.5 ms), kLeastGain (1 s) to 1 (no filter). Around 0.1 it is worst for
  /// stability.
  double gain = 0.2;

  /// lambda of eq. 7: the amplitude of movement to cut, mm; usual 0.3, greater than 0, at most
  /// kMostLambdaMm. More makes a contact that vibrates heave instead, slower and further.
  double lambda_mm = 0.3;

  /// A tenth of what a Falcon reaches: a tool that is farther from the handle is another tool.
  static constexpr double kMostLambdaMm = 10.0;
  static constexpr double kLeastGain = 0.001;

  friend bool operator==(const PositionFilterOptions&, const PositionFilterOptions&) = default;
};

/// Checks the ranges of PositionFilterOptions. For a program that takes them from its user:
/// what uses them trusts them.
///
/// Errors  bad_input naming the field and its value.
Result<void> validate(const PositionFilterOptions& options);

/// How late the filter follows a slow, small motion, s: T (1 - tau') / tau' with the gain tau' of a
/// tick of `period_s`. It counts as delay for whatever a stiffness is bounded by; a motion larger
/// than lambda it follows sooner.
///
/// Units   period_s > 0; options as `validate` accepts them.
/// Source  docs/theory.md, "Filters".
double filter_lag_s(const PositionFilterOptions& options, double period_s) noexcept;

/// How far the filtered position may be from the real one, mm: (1 - tau') lambda (eq. 11, 12).
double most_filter_gap_mm(const PositionFilterOptions& options, double period_s) noexcept;

/// A low-pass near the damped position, the real position far from it. It cuts the jitter of the
/// encoders; it does not make an unstable contact stable (docs/theory.md, "Filters").
///
///   dp = p_r - p_d    p_d <- p_d + tau dp    gamma = 1 / (|dp| / lambda + 1)
///   p_f = gamma p_d + (1 - gamma) p_r
///
/// The printed eq. 10 and 12 lack a factor: after eq. 6 the gap p_r - p_d is (1 - tau) dp, so that
/// |p_f - p_r| = (1 - tau) gamma |dp| < (1 - tau) lambda. Equation10, Equation11and12 hold this.
///
/// Threads  Realtime.
/// Cost     0.1 us, most of it the gain for the tick's period.
/// Source   eq. 6 to 12 of Blanch et al. 2004 (docs/equations.md).
class PositionFilter {
 public:
  /// `options`: as `validate` accepts them.
  explicit PositionFilter(const PositionFilterOptions& options) noexcept;

  /// The filtered position after a tick of `period_s`; the first is the real position itself. A
  /// position that is not finite changes nothing.
  Vec3 filter(const Vec3& position_mm, double period_s) noexcept;

  /// Forgets the past, as before the first position.
  void reset() noexcept;

  /// p_d of the last position.
  const Vec3& damped_mm() const noexcept { return damped_mm_; }

  /// gamma of the last position: 1 where the damped one is trusted, towards 0 far from it.
  double confidence() const noexcept { return confidence_; }

  /// The gain of a tick of another period: 1 - (1 - tau)^(period / 1 ms), so that the damped
  /// position does not depend on the rate. 0 for a period that is not greater than 0.
  double gain_over(double period_s) const noexcept;

 private:
  PositionFilterOptions options_;
  Vec3 damped_mm_;
  Vec3 filtered_mm_;
  double confidence_ = 1.0;
  bool has_start_ = false;
};

}  // namespace argil::haptics
