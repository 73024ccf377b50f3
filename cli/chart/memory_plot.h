// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "chart/memory_rows.h"
#include "chart/script.h"

namespace argil::cli::chart {

/// The chart of memory as a gnuplot script that carries its data.
Script memory_script(const std::vector<MemoryRow>& rows);

}  // namespace argil::cli::chart
