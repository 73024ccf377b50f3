// SPDX-License-Identifier: GPL-3.0-or-later
// The filtered position of eq. 6 to 8 of INRIA report 5090: what it does to the stiffness that a
// hold stands.
#include "stability/filter.h"

#include <cassert>
#include <cmath>
#include <sstream>

#include "stability/clay.h"

namespace argil::evaluation {
namespace {

constexpr double kExponent = 4.0;

HoldCase filter_case(const FilterRow& row) {
  HoldCase held;
  held.hand = row.hand;
  held.device = falcon(false, 1);
  held.servo = haptics::bare_servo(1e-3);
  if (row.gain < 1.0 && row.lambda_mm > 0.0) {
    held.servo.position_filter = haptics::PositionFilterOptions{row.gain, row.lambda_mm};
  }
  return held;
}

void measure_filter_row(FilterRow& row, const StiffnessGrid& grid) {
  assert(row.gain > 0.0 && row.gain <= 1.0 && row.lambda_mm >= 0.0);
  const HoldCase held = filter_case(row);
  // Only where the search begins: lower with a filter, which is late.
  const double guess = formula_n_per_m(held, 0.0) * (row.gain < 1.0 ? 0.4 : 1.0);
  row.found = first_failures(grid, guess, 4, [&](double n_per_m) {
    ClayPlane plane(0.0, material_of(kExponent, n_per_m));
    if (row.lambda_mm > 0.0) return hold(plane, held, 0.0).verdict;
    LateScene late(plane, row.gain, held.servo.period_s);
    return hold(late, held, 0.0).verdict;
  });
}

/// The stiffness of a failure, or the stiffest wall where there was none.
double most_n_per_m(const FilterRow& row, const StiffnessGrid& grid) {
  return row.found.cycle.value_or(grid.at(grid.count() - 1));
}

}  // namespace

Result<std::vector<FilterRow>> measure_filters(bool quick, const Progress& progress, double from,
                                               double to) {
  const std::vector<double> gains =
      quick ? std::vector<double>{0.01, 0.1, 1.0}
            : std::vector<double>{0.01, 0.018, 0.03, 0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0};
  const std::vector<double> lambdas = quick
                                          ? std::vector<double>{0.0, 0.2, 1.0}
                                          : std::vector<double>{0.0, 0.05, 0.1, 0.2, 0.5, 1, 2, 5};
  std::vector<FilterRow> rows;
  for (const haptics::Hand hand : kHands) {
    for (const double gain : gains) {
      for (const double lambda : lambdas) rows.push_back({hand, gain, lambda, {}, 1.0});
    }
  }
  const StiffnessGrid grid(quick ? 1.2 : 1.1);
  std::vector<std::function<void()>> work;
  work.reserve(rows.size());
  for (FilterRow& row : rows) work.emplace_back([&row, &grid] { measure_filter_row(row, grid); });
  if (auto done = run_all(work, progress, "position filters", from, to); !done) {
    return done.error();
  }
  for (FilterRow& row : rows) {
    for (const FilterRow& direct : rows) {
      if (direct.hand != row.hand || direct.gain < 1.0) continue;
      row.ratio = most_n_per_m(row, grid) / most_n_per_m(direct, grid);
    }
  }
  return rows;
}

std::string filter_csv(const std::vector<FilterRow>& rows) {
  std::ostringstream text;
  text << "# First stiffness (slope at the surface, N/m) of the contact law of exponent 4 at which "
          "a hold of 3 N is a limit cycle, 1 kHz, one tick of delay, nominal device; lambda 0: the "
          "force is filtered\n"
          "hand,tau,lambda_mm,first_not_quiet,verdict,first_limit_cycle,ratio_to_direct\n";
  text.precision(4);
  for (const FilterRow& row : rows) {
    text << haptics::hand_model(row.hand).name << ',' << row.gain << ',' << row.lambda_mm << ','
         << stiffness_text(row.found.not_quiet) << ',' << haptics::verdict_name(row.found.verdict)
         << ',' << stiffness_text(row.found.cycle) << ',' << row.ratio << '\n';
  }
  return text.str();
}

}  // namespace argil::evaluation
