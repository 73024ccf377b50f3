// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "chart/chart.h"

namespace argil::evaluation {

/// argil chart stability --late: what the age of the clay's windows does to the hand.
Result<cli::Outcome> make_late_chart(const ChartOptions& options, const Progress& progress);

}  // namespace argil::evaluation
