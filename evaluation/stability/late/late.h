// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "stability/late/late_run.h"

namespace argil::evaluation {

/// By what a row was found.
enum class LateWay { simulation, clay };
const char* late_way_name(LateWay way);

struct LateRow {
  LateWay way = LateWay::simulation;
  LateCase what;
  LateFound found;
  double stiffness_n_per_m = 0.0;  ///< of what is felt, at 3 N of the material
  double lateness_s = 0.0;         ///< tau
  /// Carving: the first tau that cycles by the equation; none: no tau does.
  std::optional<haptics::Chatter> equation;
};

/// The first age at which a spring that is carved cycles.
struct LateLimit {
  double stiffness_n_per_m = 0.0;
  double period_s = 0.0;
  haptics::Hand hand = haptics::Hand::light;
  bool is_direct = false;
  std::optional<double> equation_s;  ///< the age; may be below 0: any age cycles
  double equation_hz = 0.0;
  std::optional<double> simulated_s;
  double simulated_hz = 0.0;
};

struct LateResult {
  std::vector<LateRow> rows;
  std::vector<LateRow> springs;  ///< the plane of K, A and P
  std::vector<LateLimit> limits;
};

/// Clay that is felt late: touched, slid over, carved, added to and smoothed, in four hands, by the
/// equation, on clay as a height and on real clay, with each remedy.
Result<LateResult> measure_late(bool quick, const Progress& progress, double from, double to);
std::string late_csv(const std::vector<LateRow>& rows);
std::string late_spring_csv(const std::vector<LateRow>& rows);
std::string late_limit_csv(const std::vector<LateLimit>& limits);

/// Of the springs: what they are carved with, and how late.
std::vector<double> late_spring_stiffnesses(bool quick);
std::vector<double> late_ages_s(bool quick);

}  // namespace argil::evaluation
