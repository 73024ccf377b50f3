// SPDX-License-Identifier: GPL-3.0-or-later
// The maps of the K-B plane and of the tau-lambda plane.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <functional>
#include <set>

#include "chart/sheet.h"
#include "common/output.h"
#include "stability/plot.h"
#include "stability/verdict_look.h"

namespace argil::evaluation {
namespace {

/// B on the map's axis: 0 has a row of its own below 1.
double damping_on_axis(double damping) { return damping < 1.0 ? -0.35 : std::log2(damping); }

std::string wall_boxes(const std::vector<WallRow>& rows,
                       const std::function<bool(const WallRow&)>& is_shown,
                       haptics::Verdict verdict, double half_x, double half_y) {
  std::string text;
  for (const WallRow& row : rows) {
    if (!is_shown(row) || row.found.verdict != verdict) continue;
    const double k = std::log10(row.stiffness_n_per_m);
    const double b = damping_on_axis(row.damping_n_s_per_m);
    text += cli::number(k) + " " + cli::number(b) + " " + cli::number(k - half_x) + " " +
            cli::number(k + half_x) + " " + cli::number(b - half_y) + " " +
            cli::number(b + half_y) + "\n";
  }
  return text;
}

/// Half the step between the values that occur.
double half_step(const std::set<double>& values) {
  assert(values.size() > 2);  // the least is a row of its own, apart from the others
  const double span = *values.rbegin() - *std::next(values.begin());
  return 0.5 * span / static_cast<double>(values.size() - 2);
}

constexpr const char* kBorder = "lines lw 2 lc rgb '#000000'";

std::string wall_panel(const std::vector<WallRow>& rows, haptics::Hand hand, double lag_s,
                       bool is_frictionless) {
  const auto is_shown = [&](const WallRow& row) {
    return row.hand == hand && row.velocity_lag_s == lag_s &&
           row.is_frictionless == is_frictionless;
  };
  std::set<double> across;
  std::set<double> up;
  for (const WallRow& row : rows) {
    across.insert(std::log10(row.stiffness_n_per_m));
    up.insert(damping_on_axis(row.damping_n_s_per_m));
  }
  PlotLines lines;
  for (const VerdictLook& look : kVerdictLooks) {
    lines.add(wall_boxes(rows, is_shown, look.verdict, half_step(across), half_step(up)),
              std::string("boxxyerror ") + look.style);
  }
  std::string border;
  for (const auto& [k, b] : eigenvalue_border(hand, is_frictionless)) {
    // The axis is logarithmic and has no 0.
    if (k > 0.0) border += point_text(std::log10(k), damping_on_axis(b));
  }
  lines.add(border, kBorder);
  return lines.text();
}

/// White where the filter changes nothing, red where it costs stiffness, blue where it gains.
std::string ratio_color(double ratio) {
  // Full colour from ten times on.
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
    if (row.lambda_mm > 0.0) lambdas.insert(row.lambda_mm);
  }
  const auto index_of = [](const std::set<double>& values, double value) {
    return static_cast<double>(std::distance(values.begin(), values.find(value)));
  };
  std::string boxes;
  std::string numbers;
  for (const FilterRow& row : rows) {
    if (row.hand != hand || row.lambda_mm <= 0.0) continue;
    const double x = index_of(gains, row.gain);
    const double y = index_of(lambdas, row.lambda_mm);
    boxes += cli::number(x) + " " + cli::number(y) + " 0.5 0.5 " + ratio_color(row.ratio) + "\n";
    char ratio[16];
    std::snprintf(ratio, sizeof ratio, "%.2f", row.ratio);
    numbers += cli::number(x) + " " + cli::number(y) + " " + ratio + "\n";
  }
  const auto tics = [&](const char* axis, const std::set<double>& values) {
    std::string text = std::string("set ") + axis + "tics (";
    for (const double value : values) {
      text += (value == *values.begin() ? "'" : ",'") + cli::number(value) + "' " +
              cli::number(index_of(values, value));
    }
    return text + ")\nset " + axis +
           "range [-0.5:" + cli::number(static_cast<double>(values.size()) - 0.5) + "]\n";
  };
  PlotLines lines;
  lines.add(boxes, "boxxyerror fs solid noborder lc rgb variable");
  lines.add(numbers, "labels font ',10'");
  return tics("x", gains) + tics("y", lambdas) + lines.text();
}

}  // namespace

