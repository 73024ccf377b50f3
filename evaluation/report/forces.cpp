// SPDX-License-Identifier: GPL-3.0-or-later
// Figure 4 of Blanch et al. 2004, the change between touching and working (3) to (5), and the
// filtered position (6) to (12).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "argil/haptics/force/force_mix.h"
#include "argil/haptics/force/tool_force.h"
#include "argil/haptics/servo/position_filter.h"

#include "common/output.h"
#include "force/analytic_window.h"
#include "report/parts.h"

namespace argil::evaluation {
namespace {

constexpr double kTickS = 1e-3;

constexpr const char* kReportBlue = "lines lw 2.2 lc rgb '#0072b2'";
constexpr const char* kReportOrange = "lines lw 2 lc rgb '#d55e00'";
constexpr const char* kReportGreen = "lines lw 2 lc rgb '#009e73'";
constexpr const char* kReportDashed = "lines lw 1.5 dt 2 lc rgb '#606060'";

std::string key_at(const char* place) { return "set key " + std::string(place) + " samplen 2\n"; }

/// The contact force along z of a tool at height `z_mm` over flat clay.
double contact_over_flat(const FieldWindow& window, double z_mm, bool is_volume) {
  haptics::ForceTool tool;
  tool.radii_mm = {4.0, 4.0, 4.0};
  tool.position_mm = {0.0, 0.0, z_mm};
  const haptics::ForceMaterial material;
  const auto force = is_volume
                         ? volume_force(window.view, tool, material, haptics::ForceLaw::energy)
                         : point_force(window.view, tool, material);
  return force.contact_n.z;
}

ReportFigure contact_figure() {
  const haptics::ForceMaterial material;
  const FieldWindow window =
      analytic_window([](const Vec3& p) { return p.z; }, {0.0, 0.0, -2.0}, 24.0, 0.5);
  std::string point;
  std::string ball;
  std::string tangent;
  for (int n = -100; n <= 120; ++n) {
    const double depth_mm = 0.1 * n;
    point += point_text(depth_mm, contact_over_flat(window, -depth_mm, false));
    ball += point_text(depth_mm, contact_over_flat(window, -depth_mm, true));
    const double spring_n =
        material.surface_force_n * (1.0 + material.exponent * depth_mm / material.skin_mm);
    if (spring_n >= 0.0 && depth_mm <= 5.0) tangent += point_text(depth_mm, spring_n);
  }
  const double clamp_n = material.clamp_ratio * material.surface_force_n;
  const double slope_n_per_m =
      1e3 * (contact_over_flat(window, -0.05, false) - contact_over_flat(window, 0.05, false)) /
      0.1;
  const Sheet sheet{"report_blanch_4", 1000, 560, "Contact force over the depth of the tool",
                    "Flat clay, f_c0 = 3 N, e = 2, skin 8 mm; the force is clamped to 8/3 f_c0."};
  PlotLines lines;
  lines.add(point, kReportBlue, "at a point, (2)");
  lines.add(ball, kReportOrange, "over a ball of 4 mm (conclusion of the report)");
  lines.add(tangent, kReportDashed, "spring at the surface, e f_c0 / skin");
  ReportFigure figure;
  figure.title = "Blanch et al. 2004, figure 4 and (2): contact force";
  figure.printed =
      "The force grows with a power of the field inside, is clamped, and near the surface is like "
      "a spring of stiffness e.";
  figure.ours =
      "Force of (2) on flat clay with its clamp, the spring that it is at the surface, and the "
      "same law over the body of a ball, which the report left for later: its corner at the clamp "
      "is round.";
  figure.numbers = {
      {"force on the surface", "N", "f_c0 = 3", contact_over_flat(window, 0.0, false), ""},
      {"stiffness on the surface", "N/m",
       "e f_c0 / skin = " +
           cli::number(1e3 * material.exponent * material.surface_force_n / material.skin_mm),
       slope_n_per_m,
       "the report calls e the stiffness, which it is in units of f_c0 and of the distance in "
       "which V rises by V0"},
      {"clamp", "N", "", contact_over_flat(window, -12.0, false),
       "8/3 f_c0 = " + cli::number(clamp_n) + " N, what a Falcon can give"}};
  figure.command = "argil force clay.vdb --tool ball:4 --at 0,30,0 --method point";
  figure.script = finished(
      sheet, panel_head({1, 1, 0.08, 0.97, 0.86, 0.12}, 0, "") + key_at("left top Left reverse") +
                 "set xlabel 'depth of the centre below the surface / mm'\nset ylabel 'force / N'\n"
                 "set yrange [0:9]\n" +
                 lines.text());
  return figure;
}

ReportFigure modes_figure() {
  const haptics::ForceMix mix;
  haptics::ModeBlend blend;
  constexpr double kPressS = 0.1;
  constexpr double kReleaseS = 0.35;
  std::string p;
  std::string contact;
  std::string viscosity;
  std::string total;
  double most_change = 0.0;
  double before = 0.0;
  for (int n = 0; n <= 600; ++n) {
    const double time_s = kTickS * n;
    const double now = blend.tick(time_s >= kPressS && time_s < kReleaseS, kTickS);
    most_change = std::max(most_change, std::abs(now - before));
    before = now;
    p += point_text(1e3 * time_s, now);
    // Contact of 3 N, drag of 1 N across it.
    const Vec3 touched = haptics::mix_forces(mix, {0.0, 0.0, 3.0}, {-1.0, 0.0, 0.0}, now);
    contact += point_text(1e3 * time_s, touched.z);
    viscosity += point_text(1e3 * time_s, -touched.x);
    total += point_text(1e3 * time_s, length(touched));
  }
  const Sheet sheet{"report_blanch_5", 1000, 520, "From touching to working and back",
                    "The button is pressed at 100 ms and released at 350; contact 3 N, drag 1 N."};
  const PanelGrid grid{2, 1, 0.07, 0.97, 0.82, 0.13, 0.08, 0.1};
  PlotLines left;
  left.add(p, kReportBlue);
  PlotLines right;
  right.add(contact, kReportOrange, "contact, weight alpha_p 1, alpha_a 0.3");
  right.add(viscosity, kReportGreen, "drag, weight beta_p 0.3, beta_a 1");
  right.add(total, kReportDashed, "both, across each other");
  ReportFigure figure;
  figure.title = "Blanch et al. 2004, (3) to (5): two modes of force";
  figure.printed =
      "alpha_p > beta_p while touching, alpha_a < beta_a while working, and p goes from 0 to 1 "
      "without a jump; no values.";
  figure.ours =
      "p is a ramp of 100 ms from wherever it is, so that no tick changes it by more "
      "than 1 %.";
  figure.numbers = {{"most change of p in a tick of 1 ms", "", "continuous", most_change, ""}};
  figure.script = finished(sheet, "set xlabel 'time / ms'\n" + panel_head(grid, 0, "p of (5)") +
                                      "set yrange [0:1.05]\n" + left.text() +
                                      panel_head(grid, 1, "the forces of (5) / N") +
                                      key_at("right top") + "set yrange [0:5]\n" + right.text());
  return figure;
}

/// The filtered share of a step, tick by tick.
std::string step_response(double step_mm) {
  haptics::PositionFilter filter{haptics::PositionFilterOptions{}};
  filter.filter({}, kTickS);
  std::string points = point_text(0.0, 0.0);
  for (int n = 1; n <= 40; ++n) {
    points += point_text(n, filter.filter({step_mm, 0.0, 0.0}, kTickS).x / step_mm);
  }
  return points;
}

/// How far behind it is in a steady movement.
double lag_mm(double speed_mm_per_s) {
  haptics::PositionFilter filter{haptics::PositionFilterOptions{}};
  double behind_mm = 0.0;
  for (int n = 0; n <= 400; ++n) {
    const double x = speed_mm_per_s * kTickS * n;
    behind_mm = x - filter.filter({x, 0.0, 0.0}, kTickS).x;
  }
  return behind_mm;
}

/// What is left of a vibration: half of peak to peak over its amplitude, after half a second.
double left_of_vibration(double frequency_hz, double amplitude_mm) {
  haptics::PositionFilter filter{haptics::PositionFilterOptions{}};
  double least = 0.0;
  double most = 0.0;
  for (int n = 0; n < 1500; ++n) {
    const double angle = 2.0 * std::numbers::pi * frequency_hz * kTickS * n;
    const double x = filter.filter({amplitude_mm * std::sin(angle), 0.0, 0.0}, kTickS).x;
    if (n < 500) continue;
    least = std::min(least, x);
    most = std::max(most, x);
  }
  return 0.5 * (most - least) / amplitude_mm;
}

ReportFigure filter_figure() {
  const haptics::PositionFilterOptions options;
  const double bound_mm = (1.0 - options.gain) * options.lambda_mm;
  const std::array<double, 3> sizes_mm{0.03, 0.3, 3.0};
  const std::array<const char*, 3> styles{kReportBlue, kReportOrange, kReportGreen};
  PlotLines steps;
  PlotLines vibrations;
  for (std::size_t n = 0; n < sizes_mm.size(); ++n) {
    const std::string title = cli::number(sizes_mm[n]) + " mm";
    steps.add(step_response(sizes_mm[n]), styles[n], title);
    std::string left;
    for (const double f : grown_by(1.1, 1.0, 460.0)) {
      left += point_text(f, left_of_vibration(f, sizes_mm[n]));
    }
    vibrations.add(left, styles[n], title);
  }
  std::string lags;
  std::string bounds;
  std::string lambdas;
  double farthest_mm = 0.0;
  for (const double v : grown_by(1.15, 1.0, 3001.0)) {
    farthest_mm = std::max(farthest_mm, lag_mm(v));
    lags += point_text(v, lag_mm(v));
    bounds += point_text(v, bound_mm);
    lambdas += point_text(v, options.lambda_mm);
  }
  PlotLines gaps;
  gaps.add(lags, kReportBlue, "distance of the filtered position");
  gaps.add(bounds, kReportDashed, "(1 - tau) lambda");
  gaps.add(lambdas, kAskedStyle, "lambda, (12) as printed");
  const Sheet sheet{"report_blanch_6", 1280, 520, "The filtered position",
                    "tau 0.2 in a tick of 1 ms, lambda 0.3 mm."};
  const PanelGrid grid{3, 1, 0.05, 0.985, 0.82, 0.13, 0.055, 0.1};
  ReportFigure figure;
  figure.title = "Blanch et al. 2004, (6) to (12): the filtered position";
  figure.printed =
      "Small and fast movements are damped, large ones are not, and the filtered position is never "
      "farther than lambda from the real one.";
  figure.ours =
      "A step of a tenth of lambda is followed in 10 ms, one of ten times lambda at once; "
      "vibrations below lambda are cut from 30 Hz on. The bound is (1 - tau) lambda: (10) and (12) "
      "lack that factor.";
  figure.numbers = {{"farthest from the real position, to 3 m/s", "mm", "at most lambda = 0.3",
                     farthest_mm, "after (6) the gap is (1 - tau) |dp|: at most 0.24 mm"}};
  figure.command = "argil lab wall-linear --coupling direct --filter 0.2 --plot run.svg";
  figure.script = finished(
      sheet, "set yrange [0:1.05]\nset xlabel 'time after the step / ms'\n" +
                 panel_head(grid, 0, "share of a step that is followed") + key_at("right bottom") +
                 steps.text() + panel_head(grid, 1, "distance from the real position / mm") +
                 "set logscale x\nset xlabel 'speed / mm/s'\nset yrange [0:0.42]\n" +
                 key_at("left top Left reverse") + gaps.text() +
                 panel_head(grid, 2, "share of a vibration that is left") +
                 "set xlabel 'frequency / Hz'\nset yrange [0:1.05]\n" +
                 key_at("left bottom Left reverse") + vibrations.text());
  return figure;
}

}  // namespace

ReportFigures force_figures() { return {contact_figure(), modes_figure(), filter_figure()}; }

}  // namespace argil::evaluation
