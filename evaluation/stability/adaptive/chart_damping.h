// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "chart/chart.h"

namespace argil::evaluation {

/// argil chart stability --damping: adaptive damping beside fixed.
Result<cli::Outcome> make_damping_chart(const ChartOptions& options, const Progress& progress);

}  // namespace argil::evaluation
