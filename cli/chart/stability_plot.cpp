// SPDX-License-Identifier: GPL-3.0-or-later
// What the pictures of stability are put together from, and that of the stiffness.
#include "chart/stability_plot.h"

#include <array>

#include "output.h"

namespace argil::cli::chart {
namespace {

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

std::string sheet_head(const Sheet& sheet) {
  const std::string name = sheet.name;
  return "# Made by 'argil chart " + name.substr(0, name.find('_')) +
         "'; run gnuplot on it in its folder.\n"
         "set encoding utf8\nset terminal svg noenhanced size " +
         std::to_string(sheet.width) + "," + std::to_string(sheet.height) +
         " font 'DejaVu Sans,12' background rgb 'white'\nset output '" + sheet.name +
         ".svg'\nset grid lc rgb '#e4e4e4' lw 1\nset border 3 lc rgb '#808080'\n"
         "set tics nomirror textcolor rgb '#404040'\nset format x '%g'\nset format y '%g'\n"
         "set multiplot\nset label 1 '" +
         sheet.title + "' at screen 0.03,0.965 font ',16'\nset label 2 '" + sheet.subtitle +
         "' at screen 0.03,0.925 font ',11' textcolor rgb '#606060'\n";
}

Script finished(const Sheet& sheet, const std::string& text) {
  const std::string name = sheet.name;
  return {name + ".gp", name + ".svg", sheet_head(sheet) + text + "unset multiplot\n"};
}

std::string panel_head(const PanelGrid& grid, std::size_t i, const std::string& title) {
  const auto share = [](std::size_t n) { return static_cast<double>(n); };
  const double width =
      (grid.right - grid.left - grid.gap_x * share(grid.columns - 1)) / share(grid.columns);
  const double height =
      (grid.top - grid.bottom - grid.gap_y * share(grid.rows - 1)) / share(grid.rows);
  const double left = grid.left + share(i % grid.columns) * (width + grid.gap_x);
  const double top = grid.top - share(i / grid.columns) * (height + grid.gap_y);
  std::string text = i == 1 ? "unset label 1\nunset label 2\n" : "";
  text += "set lmargin at screen " + number(left) + "\nset rmargin at screen " +
          number(left + width) + "\nset tmargin at screen " + number(top) +
          "\nset bmargin at screen " + number(top - height) + "\n";
  return text + "set title '" + title + "' font ',13' offset 0,-0.5\n";
}

void PlotLines::add(const std::string& points, const std::string& style, const std::string& title) {
  if (points.empty()) return;
  const std::string name = "$d" + std::to_string(count_++);
  blocks_.append(name).append(" << EOD\n").append(points).append("EOD\n");
  plots_ += (count_ == 1 ? "plot " : ", ") + name + " with " + style +
            (title.empty() ? " notitle" : " title '" + title + "'");
}

void KeyStrip::add(const std::string& style, const std::string& title) {
  plots_ += (plots_.empty() ? "plot [0:1][0:1] NaN with " : ", NaN with ") + style + " title '" +
            title + "'";
}

std::string KeyStrip::text() const {
  return "unset label 1\nunset label 2\nunset logscale\nunset border\nunset tics\nunset xlabel\n"
         "unset ylabel\nunset title\nset lmargin at screen 0.03\nset rmargin at screen 0.98\n"
         "set tmargin at screen " +
         number(top_) + "\nset bmargin at screen 0\nset key center top horizontal maxcols " +
         std::to_string(columns_) + " Left reverse samplen 2 width 2 spacing 1.3 font ',11.5'\n" +
         plots_ + "\n";
}

std::string point_text(double x, double y) { return number(x) + " " + number(y) + "\n"; }

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

}  // namespace argil::cli::chart
