// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "stability/grid.h"
#include "stability/hold.h"

namespace argil::evaluation {

/// One position filter at the contact law of exponent 4.
struct FilterRow {
  haptics::Hand hand = haptics::Hand::push;
  double gain = 1.0;       ///< tau of eq. 6 of INRIA report 5090; 1: no filter
  double lambda_mm = 1.0;  ///< of eq. 7; 0: the force is filtered instead
  FirstFailures found;
  double ratio = 1.0;  ///< of the first limit cycle to that without the filter
};

/// The tau-lambda plane at 1 kHz with one tick of delay, nominal device.
Result<std::vector<FilterRow>> measure_filters(bool quick, const Progress& progress, double from,
                                               double to);
std::string filter_csv(const std::vector<FilterRow>& rows);

}  // namespace argil::evaluation
