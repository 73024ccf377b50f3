// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "chart/sheet.h"

namespace argil::evaluation {

/// One strategy with one setting on points of one depth.
struct NormalRow {
  std::string strategy;
  double setting = 0.0;  ///< NormalStrategy::setting
  double depth_mm = 0.0;
  double angle_rms_deg = 0.0;  ///< between its normal and that of the nearest point
  double angle_max_deg = 0.0;
  double distance_rms_mm = 0.0;  ///< between its distance and that to the nearest point
  double distance_max_mm = 0.0;
  std::size_t bytes = 0;
  double ns = 0.0;  ///< thread CPU time of one answer that waits for the one before it, median
};

/// Where points are measured: on the surface, and as deep as light and firm presses are at 1 N/mm.
inline constexpr double kNormalDepthsMm[] = {0.0, 1.0, 3.0};

Result<std::vector<NormalRow>> measure_normals(bool quick, const Progress& progress);
std::string normals_csv(const std::vector<NormalRow>& rows);

/// The chart as a gnuplot script that carries its data.
Script normals_script(const std::vector<NormalRow>& rows);

}  // namespace argil::evaluation
