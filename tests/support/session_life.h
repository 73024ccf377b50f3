// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <random>

#include "argil/engine/clay.h"
#include "argil/io/stroke_script.h"

#include "support/stroke_maker.h"

namespace argil::test {

// One life of a sculpting program, as the child that is killed lives it and as the test that judges
// what it left repeats it: both must do the same steps.

inline constexpr int kLifeTurns = 24;

/// What is done at a turn: a step, or nothing, which means: save the project.
inline std::optional<io::ScriptStep> life_step(unsigned seed, int turn) {
  std::mt19937 random(seed * 1000U + static_cast<unsigned>(turn));
  switch (random() % 12) {
    case 0:
      return std::nullopt;
    case 1:
    case 2:
      return io::HistoryStep::undo;
    case 3:
      return io::HistoryStep::redo;
    case 4:
      return static_cast<MaskEdit>(random() % 4);
    case 5: {
      Stroke held = random_dab(random, 6.0);
      held.tool.action = Action::mask;
      return held;
    }
    default:
      return random_dab(random, 6.0);
  }
}

inline Clay life_start() { return Clay::ball(6.0, {0.4, 0.1}).value(); }

}  // namespace argil::test
