// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "stability/hold.h"

namespace argil::evaluation {

/// One wall of the K-B plane.
struct WallRow {
  haptics::Hand hand = haptics::Hand::push;
  double velocity_lag_s = 0.0;  ///< 0: raw differences
  bool is_frictionless = false;
  double stiffness_n_per_m = 0.0;
  double damping_n_s_per_m = 0.0;
  haptics::HoldJudgement found;
};

/// Walls with stiffness and rendered damping at 1 kHz and one tick of delay: nominal device with
/// raw and with usual velocities, frictionless device with raw ones.
Result<std::vector<WallRow>> measure_walls(bool quick, const Progress& progress, double from,
                                           double to);
std::string wall_csv(const std::vector<WallRow>& rows);

/// Where the exact eigenvalue with raw velocities leaves the unit circle: (K, B), B ascending.
std::vector<std::pair<double, double>> eigenvalue_border(haptics::Hand hand, bool is_frictionless);

}  // namespace argil::evaluation
