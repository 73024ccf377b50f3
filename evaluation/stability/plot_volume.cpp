// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of the volume force in the closed loop.
#include <array>
#include <map>

#include "chart/sheet.h"
#include "stability/plot.h"

namespace argil::evaluation {
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
double radius_on_axis(double radius_mm) { return radius_mm > 0.0 ? radius_mm : 0.125; }

std::string hand_style(const HandLook& look, const char* kind) {
  return std::string(kind) + " pt " + std::to_string(look.mark) + " ps 0.9 lw 1.8 lc rgb '" +
         look.color + "'";
}

std::string skin_panel(const VolumeResult& result, double exponent) {
  PlotLines lines;
  for (const HandLook& look : kHandLooks) {
    std::string text;
    for (const VolumeLimit& limit : result.limits) {
      if (limit.hand != look.hand || limit.exponent != exponent) continue;
      if (limit.period_s > 1e-3 || limit.is_frictionless) continue;
      text += point_text(radius_on_axis(limit.radius_mm), limit.quiet_skin_mm);
    }
    lines.add(text, hand_style(look, "linespoints"));
  }
  return lines.text();
}

constexpr const char* kMostSlope = "lines lw 1.8 lc rgb '#a0a0a0'";

std::string linear_style(const HandLook& look) {
  return std::string("lines lw 1.4 dt 2 lc rgb '") + look.color + "'";
}

/// The slope where the tool rests when it first cycles, and the linear wall's limit.
std::string slope_panel(const VolumeResult& result, bool is_slow) {
  PlotLines lines;
  std::map<double, double> most;
  for (const HandLook& look : kHandLooks) {
    std::string cycles;
    std::string linear;
    for (const VolumeLimit& limit : result.limits) {
      if (limit.hand != look.hand || (limit.period_s > 1e-3) != is_slow) continue;
      if (limit.is_frictionless) continue;
      const double x = radius_on_axis(limit.radius_mm);
      if (limit.found.cycle) cycles += point_text(x, limit.cycle_slope_n_per_m);
      if (limit.linear.cycle && limit.exponent == 2.0) linear += point_text(x, *limit.linear.cycle);
      if (limit.radius_mm > 0.0) most[x] = limit.most_slope_n_per_m;
    }
    lines.add(linear, linear_style(look));
    lines.add(cycles, hand_style(look, "points"));
  }
  std::string bound;
  for (const auto& [x, slope] : most) bound += point_text(x, slope);
  lines.add(bound, kMostSlope);
  return lines.text();
}

/// Slope of the ball's force at the surface against the point law's, over R / skin.
std::string volume_ratio_panel(const VolumeResult& result) {
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

std::string volume_key() {
  KeyStrip key(0.09, 5);
  for (const HandLook& look : kHandLooks) {
    key.add(hand_style(look, "points"), std::string(haptics::hand_model(look.hand).name) + " hand");
  }
  key.add(kMostSlope, "steepest that a ball feels");
  for (const HandLook& look : kHandLooks) {
    key.add(linear_style(look), std::string("linear wall, ") + haptics::hand_model(look.hand).name);
  }
  return key.text();
}

std::string volume_panel_axes(std::size_t i) {
  if (i == 2) {
    return "set xrange [0.05:20]\nset yrange [0.02:1.5]\nset xtics auto\nset format x '%g'\n"
           "set xlabel 'R / skin'\nset ylabel 'ratio'\n"
           "set key left bottom Left reverse samplen 1.6 font ',11'\n";
  }
  const std::string across =
      "unset key\nset xrange [0.1:20]\nset xtics ('P' 0.125,'0.25' 0.25,'0.5' 0.5,'1' 1,'2' 2,"
      "'4' 4,'8' 8,'16' 16)\nset xlabel 'radius of the tool [mm]'\n";
  return across + (i < 2 ? "set yrange [0.08:10]\nset ylabel 'skin [mm]'\n"
                         : "set yrange [200:8e4]\nset ylabel 'slope at 3 N [N/m]'\n");
}

}  // namespace

Script volume_script(const VolumeResult& result) {
  const Sheet sheet{
      "stability_volume", 1280, 860, "The volume force in the closed loop",
      "A ball held at flat clay with 3 N, one tick of delay, 0.15 N of friction, no coupling; P is "
      "the point law. At 0.1 (exponent 2) and 0.2 (4), the thinnest tried: quiet at any skin."};
  const PanelGrid grid{3, 2, 0.065, 0.985, 0.85, 0.175, 0.075, 0.13};
  const std::array<const char*, 5> titles{
      "Thinnest quiet skin, exponent 2, 1 ms", "Thinnest quiet skin, exponent 4, 1 ms",
      "Slope at the surface: ball to point", "Slope where it cycles, 1 ms",
      "Slope where it cycles, 5 ms"};
  std::string text = "set logscale xy\n";
  for (std::size_t i = 0; i < titles.size(); ++i) {
    text += panel_head(grid, i, titles[i]) + volume_panel_axes(i);
    if (i == 2) {
      text += volume_ratio_panel(result);
    } else {
      text += i < 2 ? skin_panel(result, i == 0 ? 2.0 : 4.0) : slope_panel(result, i == 4);
    }
  }
  return finished(sheet, text + volume_key());
}

}  // namespace argil::evaluation