Script wall_script(const std::vector<WallRow>& rows) {
  const Sheet sheet{"stability_wall", 1280, 860, "Walls of stiffness K and rendered damping B",
                    "Hold of 3 N, 1 kHz, one tick of delay, simulated Falcon without a coupling. "
                    "The lowest row is B = 0."};
  struct Column {
    const char* title;
    double lag_s;
    bool is_frictionless;
  };
  const std::array columns{
      Column{"no friction, raw velocities", 0.0, true},
      Column{"friction 0.15 N, raw velocities", 0.0, false},
      Column{"friction, mean of 3 ms", haptics::VelocityFilter::kUsualLagS, false}};
  const PanelGrid grid{3, 2, 0.06, 0.985, 0.86, 0.13, 0.032, 0.09};
  std::string text =
      "unset key\nunset grid\nset xrange [1.95:4.65]\nset yrange [-0.7:8.9]\n"
      "set xtics ('100' 2,'200' 2.301,'500' 2.699,'1000' 3,'2000' 3.301,'5000' 3.699,"
      "'10000' 4,'40000' 4.602)\n";
  for (std::size_t i = 0; i < 6; ++i) {
    const Column& column = columns[i % 3];
    const haptics::Hand hand = i < 3 ? haptics::Hand::push : haptics::Hand::light;
    text +=
        panel_head(grid, i, std::string(haptics::hand_model(hand).name) + " hand, " + column.title);
    text += i % 3 == 0 ? "set ylabel 'B [N s/m]'\nset ytics ('0' -0.35,'1' 0,'2' 1,'5' 2.322,'10' "
                         "3.322,'20' 4.322,'50' 5.644,'100' 6.644,'200' 7.644,'400' 8.644)\n"
                       : "unset ylabel\nset ytics ('' -0.35,'' 0,'' 1,'' 2.322,'' 3.322,'' 4.322,"
                         "'' 5.644,'' 6.644,'' 7.644,'' 8.644)\n";
    text += i < 3 ? "unset xlabel\n" : "set xlabel 'K [N/m]'\n";
    text += wall_panel(rows, hand, column.lag_s, column.is_frictionless);
  }
  KeyStrip key(0.05, 4);
  for (const VerdictLook& look : kVerdictLooks) {
    key.add(std::string("boxes ") + look.style, look.title);
  }
  key.add(kBorder, "eigenvalue, raw velocities");
  return finished(sheet, text + key.text());
}

Script filter_script(const std::vector<FilterRow>& rows) {
  const Sheet sheet{
      "stability_filter", 1100, 860, "The filtered position: stable stiffness against none",
      "Ratio of the first limit cycle to that without a filter (tau = 1), on a grid of 10 %: red "
      "loses, blue gains. Contact law of exponent 4, 3 N, 1 kHz, one tick of delay."};
  PanelGrid grid{2, 2, 0.075, 0.98, 0.855, 0.08, 0.06, 0.1};
  std::string text = "unset key\nunset grid\n";
  for (std::size_t i = 0; i < kHands.size(); ++i) {
    text += panel_head(grid, i, std::string(haptics::hand_model(kHands[i]).name) + " hand");
    text += i % 2 == 0 ? "set ylabel 'lambda [mm]'\n" : "unset ylabel\n";
    text += i < 2 ? "unset xlabel\n" : "set xlabel 'tau per ms'\n";
    text += filter_panel(rows, kHands[i]);
  }
  return finished(sheet, text);
}

}  // namespace argil::evaluation
