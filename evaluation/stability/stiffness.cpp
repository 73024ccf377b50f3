// SPDX-License-Identifier: GPL-3.0-or-later
// How stiff a wall may be: every remedy, period, delay, hand and device.
#include "stability/stiffness.h"

#include <cassert>
#include <cmath>
#include <memory>
#include <sstream>

namespace argil::evaluation {
namespace {

constexpr double kGainPerMs = 0.1;
constexpr double kLagS = 9.5e-3;  // of that gain
constexpr double kViscosity = 10.0;

double added_damping(Remedy remedy) { return remedy == Remedy::viscosity ? kViscosity : 0.0; }

HoldCase stiffness_case(const StiffnessRow& row) {
  HoldCase held;
  held.hand = row.hand;
  held.device = falcon(row.is_frictionless, row.delay_ticks);
  held.servo = haptics::bare_servo(row.period_s);
  if (row.remedy == Remedy::position_filter) {
    held.servo.position_filter = haptics::PositionFilterOptions{kGainPerMs, 1.0};
  }
  held.servo.passivity.controls = row.remedy == Remedy::passivity;
  if (row.remedy == Remedy::indirect) {
    held.servo.coupling.kind = haptics::CouplingKind::indirect;
  }
  if (row.remedy == Remedy::usual) {
    held.servo = {};
    held.servo.period_s = row.period_s;
  }
  return held;
}

haptics::Verdict judge_wall(const StiffnessRow& row, const HoldCase& held, double n_per_m) {
  if (row.remedy != Remedy::force_filter) {
    return hold_wall(held, n_per_m, added_damping(row.remedy)).verdict;
  }
  haptics::WallScene wall = linear_wall(n_per_m, 0.0);
  LateScene late(wall, kGainPerMs, row.period_s);
  return hold(late, held, wall_rest_mm(held, n_per_m)).verdict;
}

void measure_stiffness_row(StiffnessRow& row, const StiffnessGrid& grid, int stride) {
  const HoldCase held = stiffness_case(row);
  haptics::LinearLoop loop = linear_loop(held);
  loop.rendered_damping_n_s_per_m = added_damping(row.remedy);
  row.eigenvalue_n_per_m = haptics::largest_stable_stiffness_n_per_m(loop);
  row.formula_n_per_m = formula_n_per_m(held, loop.rendered_damping_n_s_per_m);
  assert(row.formula_n_per_m > 0.0);
  double guess = row.formula_n_per_m;
  if (row.remedy == Remedy::force_filter || row.remedy == Remedy::position_filter) {
    // The formula is k = b / (T/2 + delay): the lag of the filter adds to the delay.
    guess = loop.damping_n_s_per_m / (loop.damping_n_s_per_m / row.formula_n_per_m + kLagS);
  }
  row.found = first_failures(grid, guess, stride,
                             [&](double n_per_m) { return judge_wall(row, held, n_per_m); });
}

/// The quick chart has one delay, and no friction only where nothing helps, except of the default.
void add_stiffness_rows(Remedy remedy, bool is_frictionless, haptics::Hand hand, bool quick,
                        std::vector<StiffnessRow>& rows) {
  std::vector<double> periods_ms{0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0};
  std::vector<int> delays{0, 1, 2};
  if (quick) periods_ms = {0.5, 1.0, 2.0, 5.0, 20.0};
  if (quick && remedy != Remedy::usual) delays = {1};
  for (const int delay_ticks : delays) {
    for (const double period_ms : periods_ms) {
      StiffnessRow& row = rows.emplace_back();
      row.remedy = remedy;
      row.hand = hand;
      row.is_frictionless = is_frictionless;
      row.period_s = 1e-3 * period_ms;
      row.delay_ticks = delay_ticks;
    }
  }
}

std::vector<StiffnessRow> all_stiffness_rows(bool quick) {
  using enum Remedy;
  std::vector<StiffnessRow> rows;
  for (const Remedy remedy :
       {direct, force_filter, position_filter, viscosity, passivity, indirect, usual}) {
    for (const bool is_frictionless : {false, true}) {
      if (quick && is_frictionless && remedy != direct && remedy != usual) continue;
      for (const haptics::Hand hand : kHands) {
        add_stiffness_rows(remedy, is_frictionless, hand, quick, rows);
      }
    }
  }
  return rows;
}

}  // namespace

const char* remedy_name(Remedy remedy) {
  switch (remedy) {
    case Remedy::direct:
      return "direct";
    case Remedy::force_filter:
      return "force_filter";
    case Remedy::position_filter:
      return "position_filter";
    case Remedy::viscosity:
      return "viscosity";
    case Remedy::passivity:
      return "passivity";
    case Remedy::indirect:
      return "indirect_1500";
    case Remedy::usual:
      break;
  }
  return "default";
}

Result<std::vector<StiffnessRow>> measure_stiffness(bool quick, const Progress& progress,
                                                    double from, double to) {
  std::vector<StiffnessRow> rows = all_stiffness_rows(quick);
  const StiffnessGrid grid(quick ? 1.2 : 1.1);
  std::vector<std::function<void()>> work;
  for (StiffnessRow& row : rows) {
    // The default is expected to be quiet throughout: larger strides, all of them taken.
    const int stride = row.remedy == Remedy::usual ? 8 : 4;
    work.emplace_back([&row, &grid, stride] { measure_stiffness_row(row, grid, stride); });
  }
  if (auto done = run_all(work, progress, "pressing into walls", from, to); !done) {
    return done.error();
  }
  return rows;
}

std::string stiffness_csv(const std::vector<StiffnessRow>& rows) {
  std::ostringstream text;
  text
      << "# First stiffness of a grid at which a hold of 3 N at a linear wall is not quiet, and at "
         "which it is a limit cycle; N/m\n"
         "method,device,hand,delay_ticks,period_ms,first_not_quiet,verdict,first_limit_cycle,"
         "eigenvalue,formula\n";
  for (const StiffnessRow& row : rows) {
    text << remedy_name(row.remedy) << ',' << (row.is_frictionless ? "frictionless" : "nominal")
         << ',' << haptics::hand_model(row.hand).name << ',' << row.delay_ticks << ','
         << 1e3 * row.period_s << ',' << stiffness_text(row.found.not_quiet) << ','
         << haptics::verdict_name(row.found.verdict) << ',' << stiffness_text(row.found.cycle)
         << ',' << std::lround(row.eigenvalue_n_per_m) << ',' << std::round(row.formula_n_per_m)
         << '\n';
  }
  return text.str();
}

}  // namespace argil::evaluation
