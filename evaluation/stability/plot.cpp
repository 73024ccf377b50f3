// SPDX-License-Identifier: GPL-3.0-or-later
// How stiff a wall may be.
#include "stability/plot.h"

#include <array>

#include "chart/sheet.h"
#include "common/output.h"

namespace argil::evaluation {
namespace {

/// In N/m, the stiffest of the grid: what never failed is drawn there.
constexpr double kTopEdge = 60000.0;

/// Colours that the colour-blind can tell apart.
struct RemedyLook {
  Remedy remedy;
  const char* title;
  const char* color;
  int mark;
};
constexpr std::array kRemedyLooks{
    RemedyLook{Remedy::direct, "direct", "#000000", 7},
    RemedyLook{Remedy::force_filter, "force filter, 0.1 per ms", "#e69f00", 9},
    RemedyLook{Remedy::position_filter, "position filter, τ 0.1, λ 1 mm", "#cc79a7", 11},
    RemedyLook{Remedy::viscosity, "viscosity 10 N s/m", "#56b4e9", 5},
    RemedyLook{Remedy::passivity, "passivity controller", "#009e73", 13},
    RemedyLook{Remedy::indirect, "coupling 1500 N/m, not governed", "#0072b2", 4},
    RemedyLook{Remedy::usual, "default: coupling, governed", "#d55e00", 3}};

using FailureValue = std::optional<double> FirstFailures::*;

std::string failure_curve(const std::vector<StiffnessRow>& rows, Remedy remedy, haptics::Hand hand,
                          bool is_frictionless, FailureValue value) {
  std::string text;
  for (const StiffnessRow& row : rows) {
    if (row.remedy != remedy || row.hand != hand || row.is_frictionless != is_frictionless) {
      continue;
    }
    if (row.delay_ticks != 1) continue;
    text += point_text(1e3 * row.period_s, (row.found.*value).value_or(kTopEdge));
  }
  return text;
}

std::string theory(const std::vector<StiffnessRow>& rows, haptics::Hand hand,
                   double StiffnessRow::*value) {
  std::string text;
  for (const StiffnessRow& row : rows) {
    if (row.remedy != Remedy::direct || row.hand != hand || !row.is_frictionless) continue;
    if (row.delay_ticks == 1) text += point_text(1e3 * row.period_s, row.*value);
  }
  return text;
}

std::string remedy_style(const RemedyLook& look) {
  return "linespoints pt " + std::to_string(look.mark) + " ps 0.75 lw 1.8 lc rgb '" + look.color +
         "'";
}
constexpr const char* kFrictionless = "points pt 6 ps 1.2 lw 1.5 lc rgb '#000000'";
constexpr const char* kEigenvalue = "lines lw 1.5 dt 2 lc rgb '#606060'";
constexpr const char* kFormula = "lines lw 1.5 dt 3 lc rgb '#b00000'";

std::string stiffness_panel(const std::vector<StiffnessRow>& rows, haptics::Hand hand,
                            FailureValue value) {
  PlotLines lines;
  for (const RemedyLook& look : kRemedyLooks) {
    lines.add(failure_curve(rows, look.remedy, hand, false, value), remedy_style(look));
  }
  lines.add(failure_curve(rows, Remedy::direct, hand, true, value), kFrictionless);
  lines.add(theory(rows, hand, &StiffnessRow::eigenvalue_n_per_m), kEigenvalue);
  lines.add(theory(rows, hand, &StiffnessRow::formula_n_per_m), kFormula);
  return lines.text();
}

std::string stiffness_key() {
  KeyStrip key(0.125, 4);
  for (const RemedyLook& look : kRemedyLooks) key.add(remedy_style(look), look.title);
  key.add(kFrictionless, "direct, no friction");
  key.add(kEigenvalue, "eigenvalue, no friction");
  key.add(kFormula, "(b + b_hand)/(T/2 + delay)");
  return key.text();
}

}  // namespace

Script stiffness_script(const std::vector<StiffnessRow>& rows) {
  const Sheet sheet{"stability_stiffness", 1280, 860,
                    "How stiff a wall may be: period of the servo, hand and remedy",
                    "Hold of 3 N at a linear wall, one tick of delay, simulated Falcon with 0.15 N "
                    "of friction. At the top edge: no failure up to 60000 N/m."};
  PanelGrid grid{4, 2, 0.065, 0.985, 0.865, 0.205, 0.02, 0.085};
  std::string text =
      "unset key\nset logscale xy\nset xrange [0.2:25]\nset yrange [50:8e4]\n"
      "set xtics (0.25,0.5,1,2,5,10,20)\n";
  for (std::size_t i = 0; i < 8; ++i) {
    const haptics::Hand hand = kHands[i % 4];
    const bool is_cycle = i < 4;
    text += panel_head(grid, i, std::string(haptics::hand_model(hand).name) + " hand");
    text += i % 4 == 0 ? std::string("set format y '%g'\nset ylabel 'first ") +
                             (is_cycle ? "limit cycle" : "that is not quiet") + " [N/m]'\n"
                       : "set format y ''\nunset ylabel\n";
    text += is_cycle ? "unset xlabel\n" : "set xlabel 'period [ms]'\n";
    text +=
        stiffness_panel(rows, hand, is_cycle ? &FirstFailures::cycle : &FirstFailures::not_quiet);
  }
  return finished(sheet, text + stiffness_key());
}

}  // namespace argil::evaluation
