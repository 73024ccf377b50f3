// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "argil/core/vec3.h"
#include "argil/haptics/analysis/hold_judgement.h"

namespace argil::haptics {

/// What is found of a tool that slides, across its path.
struct SlideJudgement {
  /// The worst of all pieces. A swing is looked for in pieces of 0.2 s, in which the hand's own
  /// path is nearly straight: one that crosses its own line at least twice (5 Hz and faster) by
  /// more than a limit cycle's size, and on which the servo does work. Chatter of the force is
  /// looked for in pieces of 0.05 s, so that a hand that sinks in is none.
  HoldJudgement worst;
  /// Of all of it in one, the sinking in included.
  HoldJudgement whole;
  /// What the servo gave the handle from the first position to the last; negative: it took.
  double work_mj = 0.0;
  /// The most that it gave between any two moments of it; >= 0.
  double most_given_mj = 0.0;
};

/// Judges a slide or a stroke, consecutive ticks in which the hand moves on purpose.
///
/// Shapes   position_mm, force_n: one length, at least 3; force_n[i] is held from position_mm[i] to
///          position_mm[i + 1].
/// Units    path: the direction that is not judged, unit length. period_s: > 0.
/// Threads  any; allocates.
/// Source   docs/stability.md, "Clay in windows, held and carved".
SlideJudgement judge_slide(std::span<const Vec3> position_mm, std::span<const Vec3> force_n,
                           const Vec3& path, double period_s);

}  // namespace argil::haptics
