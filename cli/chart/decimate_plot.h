// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "chart/decimate_rows.h"
#include "chart/script.h"

namespace argil::cli::chart {

/// The chart of removing triangles as a gnuplot script that carries its data.
Script decimate_script(const std::vector<DecimateRow>& rows);

}  // namespace argil::cli::chart
