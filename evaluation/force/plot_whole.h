// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "chart/sheet.h"
#include "force/row.h"

namespace argil::evaluation {

/// What a method takes from a hand that moved, or worked, to a force: the window and the sum, on
/// one axis of time, a panel for each radius whose windows were timed. `rows`: pooled_by_radius.
Script whole_script(const std::vector<ForceRow>& rows, const std::string& title);

}  // namespace argil::evaluation
