// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "chart/sheet.h"
#include "edits/row.h"

namespace argil::evaluation {

/// The chart of edits as a gnuplot script that carries its data.
Script edits_script(const std::vector<EditRow>& rows);

}  // namespace argil::evaluation
