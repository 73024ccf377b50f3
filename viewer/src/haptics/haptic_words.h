// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "argil/haptics/falcon/falcon_status.h"

namespace argil::viewer {

/// What the governor of a running rig did last.
struct GovernorState {
  bool is_direct = false;          ///< the coupling; it has no stiffness to hold back
  double asked_n_per_m = 0.0;      ///< of the coupling
  double allowed_n_per_m = 0.0;    ///< by the governor
  double nominal_period_s = 1e-3;  ///< of a tick
  double rate_hz = 0.0;            ///< of the last ticks; 0: not known yet
  double filter_lag_s = 0.0;       ///< of the position filter; 0: there is none
};

/// Says whether it holds the coupling back, how stiff that may be, and what sets the limit.
std::string governor_words(const GovernorState& state);

/// What adaptive damping does now. `added_n_s_per_m`: ServoTick::added_damping_n_s_per_m, >= 0.
std::string damping_words(double added_n_s_per_m);

/// How far a real Falcon has come, and what to do next.
std::string falcon_words(const haptics::FalconStatus& status);

}  // namespace argil::viewer
