// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/result.h"
#include "argil/haptics/analysis/hold_judgement.h"
#include "argil/haptics/force/tool_force.h"
#include "argil/haptics/simulation/hand_model.h"

namespace argil::evaluation {

/// A ball on clay of some firmness; or a spring from the surface down, to compare with the
/// equation.
struct LateTool {
  const char* name = "";
  double radius_mm = 0.0;
  double skin_mm = 0.0;
  double exponent = 0.0;
  double spring_n_per_m = 0.0;  ///< above 0: the spring; it cuts where 1 N is felt

  bool is_spring() const noexcept { return spring_n_per_m > 0.0; }
};
inline constexpr LateTool kUsualTool{"default", 4.0, 8.0, 2.0};
inline constexpr LateTool kHardTool{"hard", 4.0, 1.0, 4.0};
inline constexpr LateTool kFineTool{"fine", 1.0, 1.0, 4.0};
haptics::ForceMaterial material_of(const LateTool& tool);

/// What the hand does with it.
enum class LateAction {
  touch,   ///< presses 3 N
  slide,   ///< presses 3 N and goes to and fro at 50 mm/s
  carve,   ///< sinks in, led down at 20 mm/s
  add,     ///< rests while clay grows around the tool
  smooth,  ///< rests in a hollow, which fills
};
const char* late_action_name(LateAction action);

/// What is done about windows that are late, each beside what the servo does in any case.
enum class LateRemedy {
  at_once,   ///< nothing: a new window is felt whole at once
  blended,   ///< over 5 ms
  account,   ///< and rises are paid from the account
  stamped,   ///< and the tool's own cuts are taken out of the windows
  governed,  ///< or, in place of that, a coupling as soft as the lateness wants it
  reaching,  ///< a window that reaches as far as the tool goes
};
const char* late_remedy_name(LateRemedy remedy);

/// How late windows are, in s.
struct Lateness {
  double age_s = 0.0;     ///< A, of a window when it is first felt
  double period_s = 0.0;  ///< P, from one to the next
};

struct LateCase {
  LateAction action = LateAction::carve;
  LateTool tool = kFineTool;
  haptics::Hand hand = haptics::Hand::push;
  bool is_direct = false;  ///< no coupling and no governor; the program's velocities
  LateRemedy remedy = LateRemedy::account;
  Lateness late;
};

/// What was found of one run.
struct LateFound {
  haptics::Verdict verdict = haptics::Verdict::quiet;
  double swing_mm = 0.0;  ///< across the surface, in the last second, the hand's own way taken out
  double frequency_hz = 0.0;
  double force_pp_n = 0.0;   ///< likewise
  double mean_n = 0.0;       ///< of the force, in the last second
  double exchange_mw = 0.0;  ///< all that exchanges of windows put in, a mean over the stroke
  double given_mj = 0.0;     ///< the most that the hand got between two moments of the stroke
  double allowed_mj = 0.0;   ///< the most that the account and the device's damping allow of it
  double step_p99_n = 0.0;   ///< of the changes of the felt force by exchanges, each in one tick
  double step_most_n = 0.0;
  double outside_ms = 0.0;   ///< for how long the tool had no window under it
  std::uint32_t faults = 0;  ///< of the servo, from the stroke on
  Result<void> worked;
};

}  // namespace argil::evaluation
