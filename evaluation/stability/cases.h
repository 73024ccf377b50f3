// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "stability/hold.h"

namespace argil::evaluation {

/// One hold, for the tables of docs/stability.md.
struct CaseRow {
  std::string contact;
  std::string remedy;
  bool is_frictionless = false;
  double period_s = 1e-3;
  haptics::Hand hand = haptics::Hand::push;
  haptics::HoldJudgement found;
};

/// What fixes what: rigid and linear walls and the contact law of exponent 4, with every remedy;
/// swings of the filters; buzz of dampers. One tick of delay.
Result<std::vector<CaseRow>> measure_cases(const Progress& progress, double from, double to);
std::string case_csv(const std::vector<CaseRow>& rows);

}  // namespace argil::evaluation
