// SPDX-License-Identifier: GPL-3.0-or-later
#include "stability/adaptive/plot_damping.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <set>
#include <string>

#include "common/output.h"
#include "stability/verdict_look.h"

namespace argil::evaluation {
namespace {

using haptics::DampingKind;

/// The axes of the map: logarithms, with a row of its own for c = 0 below the others.
struct DamperAxes {
  double half_x = 0.0;  ///< half the step from box to box
  double half_y = 0.0;
  double zero = 0.0;  ///< where c = 0 stands
  double top = 0.0;

  double up(double damping) const { return damping > 0.0 ? std::log2(damping) : zero; }
};

/// That of the bound lies between two steps.
bool is_of_map(const DampedWallRow& row) { return row.damper.damping_n_s_per_m != kBoundDamping; }

double half_a_step(const std::set<double>& values) {
  assert(values.size() > 1);
  return 0.5 * (*values.rbegin() - *values.begin()) / static_cast<double>(values.size() - 1);
}

DamperAxes axes_of(const std::vector<DampedWallRow>& rows) {
  std::set<double> across;
  std::set<double> up;
  for (const DampedWallRow& row : rows) {
    across.insert(std::log10(row.stiffness_n_per_m));
    if (is_of_map(row) && row.damper.damping_n_s_per_m > 0.0)
      up.insert(std::log2(row.damper.damping_n_s_per_m));
  }
  DamperAxes axes;
  axes.half_x = half_a_step(across);
  axes.half_y = half_a_step(up);
  axes.zero = *up.begin() - 2.4 * axes.half_y;  // a little apart
  axes.top = *up.rbegin();
  return axes;
}

std::string damper_panel(const std::vector<DampedWallRow>& rows, const DamperAxes& axes,
                         haptics::Hand hand, bool is_frictionless, DampingKind kind) {
  PlotLines lines;
  for (const VerdictLook& look : kVerdictLooks) {
    std::string boxes;
    for (const DampedWallRow& row : rows) {
      if (row.hand != hand || row.is_frictionless != is_frictionless || !is_of_map(row)) continue;
      if (row.damper.kind != kind || row.found.verdict != look.verdict) continue;
      const double k = std::log10(row.stiffness_n_per_m);
      const double c = axes.up(row.damper.damping_n_s_per_m);
      for (const double value :
           {k, c, k - axes.half_x, k + axes.half_x, c - axes.half_y, c + axes.half_y}) {
        boxes += cli::number(value) + " ";
      }
      boxes.back() = '\n';
    }
    lines.add(boxes, std::string("boxxyerror ") + look.style);
  }
  return lines.text();
}

/// Tics of c, with their numbers or without.
std::string damper_tics(const DamperAxes& axes, bool has_numbers) {
  std::string text = "set ytics (";
  for (const double c : {0.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    text += '\'';
    if (has_numbers) text += cli::number(c);
    text += "' " + cli::number(axes.up(c)) + (c < 50.0 ? "," : ")\n");
  }
  return text;
}

/// Colours that the colour-blind can tell apart.
struct DamperLook {
  DampingKind kind;
  double damping;  ///< c of the scene
  const char* title;
  const char* style;
};
constexpr std::array kDamperLooks{
    DamperLook{DampingKind::fixed, 0.0, "fixed, c = 0",
               "linespoints pt 7 ps 0.75 lw 1.8 lc rgb '#000000'"},
    DamperLook{DampingKind::fixed, 10.0, "fixed, c = 10 N s/m",
               "linespoints pt 5 ps 0.75 lw 1.8 lc rgb '#56b4e9'"},
    DamperLook{DampingKind::fixed, kBoundDamping, "fixed, c = 50 N s/m",
               "linespoints pt 9 ps 0.75 lw 1.8 lc rgb '#009e73'"},
    DamperLook{DampingKind::adaptive, 0.0, "adaptive from c = 0",
               "linespoints pt 13 ps 0.9 lw 1.8 lc rgb '#d55e00'"}};

/// As a look names it; a spread of dampers has sums of logarithms.
bool looks_as(const Damper& damper, const DamperLook& look) {
  return damper.kind == look.kind && std::abs(damper.damping_n_s_per_m - look.damping) < 1e-6;
}

std::string period_panel(const std::vector<DampedPeriodRow>& rows, haptics::Hand hand) {
  constexpr double kTopEdge = 60000.0;  // what never failed is drawn there
  PlotLines lines;
  for (const DamperLook& look : kDamperLooks) {
    std::string points;
    for (const DampedPeriodRow& row : rows) {
      if (row.hand != hand || !looks_as(row.damper, look)) continue;
      points += point_text(1e3 * row.period_s, row.found.cycle.value_or(kTopEdge));
    }
    lines.add(points, look.style);
  }
  return lines.text();
}

std::string settle_panel(const std::vector<DampedWallRow>& rows, haptics::Hand hand) {
  constexpr double kLeastMs = 50.0;  // of the logarithmic axis
  PlotLines lines;
  for (const DamperLook& look : kDamperLooks) {
    std::string points;
    for (const DampedWallRow& row : rows) {
      if (row.hand != hand || row.is_frictionless || !looks_as(row.damper, look)) continue;
      // A gap where it never comes to rest.
      points += row.settle_ms
                    ? point_text(row.stiffness_n_per_m, std::max(kLeastMs, *row.settle_ms))
                    : "\n";
    }
    lines.add(points, look.style);
  }
  return lines.text();
}

}  // namespace

Script damping_map_script(const std::vector<DampedWallRow>& rows) {
  const Sheet sheet{"stability_damping_map", 1280, 1180, "Fixed and adaptive damping of a wall",
                    "Hold of 3 N at a wall of stiffness K and damper c, 1 kHz, one tick of delay, "
                    "velocities in a mean of 3 ms, no coupling. The lowest row is c = 0."};
  const PanelGrid grid{4, 4, 0.065, 0.985, 0.885, 0.115, 0.02, 0.045};
  const DamperAxes axes = axes_of(rows);
  std::string text = "unset key\nunset grid\nset xrange [2.66:4.64]\nset yrange [" +
                     cli::number(axes.zero - 1.2 * axes.half_y) + ":" +
                     cli::number(axes.top + 1.2 * axes.half_y) + "]\n";
  for (std::size_t i = 0; i < 16; ++i) {
    const haptics::Hand hand = kHands[i % 4];
    const bool is_frictionless = i >= 8;
    const DampingKind kind = i / 4 % 2 == 0 ? DampingKind::fixed : DampingKind::adaptive;
    text += panel_head(grid, i,
                       std::string(haptics::hand_model(hand).name) + " hand, " +
                           (is_frictionless ? "no friction, " : "") + damping_name(kind));
    text += i % 4 == 0 ? "set ylabel 'c [N s/m]'\n" : "unset ylabel\n";
    text += damper_tics(axes, i % 4 == 0);
    text += i < 12 ? "unset xlabel\nset xtics ('' 2.699,'' 3.301,'' 4,'' 4.477)\n"
                   : "set xlabel 'K [N/m]'\n"
                     "set xtics ('500' 2.699,'2000' 3.301,'10000' 4,'30000' 4.477)\n";
    text += damper_panel(rows, axes, hand, is_frictionless, kind);
  }
  KeyStrip key(0.04, 3);
  for (const VerdictLook& look : kVerdictLooks) {
    key.add(std::string("boxes ") + look.style, look.title);
  }
  return finished(sheet, text + key.text());
}

Script damping_script(const std::vector<DampedWallRow>& walls,
                      const std::vector<DampedPeriodRow>& periods) {
  const Sheet sheet{"stability_damping", 1280, 820,
                    "Adaptive damping: the first stiffness that fails, and the time to settle",
                    "Hold of 3 N at a linear wall, one tick of delay, simulated Falcon with 0.15 N "
                    "of friction. Below: 1 kHz; a gap: it never comes to rest."};
  const PanelGrid grid{4, 2, 0.065, 0.985, 0.86, 0.155, 0.02, 0.13};
  std::string text = "unset key\nset logscale xy\n";
  for (std::size_t i = 0; i < 8; ++i) {
    const haptics::Hand hand = kHands[i % 4];
    const bool is_period = i < 4;
    text += panel_head(grid, i, std::string(haptics::hand_model(hand).name) + " hand");
    text += is_period
                ? "set xrange [0.2:25]\nset yrange [50:8e4]\nset xtics (0.25,0.5,1,2,5,10,20)\n"
                  "set xlabel 'period [ms]'\n"
                : "set xrange [450:45000]\nset yrange [50:4000]\n"
                  "set xtics (500,2000,10000,30000)\nset xlabel 'K [N/m]'\n";
    text += i % 4 != 0 ? "set format y ''\nunset ylabel\n"
                       : std::string("set format y '%g'\nset ylabel '") +
                             (is_period ? "first limit cycle [N/m]'\n" : "to settle [ms]'\n");
    text += is_period ? period_panel(periods, hand) : settle_panel(walls, hand);
  }
  KeyStrip key(0.06, 4);
  for (const DamperLook& look : kDamperLooks) key.add(look.style, look.title);
  return finished(sheet, text + key.text());
}

}  // namespace argil::evaluation
