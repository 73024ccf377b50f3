// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "stability/grid.h"
#include "stability/hold.h"

namespace argil::evaluation {

/// What is done against vibration on a linear wall.
enum class Remedy {
  direct,           ///< nothing
  force_filter,     ///< the force in a mean of 0.1 a millisecond
  position_filter,  ///< eq. 6 to 8 of INRIA report 5090, tau 0.1, lambda 1 mm
  viscosity,        ///< the wall has a damper of 10 N s/m
  passivity,        ///< observer and controller
  indirect,         ///< the coupling's spring of 1500 N/m, not governed
  usual,            ///< the program's own options
};
const char* remedy_name(Remedy remedy);

struct StiffnessRow {
  Remedy remedy = Remedy::direct;
  haptics::Hand hand = haptics::Hand::push;
  bool is_frictionless = false;
  double period_s = 1e-3;
  int delay_ticks = 1;
  FirstFailures found;
  double eigenvalue_n_per_m = 0.0;  ///< of the bare wall, with the damper where there is one
  double formula_n_per_m = 0.0;     ///< the same
};

/// Largest stable stiffness of a wall for every remedy, period, delay, hand and device.
Result<std::vector<StiffnessRow>> measure_stiffness(bool quick, const Progress& progress,
                                                    double from, double to);

std::string stiffness_csv(const std::vector<StiffnessRow>& rows);

}  // namespace argil::evaluation
