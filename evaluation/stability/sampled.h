// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stability/grid.h"
#include "stability/hold.h"

namespace argil::evaluation {

/// Through what the clay is felt.
enum class ServedServo {
  direct,  ///< no coupling, no governor, the program's velocities
  raw,     ///< the same with velocities straight from differences of positions
  usual,   ///< the program's own options
};
const char* served_servo_name(ServedServo servo);

/// One tool held at, or carving, clay that is sampled in windows.
struct SampledRow {
  bool is_carving = false;
  bool has_drag = true;  ///< false: contact alone, as in closed form
  double exponent = 2.0;
  double radius_mm = 0.0;
  double skin_mm = 0.0;
  haptics::Hand hand = haptics::Hand::push;
  ServedServo servo = ServedServo::direct;
  haptics::HoldJudgement found;  ///< carving: the worst piece, across the path
  haptics::HoldJudgement whole;  ///< carving: all of it
  double work_mj = 0.0;          ///< carving: what the servo gave over the path
  int dabs = 0;
  double closed_slope_n_per_m = 0.0;       ///< where the closed form gives 3 N
  double felt_slope_n_per_m = 0.0;         ///< passive: of the last window, there
  std::optional<haptics::Verdict> closed;  ///< passive: the same hold in closed form, no drag
  std::uint32_t faults = 0;                ///< of the servo, after the start
  Result<void> worked;
};

/// The first skin of a grid that cycles, in closed form and on sampled clay, direct.
struct SampledLimit {
  double exponent = 2.0;
  double radius_mm = 0.0;
  haptics::Hand hand = haptics::Hand::push;
  bool has_drag = false;
  double closed_skin_mm = 0.0;         ///< 0: none cycles
  double sampled_skin_mm = 0.0;        ///< 0: none cycles
  double closed_slope_n_per_m = 0.0;   ///< where it rests, at the first that cycles
  double sampled_slope_n_per_m = 0.0;  ///< the same on sampled clay
  double linear_n_per_m = 0.0;         ///< first limit cycle of a linear wall
  Result<void> worked;
};

struct SampledResult {
  std::vector<SampledRow> rows;
  std::vector<SampledLimit> limits;
};

/// The volume force on flat clay that is served in windows: held, and while it carves. 1 kHz, one
/// tick of delay, nominal device.
Result<SampledResult> measure_sampled(bool quick, const Progress& progress, double from, double to);
std::string sampled_csv(const std::vector<SampledRow>& rows);
std::string sampled_limit_csv(const std::vector<SampledLimit>& limits);

}  // namespace argil::evaluation
