// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "stability/grid.h"
#include "stability/hold.h"

namespace argil::evaluation {

/// One tool held at one clay.
struct VolumeRow {
  double radius_mm = 0.0;  ///< 0: the point law
  double skin_mm = 0.0;
  double exponent = 2.0;
  haptics::Hand hand = haptics::Hand::push;
  bool is_default = false;  ///< the program's servo; else direct
  haptics::HoldJudgement found;
  double rest_slope_n_per_m = 0.0;     ///< where the tool feels 3 N
  double surface_slope_n_per_m = 0.0;  ///< with the tool's centre on the surface
  double point_slope_n_per_m = 0.0;    ///< of the point law there
};

/// How thin the skin may be for one tool, exponent and hand, direct.
struct VolumeLimit {
  double radius_mm = 0.0;  ///< 0: the point law
  double exponent = 2.0;
  haptics::Hand hand = haptics::Hand::push;
  double period_s = 1e-3;
  bool is_frictionless = false;
  FirstFailures found;               ///< by the slope of the point law at the surface
  double quiet_skin_mm = 0.0;        ///< the smallest before the first that is not quiet
  double quiet_slope_n_per_m = 0.0;  ///< where the tool feels 3 N, with that skin
  double cycle_slope_n_per_m = 0.0;  ///< the same at the first limit cycle; 0 where none
  double most_slope_n_per_m = 0.0;   ///< the same of the thinnest skin that was tried
  FirstFailures linear;              ///< of a linear wall and this hand
};

struct VolumeResult {
  std::vector<VolumeRow> rows;
  std::vector<VolumeLimit> limits;
};

/// The volume force on flat clay in the closed loop, one tick of delay: rows at 1 kHz on the
/// nominal device, limits also at 200 Hz and on the frictionless one.
Result<VolumeResult> measure_volume(bool quick, const Progress& progress, double from, double to);
std::string volume_csv(const std::vector<VolumeRow>& rows);
std::string volume_limit_csv(const std::vector<VolumeLimit>& limits);

}  // namespace argil::evaluation
