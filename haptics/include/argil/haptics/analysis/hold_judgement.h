// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "argil/core/vec3.h"

namespace argil::haptics {

/// How a hold or a stroke went (docs/stability.md, "How it is measured").
enum class Verdict {
  quiet,
  buzz,         ///< the force chatters but the handle hardly moves
  limit_cycle,  ///< the handle swings, and the servo feeds the swing
  unfinished,   ///< the run ended before there was a hold
  gives,        ///< a stroke in which the servo gave the hand more energy than it may; no swing
};
/// "quiet", "buzz", "limit_cycle", "unfinished", "gives". judge_hold() says one of the first three.
const char* verdict_name(Verdict verdict) noexcept;

struct HoldJudgement {
  Verdict verdict = Verdict::quiet;
  /// Peak to peak, along the axis where it is largest.
  double position_pp_mm = 0.0;
  /// Peak to peak, along the axis where it is largest.
  double force_pp_n = 0.0;
  /// Mean power that the servo puts into the handle's swing.
  double work_mw = 0.0;
  /// Of the swing, by its crossings of the mean; 0: fewer than two.
  double frequency_hz = 0.0;
};

/// Beyond this swing of the handle, three counts of the encoder, a hold is a limit cycle.
inline constexpr double kLimitCycleMm = 0.18;
/// Beyond this swing of the force, which a hand no longer ignores, a hold is buzz.
inline constexpr double kBuzzN = 0.5;

/// Judges a hold: consecutive ticks in which the hand means to keep still, usually a second after
/// three in which a press of 3 N settled. A linear drift is taken out first.
///
/// Shapes   position_mm, force_n: one length, at least 3; force_n[i] is held from position_mm[i] to
///          position_mm[i + 1].
/// Units    period_s: > 0.
/// Threads  any; allocates.
/// Source   docs/theory.md, "How a hold is judged".
HoldJudgement judge_hold(std::span<const Vec3> position_mm, std::span<const Vec3> force_n,
                         double period_s);

}  // namespace argil::haptics
