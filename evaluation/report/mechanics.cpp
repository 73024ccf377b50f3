// SPDX-License-Identifier: GPL-3.0-or-later
// The Falcon report, section 3.1 to 3.3: how far the handle reaches, the spring and damper, and
// what a released handle tells of itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "argil/haptics/analysis/free_oscillation.h"
#include "argil/haptics/analysis/hold_test.h"
#include "argil/haptics/scene/scene_spring.h"
#include "argil/haptics/scene/scene_workspace.h"

#include "common/output.h"
#include "report/parts.h"
#include "report/runs.h"

namespace argil::evaluation {
namespace {

using cli::lab::LabOptions;
using haptics::ServoTick;

constexpr const char* kMotionTrace = "lines lw 1.6 lc rgb '#0072b2'";
constexpr const char* kPlaceDots = "points pt 7 ps 0.3 lc rgb '#0072b2'";
constexpr double kSpringNPerM = 800.0;

/// Places of the handle: as many as it takes to see the shape.
std::vector<Vec3> reached_places(const std::vector<ServoTick>& ticks) {
  constexpr std::size_t kStride = 30;
  std::vector<Vec3> places;
  for (std::size_t n = 0; n < ticks.size(); n += kStride) {
    if (ticks[n].is_ready) places.push_back(ticks[n].position_mm);
  }
  return places;
}

/// Two coordinates of the cloud against each other, and the box that the report gives.
std::string reach_panel(const PanelGrid& grid, std::size_t place, const std::vector<Vec3>& places,
                        std::size_t across, std::size_t up) {
  constexpr const char* kAxes[] = {"x", "y", "z"};
  // No two dots on one another.
  constexpr double kDotMm = 1.5;
  std::set<std::pair<long, long>> seen;
  std::string points;
  for (const Vec3& p : places) {
    const std::pair dot{std::lround(p[across] / kDotMm), std::lround(p[up] / kDotMm)};
    if (seen.insert(dot).second) points += point_text(p[across], p[up]);
  }
  const Box3 box = haptics::WorkspaceOptions().reach_mm;
  const auto corner = [&](const Vec3& x, const Vec3& y) { return point_text(x[across], y[up]); };
  PlotLines lines;
  lines.add(points, kPlaceDots);
  lines.add(corner(box.min, box.min) + corner(box.max, box.min) + corner(box.max, box.max) +
                corner(box.min, box.max) + corner(box.min, box.min),
            kAskedStyle);
  return panel_head(grid, place, std::string(kAxes[up]) + " over " + kAxes[across]) +
         "set xlabel '" + kAxes[across] + " / mm'\nset ylabel '" + kAxes[up] + " / mm'\n" +
         lines.text();
}

/// The cloud in space, y upwards as the device stands.
std::string reach_cloud(const std::vector<Vec3>& places) {
  std::string points;
  for (const Vec3& p : places) {
    points += cli::number(p.x) + " " + cli::number(p.z) + " " + cli::number(p.y) + "\n";
  }
  return "$cloud << EOD\n" + points +
         "EOD\nset origin 0.5,0.04\nset size 0.5,0.46\nset title 'the cloud' font ',13'\n"
         "set lmargin -1\nset rmargin -1\nset tmargin -1\nset bmargin -1\n"
         "set xlabel 'x / mm'\nset ylabel 'z / mm'\nset zlabel 'y / mm' rotate\n"
         "set xrange [-60:60]\nset yrange [-80:80] reverse\nset zrange [-80:90]\n"
         "set xtics 40\nset ytics 40\nset ztics 40\nset view equal xyz\nset view 62,38,1.1\n"
         "set xyplane relative 0\nset border 4095 lc rgb '#c0c0c0'\nunset colorbox\n"
         "splot $cloud using 1:2:3:3 with points pt 7 ps 0.25 lc palette\n";
}

Result<ReportFigure> reach_figure(const Progress& progress) {
  LabOptions options;
  options.scene = "workspace";
  const auto run = run_scene(options, progress);
  if (!run) return run.error();
  const Box3 reach = cli::lab::reach_along_axes(run.value().run.ticks);
  double lowest_mm = 0.0;
  for (const ServoTick& tick : run.value().run.ticks) {
    if (tick.is_ready) lowest_mm = std::min(lowest_mm, tick.position_mm.z);
  }
  ReportFigure figure;
  figure.title = "Falcon report, section 3.1: the workspace";
  figure.printed =
      "Extents along each axis, by hand to the ends of the arms, and a cloud of the "
      "places reached.";
  figure.ours =
      "The simulated handle is led to the end of each axis and then through all of the box. Its "
      "stops along x and y are those that the report measured; along z the arms of Martin and "
      "Hillier, through which its position is read, end before them. Beside the axis they reach "
      "the stop.";
  const char* why_far = "the stop; far out a count of the arms is up to half a millimetre";
  const char* why_z =
      "the arms' own kinematics end there; the report's handle was led off the "
      "axis, or its arms are worn, as it suspects";
  const char* why_stop = "the stop, as the counts of the arms' encoders tell it: 30 to 59 um each";
  figure.numbers = {{"x, least", "mm", "-50", reach.min.x, why_stop},
                    {"x, most", "mm", "50", reach.max.x, why_stop},
                    {"y, least", "mm", "-70", reach.min.y, why_stop},
                    {"y, most", "mm", "80", reach.max.y, why_stop},
                    {"z, least", "mm", "-70", reach.min.z, why_z},
                    {"z, least, beside the axis", "mm", "", lowest_mm, why_far},
                    {"z, most", "mm", "80", reach.max.z, why_z}};
  figure.command = command_of(options);
  const std::vector<Vec3> places = reached_places(run.value().run.ticks);
  const Sheet sheet{"report_falcon_reach", 1280, 1060, "How far the handle reaches",
                    "Led to the end of each axis, and to and fro through all of the box."};
  const PanelGrid grid{2, 2, 0.06, 0.985, 0.88, 0.1, 0.07, 0.12};
  KeyStrip key(0.04, 2);
  key.add(kPlaceDots, "reached");
  key.add(kAskedStyle, "extents of the report");
  figure.script = finished(
      sheet, "unset key\nset xrange [-85:85]\nset yrange [-85:95]\nset size ratio -1\n" +
                 reach_panel(grid, 0, places, 0, 1) + reach_panel(grid, 1, places, 2, 1) +
                 reach_panel(grid, 2, places, 0, 2) + "set size noratio\n" + reach_cloud(places) +
                 "set autoscale\nset yrange [*:*] noreverse\n" + key.text());
  return figure;
}

/// Slope of force over position along x by least squares, N/m.
double slope_n_per_m(const std::vector<ServoTick>& ticks) {
  double n = 0.0;
  double x = 0.0;
  double f = 0.0;
  double xx = 0.0;
  double xf = 0.0;
  for (const ServoTick& tick : ticks) {
    if (!tick.is_ready || tick.time_s < 1.0) continue;  // the servo ramps in
    n += 1.0;
    x += tick.position_mm.x;
    f += tick.force_n.x;
    xx += tick.position_mm.x * tick.position_mm.x;
    xf += tick.position_mm.x * tick.force_n.x;
  }
  return 1e3 * (n * xf - x * f) / (n * xx - x * x);
}

Result<ReportFigure> spring_figure(const Progress& progress) {
  LabOptions options;
  options.scene = "spring";
  options.coupling = 0;
  const auto run = run_scene(options, progress);
  if (!run) return run.error();
  ReportFigure figure;
  figure.title = "Falcon report, figure 1 and (3.1): force over position";
  figure.printed = "The handle moved slowly in a spring of 800 N/m: points near a line.";
  figure.ours =
      "A sweep of 5 mm/s there and back. The loop's width is the damper, 10 N s/m, and "
      "the steps are those of the encoders.";
  figure.numbers = {{"slope", "N/m", "-k = -800", slope_n_per_m(run.value().run.ticks), ""}};
  figure.command = command_of(options);
  const Sheet sheet{"report_falcon_1", 900, 560, "Force over position in a spring",
                    "k = 800 N/m, c = 10 N s/m, direct coupling, 1 kHz."};
  PlotLines lines;
  lines.add(tick_points(
                run.value().run.ticks, 8, [](const ServoTick& t) { return t.position_mm.x; },
                [](const ServoTick& t) { return t.force_n.x; }),
            "points pt 7 ps 0.25 lc rgb '#0072b2'");
  lines.add("-10 8\n10 -8\n", kAskedStyle, "-k x");
  figure.script = finished(sheet, panel_head({1, 1, 0.09, 0.97, 0.85, 0.12}, 0, "") +
                                      "set key right top samplen 2\nset xlabel 'x / mm'\n"
                                      "set ylabel 'force along x / N'\n" +
                                      lines.text());
  return figure;
}

/// The handle let go at the bottom of its reach, with nobody and no friction.
haptics::HoldTestResult let_go(double damping_n_s_per_m, const Vec3& from_mm) {
  haptics::SpringOptions options;
  options.damping_n_s_per_m = damping_n_s_per_m;
  haptics::SpringScene scene(options);
  haptics::HoldTest test;
  test.device = haptics::frictionless_falcon();
  test.hand = haptics::hand_model(haptics::Hand::none);
  test.servo = haptics::bare_servo(1e-3);
  haptics::HandKey key;
  key.place_mm = from_mm;
  key.holds = false;
  test.plan = {key};
  test.settle_s = 1.0;
  return haptics::run_hold_test(scene, test);
}

ReportFigure release_figure() {
  constexpr std::array<double, 4> kDamping{1.0, 5.0, 10.0, 20.0};
  constexpr std::array<const char*, 4> kStyles{
      "lines lw 2 lc rgb '#d55e00'", "lines lw 2 lc rgb '#e69f00'", "lines lw 2 lc rgb '#0072b2'",
      "lines lw 2 lc rgb '#009e73'"};
  const PanelGrid grid{2, 1, 0.07, 0.98, 0.82, 0.13, 0.08, 0.1};
  ReportFigure figure;
  figure.title = "Falcon report, figure 2: release with four dampers";
  figure.printed =
      "From (-50, 0, -70) mm in a spring of 800 N/m: c = 1 oscillates for long, 5 "
      "less, 10 is near critical, 20 hardly oscillates.";
  figure.ours =
      "The same release, which the simulated arms reach there, beside the axis. What the motors "
      "cannot give (9 N saturate from 11 mm on) "
      "makes the first "
      "swing smaller than the linear law has it: overshoots, of the first 50 mm along x. Critical "
      "for 800 N/m and the measured mass is c = 34 with the device's own 4 N s/m, so that c = 10 "
      "is "
      "not near it. The report's Falcon has dry friction as well, which this one has not.";
  PlotLines x;
  PlotLines z;
  for (std::size_t n = 0; n < kDamping.size(); ++n) {
    const auto run = let_go(kDamping[n], {-50.0, 0.0, -70.0});
    const std::string title = "c = " + cli::number(kDamping[n]);
    std::string along_x;
    std::string along_z;
    double most = 0.0;
    for (std::size_t i = 0; i < run.true_position_mm.size() && i < 1200; ++i) {
      const Vec3& p = run.true_position_mm[i];
      most = std::max(most, p.x);
      if (i % 3 != 0) continue;
      along_x += point_text(1e-3 * static_cast<double>(i), p.x);
      along_z += point_text(1e-3 * static_cast<double>(i), p.z);
    }
    x.add(along_x, kStyles[n], title);
    z.add(along_z, kStyles[n], title);
    figure.numbers.push_back(
        {"overshoot with " + title + " N s/m", "share of 50 mm", "", most / 50.0, ""});
  }
  const Sheet sheet{"report_falcon_2", 1280, 520, "The handle let go in a spring of 800 N/m",
                    "From (-50, 0, -70) mm, nobody holding it, without dry friction."};
  figure.script = finished(
      sheet, "set xlabel 'time / s'\nset xrange [0:1.2]\nset key right bottom samplen 2\n" +
                 panel_head(grid, 0, "x / mm") + x.text() + panel_head(grid, 1, "z / mm") +
                 z.text());
  return figure;
}

Result<ReportFigure> oscillation_figure(const Progress& progress) {
  LabOptions options;
  options.scene = "free";
  options.coupling = 0;
  options.is_frictionless = true;
  const auto run = run_scene(options, progress);
  if (!run) return run.error();
  std::vector<double> x;
  for (const ServoTick& tick : run.value().run.ticks) x.push_back(tick.position_mm.x);
  const double period_s = 1.0 / options.rate_hz;
  const auto found = haptics::estimate_free_oscillation(x, period_s, kSpringNPerM,
                                                        options.delay_ticks * period_s, 0.5);
  ReportFigure figure;
  figure.title = "Falcon report, figure 3 and (3.2) to (3.5): free oscillation";
  figure.printed = "A decaying oscillation at k = 800 N/m and what its peaks say.";
  figure.ours =
      "The simulated handle has the mass that the report found, and a damping such that "
      "the loop decays as it measured: the numbers close the circle.";
  figure.numbers = {
      {"logarithmic decrement (3.2)", "", "0.455 (2 pi zeta)", found.decrement, ""},
      {"damping ratio (3.3)", "", "0.0724", found.damping_ratio_as_printed, ""},
      {"damping ratio, exact", "", "", found.damping_ratio,
       "(3.3) is delta / 2 pi; exact is delta / sqrt(4 pi^2 + delta^2), 0.26 % less"},
      {"omega (3.4)", "rad/s", "41.75", found.omega_rad_per_s,
       "the swing's own frequency, which is sqrt(1 - zeta^2) of the undamped one"},
      {"mass (3.5)", "kg", "0.4589", found.mass_kg_as_printed, ""},
      {"mass, exact", "kg", "", found.mass_kg,
       "(3.5) takes the swing's frequency for the undamped one"},
      {"damping of the swing", "N s/m", "2.77 (2 zeta m omega)", found.loop_damping_n_s_per_m, ""},
      {"damping of the device", "N s/m", "", found.device_damping_n_s_per_m,
       "the swing's and K (T / 2 + t_d), which holding a force for a tick and a tick of delay take "
       "from it; the report takes the swing's for the device's"}};
  figure.command = command_of(options);
  const Sheet sheet{"report_falcon_3", 1000, 520, "Free oscillation",
                    "Held 9 mm off, and let go; k = 800 N/m, no damper."};
  PlotLines lines;
  lines.add(tick_points(run.value().run.ticks, 3, time_of,
                        [](const ServoTick& t) { return t.position_mm.x; }),
            kMotionTrace);
  figure.script = finished(sheet, panel_head({1, 1, 0.08, 0.98, 0.85, 0.13}, 0, "") +
                                      "set xrange [1.3:3.8]\nset xlabel 'time / s'\n"
                                      "set ylabel 'x / mm'\n" +
                                      lines.text());
  return figure;
}

}  // namespace

Result<ReportFigures> mechanics_figures(const Progress& progress) {
  ReportFigures figures;
  for (const auto part : {reach_figure, spring_figure, oscillation_figure}) {
    auto figure = part(progress);
    if (!figure) return figure.error();
    figures.push_back(std::move(figure).value());
    // In the order of the report.
    if (figures.size() == 2) figures.push_back(release_figure());
  }
  return figures;
}

}  // namespace argil::evaluation
