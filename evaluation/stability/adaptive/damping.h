// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "argil/haptics/servo/adaptive_damping.h"

#include "stability/grid.h"
#include "stability/hold.h"

namespace argil::evaluation {

/// The damper of a contact: its own c, and whether more is added while the handle swings.
struct Damper {
  haptics::DampingKind kind = haptics::DampingKind::fixed;
  double damping_n_s_per_m = 0.0;
};
/// "fixed" or "adaptive".
const char* damping_name(haptics::DampingKind kind);

/// A hold of 3 N at a linear wall without a coupling, velocities in the usual mean of 3 ms.
struct DampedWallRow {
  haptics::Hand hand = haptics::Hand::push;
  bool is_frictionless = false;
  Damper damper;
  double stiffness_n_per_m = 0.0;
  haptics::HoldJudgement found;
  /// From the tap until the handle stays within 0.09 mm of where it rests; none where it cycles.
  std::optional<double> settle_ms;
  /// What was added: the most in a tick, and the mean of the watch.
  double most_added_n_s_per_m = 0.0;
  double watch_added_n_s_per_m = 0.0;
  /// The most energy that the hand was given.
  double most_given_mj = 0.0;
};

/// The first stiffness that fails, by the period of the servo.
struct DampedPeriodRow {
  haptics::Hand hand = haptics::Hand::push;
  Damper damper;
  double period_s = 1e-3;
  FirstFailures found;
};

/// The most that adaptive damping comes to at 1 kHz: what a damper of that from the start does is
/// measured too, between two steps of the map.
inline constexpr double kBoundDamping = 50.0;

/// A hold in another contact, or through a coupling.
struct DampedContactRow {
  std::string contact;
  haptics::Hand hand = haptics::Hand::push;
  Damper damper;
  haptics::HoldJudgement found;
  double most_added_n_s_per_m = 0.0;
};

/// A motion that a hand makes at will, and what it feels of the damper.
struct DampedMotionRow {
  std::string motion;
  haptics::Hand hand = haptics::Hand::arm;
  Damper damper;
  /// What the servo took from the hand over the motion; below 0: gave.
  double taken_mj = 0.0;
  double mean_force_n = 0.0;
  double most_force_n = 0.0;
  /// What was added: the mean of the ticks, and the most.
  double mean_added_n_s_per_m = 0.0;
  double most_added_n_s_per_m = 0.0;
};

struct DampingResult {
  std::vector<DampedWallRow> walls;
  std::vector<DampedPeriodRow> periods;
  std::vector<DampedContactRow> contacts;
  std::vector<DampedMotionRow> motions;
};

/// Adaptive damping beside fixed: which walls and contacts hold still, by stiffness, damper, period
/// and hand, and what motions at will feel of it. Simulated Falcon, one tick of delay.
Result<DampingResult> measure_damping(bool quick, const Progress& progress, double from, double to);

// Its parts.
Result<std::vector<DampedWallRow>> measure_damped_walls(bool quick, const Progress& progress,
                                                        double from, double to);
Result<std::vector<DampedPeriodRow>> measure_damped_periods(bool quick, const Progress& progress,
                                                            double from, double to);
Result<std::vector<DampedContactRow>> measure_damped_contacts(const Progress& progress, double from,
                                                              double to);
Result<std::vector<DampedMotionRow>> measure_damped_motions(const Progress& progress, double from,
                                                            double to);

std::string damped_wall_csv(const std::vector<DampedWallRow>& rows);
std::string damped_period_csv(const std::vector<DampedPeriodRow>& rows);
std::string damped_contact_csv(const std::vector<DampedContactRow>& rows);
std::string damped_motion_csv(const std::vector<DampedMotionRow>& rows);

/// What all of them hold through: no coupling, no governor, velocities in the usual mean.
HoldCase damped_case(haptics::Hand hand, bool is_frictionless, const Damper& damper,
                     double period_s);

}  // namespace argil::evaluation
