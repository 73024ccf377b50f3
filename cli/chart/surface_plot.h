// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "chart/script.h"
#include "chart/surface_rows.h"

namespace argil::cli::chart {

/// The chart of the surface as a gnuplot script that carries its data.
Script surface_script(const std::vector<SurfaceRow>& rows);

}  // namespace argil::cli::chart
