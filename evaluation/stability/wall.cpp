// SPDX-License-Identifier: GPL-3.0-or-later
// The K-B plane of a wall: where stiffness and rendered damping are felt as a wall.
#include "stability/wall.h"

#include <cmath>
#include <sstream>

#include "stability/grid.h"

namespace argil::evaluation {
namespace {

constexpr double kMostDamping = 400.0;

HoldCase wall_case(const WallRow& row) {
  HoldCase held;
  held.hand = row.hand;
  held.device = falcon(row.is_frictionless, 1);
  held.servo = haptics::bare_servo(kPeriodS);
  held.servo.velocity_lag_s = row.velocity_lag_s;
  return held;
}

void measure_wall_row(WallRow& row) {
  row.found = hold_wall(wall_case(row), row.stiffness_n_per_m, row.damping_n_s_per_m);
}

/// All walls of one hand and servo.
void add_wall_rows(haptics::Hand hand, double lag_s, bool is_frictionless, bool quick,
                   std::vector<WallRow>& rows) {
  std::vector<double> dampings = spread(1.0, kMostDamping, quick ? 5 : 19);
  dampings.insert(dampings.begin(), 0.0);
  for (const double damping : dampings) {
    for (const double stiffness : spread(100.0, 40000.0, quick ? 8 : 27)) {
      rows.push_back({hand, lag_s, is_frictionless, stiffness, damping, {}});
    }
  }
}

}  // namespace

Result<std::vector<WallRow>> measure_walls(bool quick, const Progress& progress, double from,
                                           double to) {
  std::vector<WallRow> rows;
  for (const haptics::Hand hand : {haptics::Hand::push, haptics::Hand::light}) {
    add_wall_rows(hand, 0.0, true, quick, rows);
    add_wall_rows(hand, 0.0, false, quick, rows);
    add_wall_rows(hand, haptics::VelocityFilter::kUsualLagS, false, quick, rows);
  }
  std::vector<std::function<void()>> work;
  work.reserve(rows.size());
  for (WallRow& row : rows) work.emplace_back([&row] { measure_wall_row(row); });
  if (auto done = run_all(work, progress, "damped walls", from, to); !done) return done.error();
  return rows;
}

std::string wall_csv(const std::vector<WallRow>& rows) {
  std::ostringstream text;
  text << "# A hold of 3 N at a wall of stiffness K and rendered damping B, 1 kHz, one tick of "
          "delay\n"
          "device,hand,velocity_lag_ms,k_n_per_m,b_n_s_per_m,verdict,position_pp_mm,force_pp_n\n";
  text.precision(4);
  for (const WallRow& row : rows) {
    text << (row.is_frictionless ? "frictionless" : "nominal") << ','
         << haptics::hand_model(row.hand).name << ',' << 1e3 * row.velocity_lag_s << ','
         << std::lround(row.stiffness_n_per_m) << ',' << row.damping_n_s_per_m << ','
         << haptics::verdict_name(row.found.verdict) << ',' << row.found.position_pp_mm << ','
         << row.found.force_pp_n << '\n';
  }
  return text.str();
}

std::vector<std::pair<double, double>> eigenvalue_border(haptics::Hand hand, bool is_frictionless) {
  haptics::LinearLoop loop = linear_loop(wall_case({hand, 0.0, is_frictionless, 0.0, 0.0, {}}));
  std::vector<double> dampings = spread(1.0, kMostDamping, 60);
  dampings.insert(dampings.begin(), 0.0);
  std::vector<std::pair<double, double>> border;
  for (const double damping : dampings) {
    loop.rendered_damping_n_s_per_m = damping;
    border.emplace_back(haptics::largest_stable_stiffness_n_per_m(loop), damping);
  }
  return border;
}

}  // namespace argil::evaluation
