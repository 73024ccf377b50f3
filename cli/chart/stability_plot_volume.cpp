// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of the volume force in the closed loop.
#include <array>
#include <map>

#include "chart/stability_plot.h"

namespace argil::cli::chart {
namespace {

struct HandLook {
  haptics::Hand hand;
  const char* color;
  int mark;
};
constexpr std::array kHandLooks{
    HandLook{haptics::Hand::push, "#d55e00", 5}, HandLook{haptics::Hand::light, "#e69f00", 7},
    HandLook{haptics::Hand::arm, "#009e73", 9}, HandLook{haptics::Hand::firm, "#0072b2", 13}};

/// The point law stands to the left of the smallest ball.
double radius_place(double radius_mm) { return radius_mm > 0.0 ? radius_mm : 0.5; }

std::string style_of(const HandLook& look, const char* kind) {
  return std::string(kind) + " pt " + std::to_string(look.mark) + " ps 0.9 lw 1.8 lc rgb '" +
         look.color + "'";
}

std::string skin_panel(const VolumeResult& result, double exponent) {
  PlotLines lines;
  for (const HandLook& look : kHandLooks) {
    std::string text;
    for (const VolumeLimit& limit : result.limits) {
      if (limit.hand != look.hand || limit.exponent != exponent) continue;
      text += point_text(radius_place(limit.radius_mm), limit.quiet_skin_mm);
    }
    lines.add(text, style_of(look, "linespoints"),
              std::string(haptics::hand_model(look.hand).name) + " hand");
  }
  return lines.text();
}

/// Slopes at the first limit cycle, hollow the largest where there was none, and the linear wall's.
std::string slope_panel(const VolumeResult& result, double exponent) {
  PlotLines lines;
  for (const HandLook& look : kHandLooks) {
    const std::string color = std::string(" lc rgb '") + look.color + "'";
    std::string cycles;
    std::string none;
    std::string linear;
    for (const VolumeLimit& limit : result.limits) {
      if (limit.hand != look.hand || limit.exponent != exponent) continue;
      const double x = radius_place(limit.radius_mm);
      if (limit.found.cycle) {
        cycles += point_text(x, limit.cycle_slope_n_per_m);
      } else {
        none += point_text(x, limit.most_slope_n_per_m);
      }
      if (limit.linear.cycle) linear += point_text(x, *limit.linear.cycle);
    }
    lines.add(linear, "lines lw 1.2 dt 2" + color, "");
    lines.add(cycles, style_of(look, "points"), "");
    lines.add(none, "points pt 6 ps 1.1 lw 1.5" + color, "");
  }
  return lines.text();
}

/// Slope of the ball's force at the surface against the point law's, over R / skin.
std::string ratio_panel(const VolumeResult& result) {
  PlotLines lines;
  for (const double exponent : {2.0, 4.0}) {
    std::map<double, double> ratios;
    for (const VolumeRow& row : result.rows) {
      if (row.exponent != exponent || row.radius_mm <= 0.0) continue;
      ratios[row.radius_mm / row.skin_mm] = row.surface_slope_n_per_m / row.point_slope_n_per_m;
    }
    std::string text;
    for (const auto& [x, ratio] : ratios) text += point_text(x, ratio);
    const bool is_two = exponent == 2.0;
    lines.add(text,
              is_two ? "linespoints pt 7 ps 0.7 lw 1.8 lc rgb '#000000'"
                     : "linespoints pt 7 ps 0.7 lw 1.8 lc rgb '#7f7f7f'",
              is_two ? "exponent 2" : "exponent 4");
  }
  lines.add("0.5 1\n1 0.84\n2 0.48\n4 0.25\n", "points pt 2 ps 1.1 lw 1.5 lc rgb '#000000'",
            "theory C.1, exponent 2");
  lines.add("0.5 0.84\n1 0.48\n2 0.25\n4 0.13\n", "points pt 2 ps 1.1 lw 1.5 lc rgb '#7f7f7f'",
            "theory C.1, exponent 4");
  return lines.text();
}

}  // namespace

Script volume_script(const VolumeResult& result) {
  const Sheet sheet{
      "stability_volume", 1280, 860, "The volume force in the closed loop",
      "A ball held at flat clay with 3 N, 1 kHz, one tick of delay, without a coupling; P is the "
      "point law. Dashed: the limit of a linear wall. Hollow: no limit cycle at any skin."};
  PanelGrid grid{3, 2, 0.065, 0.985, 0.85, 0.085, 0.055, 0.13};
  std::string text = "set logscale xy\n";
  for (std::size_t i = 0; i < 5; ++i) {
    const bool is_ratio = i == 2;
    const double exponent = i % 3 == 0 ? 2.0 : 4.0;
    const std::string law = exponent == 2.0 ? ", exponent 2" : ", exponent 4";
    text += panel_head(grid, i,
                       is_ratio ? "Slope at the surface: ball to point"
                                : (i < 2 ? "Thinnest quiet skin" : "Slope where it cycles") + law);
    if (is_ratio) {
      text +=
          "set xrange [0.05:20]\nset yrange [0.02:1.5]\nset xtics auto\nset format x '%g'\n"
          "set xlabel 'R / skin'\nset ylabel 'ratio' offset 1,0\n"
          "set key left bottom Left reverse samplen 1.6 font ',11'\n";
    } else {
      text +=
          "set xrange [0.4:20]\nset xtics ('P' 0.5,'1' 1,'2' 2,'4' 4,'8' 8,'16' 16)\n"
          "set xlabel 'radius of the tool [mm]'\n";
      text += i < 2 ? "set yrange [0.08:10]\nset ylabel 'skin [mm]' offset 1,0\n"
                    : "set yrange [200:8e4]\nset ylabel 'slope at 3 N [N/m]' offset 1,0\n";
      text += i == 4 ? "set key at screen 0.75,0.33 left top Left reverse samplen 2 spacing 1.4 "
                       "font ',12'\n"
                     : "unset key\n";
    }
    text += is_ratio ? ratio_panel(result)
                     : (i < 2 ? skin_panel(result, exponent) : slope_panel(result, exponent));
  }
  return finished(sheet, text);
}

}  // namespace argil::cli::chart
