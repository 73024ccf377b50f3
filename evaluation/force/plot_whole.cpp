// SPDX-License-Identifier: GPL-3.0-or-later
#include "force/plot_whole.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "common/output.h"
#include "force/station.h"

namespace argil::evaluation {
namespace {

/// A line of the chart: a method and what it is called, from the lowest.
struct WholeLine {
  const char* method;
  const char* title;
};

constexpr std::array kLines{WholeLine{"fine", "fine"},
                            WholeLine{"stencil_288", "stencil, 288"},
                            WholeLine{"blanch_32", "blanch, N = 32"},
                            WholeLine{"blanch_8", "blanch, N = 8"},
                            WholeLine{"energy_32", "energy, N = 32"},
                            WholeLine{"energy_16", "energy, N = 16"},
                            WholeLine{"energy_8", "energy, N = 8"},
                            WholeLine{"lod_blanch", "lod, blanch"},
                            WholeLine{"lod", "lod"},
                            WholeLine{"servo", "servo (default)"},
                            WholeLine{"point", "point"}};

/// One of the four times of a method, the sum alone first.
struct Step {
  const char* title;
  const char* style;
  std::vector<double> cli::WindowTimes::*windows;  ///< null: none
};

constexpr std::array kSteps{Step{"the force alone, on a window that is there",
                                 "points pt 7 ps 0.9 lc rgb '#000000'", nullptr},
                            Step{"with a window after a move of 4 nodes",
                                 "points pt 5 ps 0.9 lc rgb '#009e73'", &cli::WindowTimes::moved},
                            Step{"after a dab of the tool", "points pt 9 ps 1.1 lc rgb '#0072b2'",
                                 &cli::WindowTimes::after_dab},
                            Step{"of nothing that was kept", "points pt 13 ps 1.2 lc rgb '#d55e00'",
                                 &cli::WindowTimes::fresh}};

double time_us(const Tally& tally, const Step& step) {
  const double sum_us = quantile(tally.cpu_us, 0.5);
  return step.windows == nullptr ? sum_us
                                 : sum_us + 1e3 * quantile(tally.windows.*step.windows, 0.5);
}

const ForceRow* row_of(const std::vector<ForceRow>& rows, const char* method, int radius) {
  const auto row = std::ranges::find_if(rows, [&](const ForceRow& each) {
    return each.method == method && each.radius_voxels == radius && each.tool == "ball";
  });
  return row == rows.end() ? nullptr : &*row;
}

/// "x y" of one step of all methods.
std::string step_points(const std::vector<ForceRow>& rows, int radius, const Step& step) {
  std::string points;
  for (std::size_t line = 0; line < kLines.size(); ++line) {
    const ForceRow* row = row_of(rows, kLines[line].method, radius);
    if (row == nullptr) continue;
    const double x = time_us(row->tally, step);
    if (std::isfinite(x)) points += point_text(x, static_cast<double>(line));
  }
  return points;
}

/// From each method's force alone to its fresh window; gnuplot parts lines at an empty one.
std::string spans(const std::vector<ForceRow>& rows, int radius) {
  std::string lines;
  for (std::size_t line = 0; line < kLines.size(); ++line) {
    const ForceRow* row = row_of(rows, kLines[line].method, radius);
    if (row == nullptr || row->tally.windows.fresh.empty()) continue;
    const auto y = static_cast<double>(line);
    lines += point_text(time_us(row->tally, kSteps.front()), y) +
             point_text(time_us(row->tally, kSteps.back()), y) + "\n";
  }
  return lines;
}

/// The errors, in a column at the right.
std::string error_labels(const std::vector<ForceRow>& rows, int radius) {
  std::string text = "set label 20 'error p95' at graph 0.985, graph 1.025 right font ',10'\n";
  for (std::size_t line = 0; line < kLines.size(); ++line) {
    const ForceRow* row = row_of(rows, kLines[line].method, radius);
    const bool is_known = row != nullptr && !row->tally.error.empty();
    const std::string error =
        is_known ? cli::number(std::round(1e4 * quantile(row->tally.error, 0.95)) / 100.0) + " %"
                 : "";
    text += "set label " + std::to_string(21 + line) + " '" + error + "' at graph 0.985, first " +
            std::to_string(line) + " right font ',10' textcolor rgb '#404040'\n";
  }
  return text;
}

std::string line_tics(bool with_names) {
  std::string text = "set ytics (";
  for (std::size_t line = 0; line < kLines.size(); ++line) {
    text += std::string(line == 0 ? "'" : ", '") + (with_names ? kLines[line].title : "") + "' " +
            std::to_string(line);
  }
  return text + ")\n";
}

std::string panel_of(const std::vector<ForceRow>& rows, int radius) {
  PlotLines plot;
  plot.add(spans(rows, radius), "lines lw 2 lc rgb '#c8c8c8'");
  for (const Step& step : kSteps) plot.add(step_points(rows, radius, step), step.style);
  return error_labels(rows, radius) + plot.text();
}

}  // namespace

Script whole_script(const std::vector<ForceRow>& rows, const std::string& title) {
  const Sheet sheet{"force_whole", 1280, 520, title,
                    "Balls, all scenes, medians of thread CPU time; windows with a margin of one "
                    "radius (none: no slot holds it). Dashed: a tick of 1 kHz; dotted: the 5 ms "
                    "from window to window."};
  const PanelGrid grid{kWindowRadii.size(), 1, 0.115, 0.985, 0.82, 0.2, 0.02, 0.1};
  std::string text =
      "set logscale x\nset xrange [0.05:2e7]\nset yrange [-0.7:" +
      std::to_string(kLines.size() - 1) +
      ".7]\nset xtics ('0.1' 0.1, '1' 1, '10' 10, '100' 100, '10³' 1e3, '10⁴' 1e4, '10⁵' 1e5)\n"
      "set arrow 1 from first 1000, graph 0 to first 1000, graph 1 nohead lc rgb '#b0b0b0' dt 2\n"
      "set arrow 2 from first 5000, graph 0 to first 5000, graph 1 nohead lc rgb '#b0b0b0' dt 3\n"
      "set xlabel 'from hand to force [µs]'\n"
      "unset key\n";
  for (std::size_t i = 0; i < kWindowRadii.size(); ++i) {
    text += panel_head(grid, i, "R = " + std::to_string(kWindowRadii[i]) + " finest voxels") +
            line_tics(i == 0) + panel_of(rows, kWindowRadii[i]);
  }
  KeyStrip key(0.1, 4);
  for (const Step& step : kSteps) key.add(step.style, step.title);
  text += "unset arrow\n";
  for (std::size_t n = 20; n <= 20 + kLines.size(); ++n) {
    text += "unset label " + std::to_string(n) + "\n";
  }
  return finished(sheet, text + key.text());
}

}  // namespace argil::evaluation
