// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/haptics/analysis/hold_test.h"

namespace argil::evaluation {

/// What is found of a tool that slides, across its path.
struct SlideJudgement {
  /// The worst of all pieces. A swing is looked for in pieces of 0.2 s, in which the hand's own
  /// path is nearly straight: one that crosses its own line at least twice (5 Hz and faster) by
  /// more than a limit cycle's size, and on which the servo does work. Chatter of the force is
  /// looked for in pieces of 0.05 s, so that a hand that sinks in is none.
  haptics::HoldJudgement worst;
  haptics::HoldJudgement whole;  ///< of all of it in one, the sinking in included
  double work_mj = 0.0;          ///< what the servo gave the handle; negative: it took
};

/// Judges `run` from tick `from` to its end; `path`: its direction, unit length.
SlideJudgement judge_slide(const haptics::HoldTestResult& run, std::size_t from, const Vec3& path,
                           double period_s);

}  // namespace argil::evaluation
