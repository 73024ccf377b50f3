// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/field_window.h"

#include "chart/distance.h"

namespace argil::cli::chart {

/// A window filled from a formula.
struct AnalyticWindow {
  FieldWindowView view;
  std::vector<float> values;  ///< what view.distance_mm refers to
};

/// Nodes at multiples of `voxel_mm`, covering at least `reach_mm` to every side of `center_mm`.
AnalyticWindow analytic_window(const Distance& distance_mm, const Vec3& center_mm, double reach_mm,
                               double voxel_mm);

}  // namespace argil::cli::chart
