// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stability/hold.h"

namespace argil::evaluation {

/// A tool that slides passively over flat clay, through the cells of its windows, without a
/// coupling.
struct CoggingRow {
  double radius_mm = 0.0;
  double exponent = 2.0;
  double skin_mm = 0.0;
  double tilt_deg = 0.0;  ///< of the surface against the cells
  double speed_mm_per_s = 0.0;
  std::optional<haptics::Hand> hand;  ///< none: the path is prescribed, at one depth
  bool has_drag = true;               ///< false: contact alone, as in closed form

  double cell_mm = 0.0;       ///< the windows' spacing, h
  double cells_per_s = 0.0;   ///< how often the tool passes one, along its fastest axis
  double mean_force_n = 0.0;  ///< along the normal
  double normal_pp = 0.0;     ///< peak to peak along the normal, as a fraction of that force
  double sideways_pp = 0.0;   ///< the larger of along the path and across it
  double at_cells_pp = 0.0;   ///< of the normal force, twice the amplitude at cells_per_s
  /// pi pp F / h: how steep a wave of that size and one cell's length is. Prescribed: of the larger
  /// ripple; with a hand of at_cells_pp.
  double cogging_n_per_m = 0.0;

  // With a hand. What is no swing there is the encoder's counts and not the cells, so that only
  // at_cells_pp tells of them.
  haptics::HoldJudgement found;   ///< the worst piece across the path
  haptics::HoldJudgement closed;  ///< the same slide in closed form: no cells, no drag
  double closed_normal_pp = 0.0;  ///< the ripple there
  Result<void> worked;
};

/// Prescribed slides and slides in a hand that presses 3 N, at 1 kHz on the nominal device.
Result<std::vector<CoggingRow>> measure_cogging(bool quick, const Progress& progress, double from,
                                                double to);
std::string cogging_csv(const std::vector<CoggingRow>& rows);

/// Of docs/theory.md, C.4: the worst ripple of a smooth kernel with so many nodes across it, as a
/// fraction of the force.
inline constexpr double kTheorySmooth8 = 0.014;
inline constexpr double kTheorySmooth16 = 0.0009;

}  // namespace argil::evaluation
