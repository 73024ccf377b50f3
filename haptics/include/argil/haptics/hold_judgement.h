// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "argil/core/vec3.h"

namespace argil::haptics {

enum class Verdict {
  quiet,
  buzz,         ///< the force chatters but the handle hardly moves
  limit_cycle,  ///< the handle swings, and the servo pays for it
};
const char* verdict_name(Verdict verdict) noexcept;  ///< "quiet", "buzz", "limit_cycle"

struct HoldJudgement {
  Verdict verdict = Verdict::quiet;
  double position_pp_mm = 0.0;  ///< peak to peak, along the axis where it is largest
  double force_pp_n = 0.0;
  double work_mw = 0.0;       ///< mean power of the servo on the handle's swing
  double frequency_hz = 0.0;  ///< of the swing, by its crossings of the mean
};

/// The handle swings by more than three quanta of the encoder: a limit cycle.
inline constexpr double kLimitCycleMm = 0.18;
/// The force swings by more than a hand ignores: buzz.
inline constexpr double kBuzzN = 0.5;

/// Judges a hold: positions and forces of consecutive ticks in which the hand means to keep still
/// (theory B.1: press 3 N, settle 3 s, then 1 s). A linear drift is taken out first. Both spans of
/// one length, at least 3; force_n[i] is held from position_mm[i] to position_mm[i + 1].
HoldJudgement judge_hold(std::span<const Vec3> position_mm, std::span<const Vec3> force_n,
                         double period_s);

}  // namespace argil::haptics
