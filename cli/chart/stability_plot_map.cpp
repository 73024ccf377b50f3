// SPDX-License-Identifier: GPL-3.0-or-later
// The maps of the K-B plane and of the tau-lambda plane.
#include <algorithm>
#include <cmath>
#include <set>

#include "chart/stability_plot.h"
#include "output.h"

namespace argil::cli::chart {
namespace {

/// B on the map's axis: 0 has a row of its own below 1.
double damping_place(double damping) { return damping < 1.0 ? -0.35 : std::log2(damping); }

std::string wall_boxes(const std::vector<WallRow>& rows, haptics::Hand hand, double lag_s,
                       haptics::Verdict verdict, double half_x, double half_y) {
  std::string text;
  for (const WallRow& row : rows) {
    if (row.hand != hand || row.velocity_lag_s != lag_s || row.found.verdict != verdict) continue;
    const double k = std::log10(row.stiffness_n_per_m);
    const double b = damping_place(row.damping_n_s_per_m);
    text += number(k) + " " + number(b) + " " + number(k - half_x) + " " + number(k + half_x) +
            " " + number(b - half_y) + " " + number(b + half_y) + "\n";
  }
  return text;
}

/// Half the step between the values that occur.
double half_step(const std::set<double>& values) {
  const double span = *values.rbegin() - *std::next(values.begin());
  return 0.5 * span / static_cast<double>(values.size() - 2);
}

std::string wall_panel(const std::vector<WallRow>& rows, haptics::Hand hand, double lag_s) {
  std::set<double> across;
  std::set<double> up;
  for (const WallRow& row : rows) {
    across.insert(std::log10(row.stiffness_n_per_m));
    up.insert(damping_place(row.damping_n_s_per_m));
  }
  const double half_x = half_step(across);
  const double half_y = half_step(up);
  PlotLines lines;
  using enum haptics::Verdict;
  const auto add = [&](haptics::Verdict verdict, const char* color, const char* title) {
    lines.add(wall_boxes(rows, hand, lag_s, verdict, half_x, half_y),
              std::string("boxxyerror fs solid noborder lc rgb '") + color + "'", title);
  };
  add(quiet, "#9ad0ae", "quiet");
  add(buzz, "#f6c667", "buzz");
  add(limit_cycle, "#d9694a", "limit cycle");
  std::string border;
  for (const auto& [k, b] : eigenvalue_border(hand)) {
    if (k > 0.0) border += point_text(std::log10(k), damping_place(b));
  }
  lines.add(border, "lines lw 2 lc rgb '#000000'", "exact eigenvalue, raw velocities, no friction");
  return lines.text();
}

/// White where the filter changes nothing, red where it costs stiffness, blue where it gains.
std::string ratio_color(double ratio) {
  const double size = std::min(1.0, std::abs(std::log10(ratio)));
  const auto part = [&](double full) {
    return static_cast<int>(std::lround(255.0 + size * (full - 255.0)));
  };
  const bool gains = ratio > 1.0;
  char text[16];
  std::snprintf(text, sizeof text, "0x%02x%02x%02x", part(gains ? 30.0 : 178.0),
                part(gains ? 100.0 : 45.0), part(gains ? 200.0 : 30.0));
  return text;
}

std::string filter_panel(const std::vector<FilterRow>& rows, haptics::Hand hand) {
  std::set<double> gains;
  std::set<double> lambdas;
  for (const FilterRow& row : rows) {
    gains.insert(row.gain);
    lambdas.insert(row.lambda_mm);
  }
  const auto place = [](const std::set<double>& values, double value) {
    return static_cast<double>(std::distance(values.begin(), values.find(value)));
  };
  std::string boxes;
  std::string numbers;
  for (const FilterRow& row : rows) {
    if (row.hand != hand) continue;
    const double x = place(gains, row.gain);
    const double y = place(lambdas, row.lambda_mm);
    boxes += number(x) + " " + number(y) + " 0.5 0.5 " + ratio_color(row.ratio) + "\n";
    char ratio[16];
    std::snprintf(ratio, sizeof ratio, "%.2f", row.ratio);
    numbers += number(x) + " " + number(y) + " " + ratio + "\n";
  }
  const auto tics = [&](const char* axis, const std::set<double>& values) {
    std::string text = std::string("set ") + axis + "tics (";
    for (const double value : values) {
      text += (value == *values.begin() ? "'" : ",'") + number(value) + "' " +
              number(place(values, value));
    }
    return text + ")\nset " + axis +
           "range [-0.5:" + number(static_cast<double>(values.size()) - 0.5) + "]\n";
  };
  PlotLines lines;
  lines.add(boxes, "boxxyerror fs solid noborder lc rgb variable", "");
  lines.add(numbers, "labels font ',10'", "");
  return tics("x", gains) + tics("y", lambdas) + lines.text();
}

}  // namespace

Script wall_script(const std::vector<WallRow>& rows) {
  const Sheet sheet{"stability_wall", 1100, 900, "Walls of stiffness K and rendered damping B",
                    "Hold of 3 N, 1 kHz, one tick of delay, simulated Falcon with 0.15 N of "
                    "friction, without a coupling. The lowest row is B = 0."};
  PanelGrid grid{2, 2, 0.075, 0.98, 0.855, 0.125, 0.035, 0.09};
  std::string text =
      "unset grid\nset xrange [1.95:4.65]\nset yrange [-0.7:8.9]\n"
      "set xtics ('100' 2,'200' 2.301,'500' 2.699,'1000' 3,'2000' 3.301,'5000' 3.699,"
      "'10000' 4,'20000' 4.301,'40000' 4.602)\n";
  const double lag_s = haptics::VelocityFilter::kUsualLagS;
  for (std::size_t i = 0; i < 4; ++i) {
    const haptics::Hand hand = i < 2 ? haptics::Hand::push : haptics::Hand::light;
    const bool is_raw = i % 2 == 0;
    text += panel_head(grid, i,
                       std::string(haptics::hand_model(hand).name) +
                           (is_raw ? " hand, raw velocities"
                                   : " hand, velocities in a mean of 3 ms (the default)"));
    text += is_raw ? "set ylabel 'B [N s/m]'\nset ytics ('0' -0.35,'1' 0,'2' 1,'5' 2.322,'10' "
                     "3.322,'20' 4.322,'50' 5.644,'100' 6.644,'200' 7.644,'400' 8.644)\n"
                   : "unset ylabel\nset format y ''\n";
    text += i < 2 ? "unset xlabel\n" : "set xlabel 'K [N/m]'\n";
    text += i == 0 ? "set key at screen 0.5,0.05 center top horizontal maxcols 4 Left reverse "
                     "samplen 2 width 1 font ',11'\n"
                   : "unset key\n";
    text += wall_panel(rows, hand, is_raw ? 0.0 : lag_s);
  }
  return finished(sheet, text);
}

Script filter_script(const std::vector<FilterRow>& rows) {
  const Sheet sheet{
      "stability_filter", 1100, 860, "The filtered position: stable stiffness against none",
      "Ratio of the first limit cycle to that without a filter (tau = 1), on a grid of 10 %: red "
      "loses, blue gains. Contact law of exponent 4, 3 N, 1 kHz, one tick of delay."};
  PanelGrid grid{2, 2, 0.075, 0.98, 0.855, 0.08, 0.06, 0.1};
  std::string text = "unset grid\n";
  for (std::size_t i = 0; i < kHands.size(); ++i) {
    text += panel_head(grid, i, std::string(haptics::hand_model(kHands[i]).name) + " hand");
    text += i % 2 == 0 ? "set ylabel 'lambda [mm]'\n" : "unset ylabel\n";
    text += i < 2 ? "unset xlabel\n" : "set xlabel 'tau per ms'\n";
    text += filter_panel(rows, kHands[i]);
  }
  return finished(sheet, text);
}

}  // namespace argil::cli::chart
