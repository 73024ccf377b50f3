// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "chart/sheet.h"
#include "stability/adaptive/damping.h"

namespace argil::evaluation {

// The charts of adaptive damping as gnuplot scripts that carry their data.

/// The K-c plane of walls, fixed above adaptive.
Script damping_map_script(const std::vector<DampedWallRow>& rows);
/// First failure by the period, and time to settle by the stiffness.
Script damping_script(const std::vector<DampedWallRow>& walls,
                      const std::vector<DampedPeriodRow>& periods);

}  // namespace argil::evaluation
