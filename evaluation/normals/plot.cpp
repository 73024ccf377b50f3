// SPDX-License-Identifier: GPL-3.0-or-later
// The chart of normals: error against setting and time on the surface, against time below it.
#include <array>
#include <functional>
#include <string>
#include <string_view>

#include "common/output.h"
#include "normals/rows.h"
#include "normals/strategy.h"

namespace argil::evaluation {
namespace {

/// Colours that the colour-blind can tell apart.
struct StrategyLook {
  const char* family;
  const char* title;
  const char* style;
};
constexpr std::array kStrategyLooks{
    StrategyLook{kUpwards, "straight up (3.17)", "points pt 2 ps 1.2 lw 2 lc rgb '#606060'"},
    StrategyLook{kAnalytic, "analytic (3.22), 0 to 4 steps",
                 "linespoints pt 7 ps 0.9 lw 2 lc rgb '#0072b2'"},
    StrategyLook{kNearest, "table, nearest", "linespoints pt 4 ps 1 lw 2 lc rgb '#e69f00'"},
    StrategyLook{kBilinear, "table, bilinear", "linespoints pt 5 ps 0.9 lw 2 lc rgb '#d55e00'"},
    StrategyLook{kAhead, "differences ahead", "linespoints pt 8 ps 1 lw 2 lc rgb '#56b4e9'"},
    StrategyLook{kCentral, "central differences", "linespoints pt 9 ps 1 lw 2 lc rgb '#009e73'"},
    StrategyLook{kNetwork, "network of sines", "points pt 3 ps 1.8 lw 2.5 lc rgb '#cc79a7'"}};
constexpr const char* kNetworkLine = "lines lw 2 dt 2 lc rgb '#cc79a7'";
constexpr const char* kAnalyticLine = "lines lw 2 dt 2 lc rgb '#0072b2'";

using NormalMeasure = std::function<double(const NormalRow&)>;

double setting_of(const NormalRow& row) { return row.setting; }
double ns_of(const NormalRow& row) { return row.ns; }
double angle_of(const NormalRow& row) { return row.angle_rms_deg; }
double distance_of(const NormalRow& row) { return row.distance_rms_mm; }

/// Rows of a family at a depth; what is exact has no place on a logarithmic axis.
std::string family_curve(const std::vector<NormalRow>& rows, const std::string& family,
                         double depth_mm, const NormalMeasure& x, const NormalMeasure& y) {
  constexpr double kLeast = 1e-9;
  return points_of(
      rows,
      [&](const NormalRow& row) {
        return row.strategy == family && row.depth_mm == depth_mm && y(row) > kLeast;
      },
      x, y);
}

/// Error on the surface against spacing or step.
std::string setting_panel(const std::vector<NormalRow>& rows) {
  PlotLines lines;
  for (const StrategyLook& look : kStrategyLooks) {
    const std::string family = look.family;
    if (family == kUpwards || family == kAnalytic || family == kNetwork) continue;
    lines.add(family_curve(rows, family, 0.0, setting_of, angle_of), look.style);
  }
  const auto across = [&rows](const char* family) {
    const auto level = [](double x) { return [x](const NormalRow&) { return x; }; };
    return family_curve(rows, family, 0.0, level(1e-12), angle_of) +
           family_curve(rows, family, 0.0, level(10.0), angle_of);
  };
  lines.add(across(kNetwork), kNetworkLine);
  return "set logscale xy\nset xrange [5e-13:20]\nset yrange [1e-9:100]\nset format x '%g'\n"
         "set format y '%g'\nset xtics 1e-12,100\nset ytics 1e-8,100\n"
         "set xlabel 'spacing, step [mm]'\nset ylabel 'normal off by [degrees rms]'\n" +
         lines.text();
}

/// Only what more steps of one way gain is a line: times of tables and differences hardly depend on
/// their setting, and a line through them would run to and fro.
std::string time_style(const StrategyLook& look) {
  const std::string style = look.style;
  constexpr std::string_view kLines = "lines";
  const bool has_line = style.starts_with(kLines) && look.family != std::string_view(kAnalytic);
  return has_line ? style.substr(kLines.size()) : style;
}

std::string time_panel_of(const std::vector<NormalRow>& rows, double depth_mm,
                          const NormalMeasure& error, const std::string& more) {
  PlotLines lines;
  for (const StrategyLook& look : kStrategyLooks) {
    lines.add(family_curve(rows, look.family, depth_mm, ns_of, error), time_style(look));
  }
  // On the surface the analytic normal is exact.
  if (depth_mm == 0.0) {
    std::string upright;
    for (const NormalRow& row : rows) {
      if (row.strategy != kAnalytic || row.depth_mm != 0.0 || row.setting != 0.0) continue;
      upright = point_text(row.ns, 1e-9) + point_text(row.ns, 100.0);
    }
    lines.add(upright, kAnalyticLine);
  }
  return "set logscale xy\nset xrange [40:1000]\nset xtics (50,100,200,300,500,1000)\n"
         "set format x '%g'\nset xlabel 'thread CPU time [ns]'\n" +
         more + lines.text();
}

}  // namespace

Script normals_script(const std::vector<NormalRow>& rows) {
  const Sheet sheet{"normals", 1280, 980, "Normals of waves: what each way costs and misses",
                    "Waves of 50 mm, 5 mm high (3.16). Distance and normal of random points, each "
                    "answer after the last; on the surface, and 3 mm below it, where the nearest "
                    "point is not straight above."};
  const PanelGrid grid{2, 2, 0.075, 0.98, 0.87, 0.16, 0.075, 0.12};
  const std::string degrees = "set ylabel 'normal off by [degrees rms]'\n";
  std::string text = "unset key\n";
  text += panel_head(grid, 0, "On the surface, by spacing or step") + setting_panel(rows);
  text += panel_head(grid, 1, "On the surface, by time; the dashed line is exact") +
          time_panel_of(rows, 0.0, angle_of, "set yrange [1e-9:100]\n" + degrees);
  text +=
      panel_head(grid, 2, "3 mm below the surface") +
      time_panel_of(rows, 3.0, angle_of, "set yrange [1e-3:100]\nset ytics 1e-3,10\n" + degrees);
  text += panel_head(grid, 3, "3 mm below the surface: the distance") +
          time_panel_of(
              rows, 3.0, distance_of,
              "set yrange [1e-9:1]\nset ytics 1e-9,10\nset ylabel 'distance off by [mm rms]'\n");
  KeyStrip key(0.1, 4);
  for (const StrategyLook& look : kStrategyLooks) key.add(look.style, look.title);
  return finished(sheet, text + key.text());
}

}  // namespace argil::evaluation
