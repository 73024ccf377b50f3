// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures of clay that is felt late.
#include "stability/late/plot_late.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "common/output.h"

namespace argil::evaluation {
namespace {

struct LateVerdictLook {
  haptics::Verdict verdict;
  const char* style;
  const char* title;
};
constexpr std::array kLateVerdictLooks{
    LateVerdictLook{haptics::Verdict::quiet, "fs solid noborder lc rgb '#9ad0ae'", "quiet"},
    LateVerdictLook{haptics::Verdict::buzz, "fs solid noborder lc rgb '#f6c667'", "buzz"},
    LateVerdictLook{haptics::Verdict::gives, "fs solid noborder lc rgb '#b79bd6'",
                    "gives energy, no swing"},
    LateVerdictLook{haptics::Verdict::limit_cycle, "fs solid noborder lc rgb '#d9694a'",
                    "limit cycle"}};
constexpr const char* kEquationLine = "lines lw 2.4 lc rgb '#000000'";
constexpr const char* kNeverLine = "lines lw 1.6 dt 2 lc rgb '#0072b2'";

using LatePicks = std::function<bool(const LateRow&)>;

/// A box for each spring: half a step of the axes to every side.
std::string spring_boxes(const std::vector<LateRow>& rows, const LatePicks& picks,
                         haptics::Verdict verdict, double half_age, double half_log) {
  std::string text;
  for (const LateRow& row : rows) {
    if (!picks(row) || row.found.verdict != verdict) continue;
    const double age = 1e3 * row.what.late.age_s;
    const double k = std::log10(row.stiffness_n_per_m);
    text += cli::number(age) + " " + cli::number(k) + " " + cli::number(age - half_age) + " " +
            cli::number(age + half_age) + " " + cli::number(k - half_log) + " " +
            cli::number(k + half_log) + "\n";
  }
  return text;
}

/// The equation's age for the hand and period of the rows, over K; what is beyond the axis is left
/// out.
std::string equation_line(haptics::Hand hand, double period_s) {
  std::string text;
  for (const double k : grown_by(1.02, 150.0, 2400.0)) {
    LateTool spring{"spring", 0.0, 0.0, 0.0};
    spring.spring_n_per_m = k;
    const LateCase what{LateAction::carve,   spring,         hand, true,
                        LateRemedy::at_once, {0.0, period_s}};
    const auto found = haptics::first_chatter(carving_loop(what, HeightLaw(spring)));
    if (!found) continue;
    const double age_ms = 1e3 * (found->lateness_s - lateness_s(what, kPlaneDabS));
    if (age_ms < -5.0 || age_ms > 105.0) continue;
    text += point_text(age_ms, std::log10(k));
  }
  return text;
}

/// Below it no loop of that mass chatters: K = m pi^2 / (2 tau^2).
std::string never_line(haptics::Hand hand, double period_s) {
  std::string text;
  double age_s = 0.0;
  while (age_s <= 0.1) {
    LateTool spring{"spring", 0.0, 0.0, 0.0};
    spring.spring_n_per_m = 1.0;
    const LateCase what{LateAction::carve,   spring,           hand, true,
                        LateRemedy::at_once, {age_s, period_s}};
    const double tau_s = lateness_s(what, kPlaneDabS);
    const double mass_kg = falcon(true, 1).mass_kg + haptics::hand_model(hand).mass_kg;
    constexpr double kPi = 3.14159265358979323846;
    const double k = 0.5 * mass_kg * (kPi / tau_s) * (kPi / tau_s);
    if (k >= 130.0 && k <= 2800.0) text += point_text(1e3 * age_s, std::log10(k));
    age_s += 1e-3;
  }
  return text;
}

std::string map_panel(const std::vector<LateRow>& rows, haptics::Hand hand, double period_s,
                      const std::array<double, 2>& half) {
  const auto picks = [&](const LateRow& row) {
    return row.what.hand == hand && std::abs(row.what.late.period_s - period_s) < 1e-6;
  };
  PlotLines lines;
  for (const LateVerdictLook& look : kLateVerdictLooks) {
    lines.add(spring_boxes(rows, picks, look.verdict, half[0], half[1]),
              std::string("boxxyerror ") + look.style);
  }
  lines.add(equation_line(hand, period_s), kEquationLine);
  lines.add(never_line(hand, period_s), kNeverLine);
  return lines.text();
}

std::vector<double> periods_of(const std::vector<LateRow>& rows) {
  std::vector<double> periods;
  periods.reserve(rows.size());
  for (const LateRow& row : rows) periods.push_back(row.what.late.period_s);
  std::sort(periods.begin(), periods.end());
  periods.erase(std::unique(periods.begin(), periods.end()), periods.end());
  return periods;
}

}  // namespace

Script late_map_script(const LateResult& result) {
  const std::vector<double> periods = periods_of(result.springs);
  const bool is_quick = periods.size() < 3;
  const Sheet sheet{"stability_late_map", 1280, is_quick ? 860 : 1120,
                    "Carving a spring of stiffness K that is felt late",
                    "Verdict of a stroke at 20 mm/s without coupling and friction, new windows "
                    "felt at once; age A of a window when it is first felt, P between windows."};
  PanelGrid grid{4, periods.size(), 0.065, 0.985, 0.865, 0.155, 0.02, 0.085};
  const std::vector<double> ages = late_ages_s(is_quick);
  const std::vector<double> ks = late_spring_stiffnesses(is_quick);
  const std::array half{
      0.5e3 * (ages.back() - ages.front()) / static_cast<double>(ages.size() - 1),
      0.5 * std::log10(ks.back() / ks.front()) / static_cast<double>(ks.size() - 1)};
  std::string text =
      "unset key\nunset grid\nset xrange [-5:105]\nset yrange [2.09:3.47]\n"
      "set xtics 0,20,100\n";
  for (std::size_t i = 0; i < 4 * periods.size(); ++i) {
    const haptics::Hand hand = kHands[i % 4];
    const double period_s = periods[i / 4];
    text += panel_head(grid, i,
                       std::string(haptics::hand_model(hand).name) +
                           " hand, P = " + cli::number(std::round(1e3 * period_s)) + " ms");
    text += i % 4 == 0 ? "set ylabel 'K [N/m]'\nset ytics ('150' 2.176,'300' 2.477,'600' 2.778,"
                         "'1200' 3.079,'2400' 3.380)\n"
                       : "unset ylabel\nset ytics ('' 2.176,'' 2.477,'' 2.778,'' 3.079,'' 3.380)\n";
    text += i + 4 >= 4 * periods.size() ? "set xlabel 'age A [ms]'\n" : "unset xlabel\n";
    text += map_panel(result.springs, hand, period_s, half);
  }
  KeyStrip key(0.09, 4);
  for (const LateVerdictLook& look : kLateVerdictLooks) {
    if (look.verdict != haptics::Verdict::gives) {
      key.add(std::string("boxes ") + look.style, look.title);
    }
  }
  key.add(kEquationLine, "first by the equation");
  key.add(kNeverLine, "never below: m π² / 2τ²");
  return finished(sheet, text + key.text());
}

namespace {

/// A series of the panels: a remedy with or without a coupling.
struct LateSeries {
  LateRemedy remedy;
  bool is_direct;
  const char* color;
  int mark;
  const char* title;
};
constexpr std::array kLateSeries{
    LateSeries{LateRemedy::account, true, "#808080", 8, "blended, no coupling"},
    LateSeries{LateRemedy::at_once, false, "#000000", 6, "at once"},
    LateSeries{LateRemedy::blended, false, "#e69f00", 4, "blended over 5 ms"},
    LateSeries{LateRemedy::account, false, "#0072b2", 10, "blended, account"},
    LateSeries{LateRemedy::governed, false, "#cc79a7", 12, "and a softer coupling"},
    LateSeries{LateRemedy::stamped, false, "#009e73", 14, "or own cuts stamped"},
    LateSeries{LateRemedy::reaching, false, "#009e73", 14, "and windows that reach as far"}};

std::string series_style(const LateSeries& series, bool is_clay) {
  const std::string mark = " pt " + std::to_string(is_clay ? series.mark + 1 : series.mark);
  return (is_clay ? "points" + mark + " ps 1.1"
                  : "lines dt " + std::string(series.is_direct ? "2" : "1")) +
         " lw 1.8 lc rgb '" + series.color + "'";
}

/// One panel: a number of an action, the worst of the four hands, over the age.
struct LatePanel {
  LateAction action;
  const char* title;
  const char* ylabel;
  double LateFound::*value;
  double least;  ///< of the axis, where less is drawn
  double most;
  double aim;  ///< a line; 0: none
};
constexpr std::array kLatePanels{
    LatePanel{LateAction::carve, "Carving: swing of the handle", "swing [mm]", &LateFound::swing_mm,
              1e-3, 10.0, haptics::kLimitCycleMm},
    LatePanel{LateAction::carve, "Carving: what is felt", "mean force [N]", &LateFound::mean_n,
              0.05, 10.0, 0.0},
    LatePanel{LateAction::carve, "Carving: step at an exchange", "step in one tick [N]",
              &LateFound::step_p99_n, 1e-3, 10.0, 0.05},
    LatePanel{LateAction::add, "Adding around a tool that rests", "energy given [mJ]",
              &LateFound::given_mj, 0.01, 1000.0, 2.0},
    LatePanel{LateAction::smooth, "Smoothing in a hollow", "energy given [mJ]",
              &LateFound::given_mj, 0.01, 1000.0, 2.0},
    LatePanel{LateAction::slide, "Sliding at 50 mm/s for 2 s", "without a window [ms]",
              &LateFound::outside_ms, 1.0, 2000.0, 0.0}};

/// Windows come as often as they are old, every 5 to 50 ms.
bool is_drawn(const Lateness& late) {
  return std::abs(late.period_s - std::clamp(late.age_s, 0.005, 0.05)) < 1e-6;
}

std::string worst_of_hands(const std::vector<LateRow>& rows, const LatePanel& panel,
                           const LateSeries& series, LateWay way) {
  std::vector<std::pair<double, double>> points;
  for (const LateRow& row : rows) {
    const LateCase& what = row.what;
    if (row.way != way || what.action != panel.action || what.remedy != series.remedy) continue;
    if (what.is_direct != series.is_direct || !is_drawn(what.late)) continue;
    if (std::string(what.tool.name) != kFineTool.name) continue;
    const double value = std::clamp(row.found.*panel.value, panel.least, panel.most);
    if (points.empty() || points.back().first != what.late.age_s) {
      points.emplace_back(what.late.age_s, value);
    } else {
      points.back().second = std::max(points.back().second, value);
    }
  }
  std::string text;
  // 0 would have no place on the axis.
  for (const auto& [age_s, value] : points) {
    text += point_text(std::max(2.5, 1e3 * age_s), value);
  }
  return text;
}

std::string late_panel(const std::vector<LateRow>& rows, const LatePanel& panel) {
  PlotLines lines;
  if (panel.aim > 0.0) {
    lines.add(point_text(2.2, panel.aim) + point_text(115.0, panel.aim), kAskedStyle);
  }
  for (const LateWay way : {LateWay::simulation, LateWay::clay}) {
    for (const LateSeries& series : kLateSeries) {
      lines.add(worst_of_hands(rows, panel, series, way),
                series_style(series, way == LateWay::clay));
    }
  }
  return lines.text();
}

}  // namespace

Script late_script(const LateResult& result) {
  const Sheet sheet{
      "stability_late", 1280, 900, "Clay that is felt late, and what helps",
      "A ball of 1 mm, skin 1 mm, e 4: lines by simulation of clay as a height, full marks "
      "on real clay; the worst of four hands. P = A, but at least 5 and at most 50 ms."};
  const PanelGrid grid{3, 2, 0.065, 0.985, 0.86, 0.19, 0.06, 0.115};
  std::string text =
      "unset key\nset logscale xy\nset xrange [2.2:115]\n"
      "set xtics ('0' 2.5,'5' 5,'10' 10,'20' 20,'50' 50,'100' 100)\n";
  for (std::size_t i = 0; i < kLatePanels.size(); ++i) {
    const LatePanel& panel = kLatePanels[i];
    text += panel_head(grid, i, panel.title);
    text += std::string("set ylabel '") + panel.ylabel + "'\n";
    text += i < 3 ? "unset xlabel\n" : "set xlabel 'age A [ms]'\n";
    text += "set yrange [" + cli::number(0.8 * panel.least) + ":" + cli::number(panel.most) + "]\n";
    text += late_panel(result.rows, panel);
  }
  KeyStrip key(0.11, 4);
  for (const LateSeries& series : kLateSeries) key.add(series_style(series, false), series.title);
  key.add(kAskedStyle, "limit cycle; aim");
  return finished(sheet, text + key.text());
}

}  // namespace argil::evaluation
