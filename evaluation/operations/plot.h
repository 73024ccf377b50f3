// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "chart/sheet.h"
#include "operations/row.h"

namespace argil::evaluation {

/// The chart of operations as a gnuplot script that carries its data: a panel for each.
Script operations_script(const std::vector<OperationRow>& rows);

}  // namespace argil::evaluation
