// SPDX-License-Identifier: GPL-3.0-or-later
// Walls: fixed damping beside adaptive, by stiffness, damper, hand and period.
#include "stability/adaptive/damping.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>
#include <utility>

namespace argil::evaluation {
namespace {

using haptics::DampingKind;

constexpr double kLeastDampedWall = 500.0;
constexpr double kMostDampedWall = 40000.0;
/// Half of what a limit cycle is told by.
constexpr double kSettledMm = 0.5 * haptics::kLimitCycleMm;

/// From the first force until the handle is at rest for good.
std::optional<double> settle_ms(const haptics::HoldTestResult& run, double period_s) {
  if (run.judgement.verdict == haptics::Verdict::limit_cycle) return std::nullopt;
  const auto& y = run.true_position_mm;
  assert(y.size() == run.held_force_n.size() && !y.empty());
  std::size_t touched = 0;
  while (touched + 1 < y.size() && run.held_force_n[touched] == Vec3{}) ++touched;
  std::size_t rested = y.size();
  while (rested > touched && std::abs(y[rested - 1].y - run.mean_position_mm.y) <= kSettledMm) {
    --rested;
  }
  return 1e3 * period_s * static_cast<double>(rested - touched);
}

void measure_damped_wall(DampedWallRow& row) {
  const HoldCase held = damped_case(row.hand, row.is_frictionless, row.damper, kPeriodS);
  haptics::WallScene wall = linear_wall(row.stiffness_n_per_m, row.damper.damping_n_s_per_m);
  const haptics::HoldTest test = hold_test(held, wall_rest_mm(held, row.stiffness_n_per_m));
  const haptics::HoldTestResult run = haptics::run_hold_test(wall, test);
  row.found = run.judgement;
  row.settle_ms = settle_ms(run, kPeriodS);
  row.most_given_mj = run.most_given_nmm;
  const auto watched = static_cast<std::size_t>(std::lround(test.watch_s / kPeriodS));
  assert(run.ticks.size() > watched);
  for (std::size_t n = 0; n < run.ticks.size(); ++n) {
    const double added = run.ticks[n].added_damping_n_s_per_m;
    row.most_added_n_s_per_m = std::max(row.most_added_n_s_per_m, added);
    if (n + watched >= run.ticks.size()) {
      row.watch_added_n_s_per_m += added / static_cast<double>(watched);
    }
  }
}

std::vector<Damper> wall_dampers(bool quick) {
  std::vector<Damper> dampers;
  for (const DampingKind kind : {DampingKind::fixed, DampingKind::adaptive}) {
    dampers.push_back({kind, 0.0});
    for (const double damping : spread(1.25, 80.0, quick ? 4 : 13)) {
      dampers.push_back({kind, damping});
    }
    if (kind == DampingKind::fixed) dampers.push_back({kind, kBoundDamping});
  }
  return dampers;
}

void add_walls(std::vector<DampedWallRow>& rows, haptics::Hand hand, bool is_frictionless,
               const Damper& damper, bool quick) {
  for (const double k : spread(kLeastDampedWall, kMostDampedWall, quick ? 6 : 24)) {
    DampedWallRow& row = rows.emplace_back();
    row.hand = hand;
    row.is_frictionless = is_frictionless;
    row.damper = damper;
    row.stiffness_n_per_m = k;
  }
}

void search_period(DampedPeriodRow& row, const StiffnessGrid& grid) {
  const HoldCase held = damped_case(row.hand, false, row.damper, row.period_s);
  const double guess = formula_n_per_m(held, row.damper.damping_n_s_per_m);
  row.found = first_failures(grid, guess, 4, [&](double n_per_m) {
    return hold_wall(held, n_per_m, row.damper.damping_n_s_per_m).verdict;
  });
}

}  // namespace

const char* damping_name(DampingKind kind) {
  return kind == DampingKind::fixed ? "fixed" : "adaptive";
}

HoldCase damped_case(haptics::Hand hand, bool is_frictionless, const Damper& damper,
                     double period_s) {
  HoldCase held;
  held.hand = hand;
  held.device = falcon(is_frictionless, 1);
  held.servo = haptics::bare_servo(period_s);
  held.servo.velocity_lag_s = haptics::VelocityFilter::kUsualLagS;
  held.servo.damping.kind = damper.kind;
  return held;
}

Result<std::vector<DampedWallRow>> measure_damped_walls(bool quick, const Progress& progress,
                                                        double from, double to) {
  std::vector<DampedWallRow> rows;
  for (const bool is_frictionless : {false, true}) {
    for (const haptics::Hand hand : kHands) {
      for (const Damper& damper : wall_dampers(quick))
        add_walls(rows, hand, is_frictionless, damper, quick);
    }
  }
  std::vector<std::function<void()>> work;
  work.reserve(rows.size());
  for (DampedWallRow& row : rows) work.emplace_back([&row] { measure_damped_wall(row); });
  if (auto done = run_all(work, progress, "adaptive damping, walls", from, to); !done) {
    return done.error();
  }
  return rows;
}

Result<std::vector<DampedPeriodRow>> measure_damped_periods(bool quick, const Progress& progress,
                                                            double from, double to) {
  std::vector<double> periods_ms{0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0};
  if (quick) periods_ms = {0.5, 1.0, 5.0};
  const StiffnessGrid grid(quick ? 1.3 : 1.1);
  std::vector<DampedPeriodRow> rows;
  for (const haptics::Hand hand : kHands) {
    for (const Damper& damper :
         {Damper{DampingKind::fixed, 0.0}, Damper{DampingKind::fixed, 10.0},
          Damper{DampingKind::fixed, kBoundDamping}, Damper{DampingKind::adaptive, 0.0}}) {
      for (const double period_ms : periods_ms) {
        rows.push_back({hand, damper, 1e-3 * period_ms, {}});
      }
    }
  }
  std::vector<std::function<void()>> work;
  work.reserve(rows.size());
  for (DampedPeriodRow& row : rows) work.emplace_back([&row, &grid] { search_period(row, grid); });
  if (auto done = run_all(work, progress, "adaptive damping, periods", from, to); !done) {
    return done.error();
  }
  return rows;
}

Result<DampingResult> measure_damping(bool quick, const Progress& progress, double from,
                                      double to) {
  DampingResult all;
  const auto part = [&](double fraction) { return from + (to - from) * fraction; };
  auto walls = measure_damped_walls(quick, progress, from, part(0.7));
  if (!walls) return walls.error();
  all.walls = std::move(walls).value();
  auto periods = measure_damped_periods(quick, progress, part(0.7), part(0.95));
  if (!periods) return periods.error();
  all.periods = std::move(periods).value();
  auto contacts = measure_damped_contacts(progress, part(0.95), part(0.97));
  if (!contacts) return contacts.error();
  all.contacts = std::move(contacts).value();
  auto motions = measure_damped_motions(progress, part(0.97), to);
  if (!motions) return motions.error();
  all.motions = std::move(motions).value();
  return all;
}

std::string damped_wall_csv(const std::vector<DampedWallRow>& rows) {
  std::ostringstream text;
  text << "# A hold of 3 N at a wall of stiffness K and damping c, 1 kHz, one tick of delay, no "
          "coupling, velocities in a mean of 3 ms\n"
          "device,hand,damping,k_n_per_m,c_n_s_per_m,verdict,position_pp_mm,force_pp_n,settle_ms,"
          "added_most_n_s_per_m,added_watch_n_s_per_m,most_given_mj\n";
  text.precision(4);
  for (const DampedWallRow& row : rows) {
    text << (row.is_frictionless ? "frictionless" : "nominal") << ','
         << haptics::hand_model(row.hand).name << ',' << damping_name(row.damper.kind) << ','
         << std::lround(row.stiffness_n_per_m) << ',' << row.damper.damping_n_s_per_m << ','
         << haptics::verdict_name(row.found.verdict) << ',' << row.found.position_pp_mm << ','
         << row.found.force_pp_n << ',';
    if (row.settle_ms) text << std::lround(*row.settle_ms);
    text << ',' << row.most_added_n_s_per_m << ',' << row.watch_added_n_s_per_m << ','
         << row.most_given_mj << '\n';
  }
  return text.str();
}

std::string damped_period_csv(const std::vector<DampedPeriodRow>& rows) {
  std::ostringstream text;
  text
      << "# First stiffness of a grid at which a hold of 3 N at a linear wall is not quiet, and at "
         "which it is a limit cycle, by period and damper; N/m\n"
         "hand,damping,c_n_s_per_m,period_ms,first_not_quiet,verdict,first_limit_cycle\n";
  for (const DampedPeriodRow& row : rows) {
    text << haptics::hand_model(row.hand).name << ',' << damping_name(row.damper.kind) << ','
         << row.damper.damping_n_s_per_m << ',' << 1e3 * row.period_s << ','
         << stiffness_text(row.found.not_quiet) << ',' << haptics::verdict_name(row.found.verdict)
         << ',' << stiffness_text(row.found.cycle) << '\n';
  }
  return text.str();
}

}  // namespace argil::evaluation
