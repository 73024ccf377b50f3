// SPDX-License-Identifier: GPL-3.0-or-later
// Figures 4 to 11 of the Falcon report: walls, round bodies, rough walls and the slider.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "common/output.h"
#include "report/parts.h"
#include "report/runs.h"

namespace argil::evaluation {
namespace {

using cli::lab::LabOptions;
using haptics::ServoTick;

constexpr const char* kSceneTrace = "lines lw 1.4 lc rgb '#0072b2'";
constexpr const char* kSceneForces = "lines lw 1.4 lc rgb '#d55e00'";
constexpr const char* kSceneDots = "points pt 7 ps 0.25 lc rgb '#0072b2'";

double height_of(const ServoTick& tick) { return tick.position_mm.y; }
double upward_of(const ServoTick& tick) { return tick.force_n.y; }
double strength_of(const ServoTick& tick) { return length(tick.force_n); }

/// What a figure says, beside its picture.
struct SceneWords {
  const char* scene;
  const char* sheet;
  const char* title;  ///< of the picture
  const char* figure;
  const char* printed;
  const char* ours;
};

/// 0 for what is a rounding of nothing.
double at_least_rounding(double value) { return value < 1e-9 ? 0.0 : value; }

/// The numbers of a hold that every figure tells.
void add_hold(ReportFigure& figure, const SceneRun& run) {
  const auto& found = run.run.judgement;
  figure.ours += " The hold is " + std::string(haptics::verdict_name(found.verdict)) + ".";
  figure.numbers.push_back(
      {"swing of the handle in the hold", "mm", "", at_least_rounding(found.position_pp_mm), ""});
  figure.numbers.push_back(
      {"chatter of the force in the hold", "N", "", at_least_rounding(found.force_pp_n), ""});
}

ReportFigure begun(const SceneWords& words, const SceneRun& run) {
  ReportFigure figure;
  figure.title = words.figure;
  figure.printed = words.printed;
  figure.ours = words.ours;
  figure.command = command_of(run.options);
  add_hold(figure, run);
  return figure;
}

Result<SceneRun> direct_run(const char* scene, const Progress& progress) {
  LabOptions options;
  options.scene = scene;
  options.coupling = 0;
  return run_scene(options, progress);
}

constexpr std::array<SceneWords, 3> kWalls{
    {{"wall-rigid", "report_falcon_4", "A rigid wall, F = 20 N",
      "Falcon report, figure 4 and (3.6): a rigid wall",
      "20 N as soon as y < -20 mm, none above; strong vibrations, which it puts down to the "
      "motors.",
      "The motors give 9 N and the safety gate 8, so that the step is one of 8 N. The vibration is "
      "the loop's own: a force that switches a tick late puts energy into any device, however good "
      "its motors are."},
     {"wall-linear", "report_falcon_5", "A linear wall",
      "Falcon report, figure 5 and (3.7): a linear wall",
      "A line of force over position; slight oscillations are left. It gives neither k nor c.",
      "k and c as chosen here (argil lab --list). Force over position is a line, with the damper "
      "beside it while the handle moves."},
     {"wall-nonlinear", "report_falcon_6", "A nonlinear wall",
      "Falcon report, figure 6 and (3.8): a nonlinear wall",
      "The square of the depth: soft at first, like a balloon; vibrations nearly gone.",
      "Squares of depth and speed. It is soft where it is touched, and stiffer the deeper it "
      "is pressed."}}};

Result<ReportFigure> wall_figure(const SceneWords& words, const Progress& progress) {
  const auto run = direct_run(words.scene, progress);
  if (!run) return run.error();
  const auto& ticks = run.value().run.ticks;
  PlotLines over_position;
  over_position.add(tick_points(ticks, 1, height_of, upward_of), kSceneDots);
  PlotLines over_time;
  const bool is_rigid = std::string(words.scene) == "wall-rigid";
  over_time.add(tick_points(ticks, is_rigid ? 1 : 2, time_of, is_rigid ? upward_of : height_of),
                is_rigid ? kSceneForces : kSceneTrace);
  ReportFigure figure = begun(words, run.value());
  double most_n = 0.0;
  for (const ServoTick& tick : ticks) most_n = std::max(most_n, tick.force_n.y);
  figure.numbers.push_back({"most force", "N", is_rigid ? "20" : "", most_n,
                            is_rigid ? "more than a Falcon can give; the gate ends at 8 N" : ""});
  const Sheet sheet{words.sheet, 1280, 500, words.title,
                    "The arm taps and presses 3 N; direct coupling, 1 kHz."};
  const PanelGrid grid{2, 1, 0.06, 0.98, 0.82, 0.13, 0.08, 0.1};
  figure.script = finished(
      sheet, panel_head(grid, 0, "force over position / N") + "set xlabel 'y / mm'\n" +
                 over_position.text() +
                 panel_head(grid, 1, is_rigid ? "force over time / N" : "y over time / mm") +
                 "set xlabel 'time / s'\nset xrange " + (is_rigid ? "[0.4:1.2]" : "[0.4:3]") +
                 "\n" + over_time.text());
  return figure;
}

constexpr std::array<SceneWords, 5> kBodies{
    {{"sphere", "report_falcon_7", "A slide over a ball of 50 mm",
      "Falcon report, figure 7 and (3.9): a sphere",
      "k = 3000 N/m, c = 50 N s/m: the path of the handle respects the ball.",
      "The same through the coupling: 3000 N/m and 50 N s/m are more than a sampled Falcon holds, "
      "and directly they buzz by several newtons (docs/equations.md)."},
     {"cylinder", "report_falcon_8", "A slide over a cylinder of 30 mm",
      "Falcon report, figure 8 and (3.10) to (3.14): a cylinder",
      "R = 30 mm, H = 100 mm about z: the handle stays outside.",
      "Along an arc that rises. As printed, (3.12) and (3.13) have two signs that cancel; the "
      "force "
      "is outward."},
     {"pebbles", "report_falcon_9", "A slide over pebbles",
      "Falcon report, figure 9 and (3.15): a wall of spheres",
      "A grid of small spheres feels like pebbles; its cost grows with their number.",
      "Only the spheres near the handle are asked, at most 9 of any number."},
     {"sine-normal", "report_falcon_10", "A slide over a sine wall",
      "Falcon report, figure 10 and (3.16) to (3.22): a sine wall",
      "A picture of the wall; pushed along z, with the unit normal as an improvement.",
      "The hand slides along it with the force of (3.22), along the unit normal."},
     {"slider", "report_falcon_11", "A slide in a groove of the slider",
      "Falcon report, figure 11 and (3.23) to (3.27): the slider",
      "The handle stays in the groove and moves along x.",
      "The hand is led along a groove; it stays in it."}}};

Result<ReportFigure> body_figure(const SceneWords& words, const Progress& progress) {
  LabOptions options;
  options.scene = words.scene;
  const auto run = run_scene(options, progress);
  if (!run) return run.error();
  const auto& ticks = run.value().run.ticks;
  std::string path;
  for (std::size_t n = 0; n < ticks.size(); n += 4) {
    if (!ticks[n].is_ready) continue;
    const Vec3& p = ticks[n].position_mm;
    path += cli::number(p.x) + " " + cli::number(p.y) + " " + cli::number(p.z) + "\n";
  }
  PlotLines forces;
  forces.add(tick_points(ticks, 4, time_of, strength_of), kSceneForces);
  ReportFigure figure = begun(words, run.value());
  const Sheet sheet{words.sheet, 1280, 560, words.title,
                    "The arm presses and slides; indirect coupling, 1 kHz."};
  const PanelGrid grid{1, 1, 0.6, 0.98, 0.8, 0.13};
  figure.script = finished(
      sheet,
      "$path << EOD\n" + path +
          "EOD\nset origin 0.01,0\nset size 0.56,0.92\nset xlabel 'x / mm'\nset ylabel 'y / mm'\n"
          "set zlabel 'z / mm'\nset view equal xyz\nset view 62,38,1.2\nset xyplane relative 0\n"
          "set autoscale fix\nset tics font ',9'\nset ztics 20\nunset key\nset border 4095 lc rgb "
          "'#c0c0c0'\n"
          "set parametric\nset urange [0:pi]\nset vrange [0:2*pi]\nset isosamples 25,33\n" +
          run.value().scene.object +
          " with lines lw 0.5 lc rgb '#9dbfd8', $path with lines lw 2.4 lc rgb '#c0392b'\n"
          "unset parametric\nunset label 1\nunset label 2\nset border 3 lc rgb '#808080'\n"
          "set autoscale\nset tics font ',12'\n" +
          panel_head(grid, 0, "force over time / N") + "set xlabel 'time / s'\nunset ylabel\n" +
          forces.text());
  return figure;
}

}  // namespace

Result<ReportFigures> scene_figures(const Progress& progress) {
  ReportFigures figures;
  for (const SceneWords& words : kWalls) {
    auto figure = wall_figure(words, progress);
    if (!figure) return figure.error();
    figures.push_back(std::move(figure).value());
  }
  for (const SceneWords& words : kBodies) {
    auto figure = body_figure(words, progress);
    if (!figure) return figure.error();
    figures.push_back(std::move(figure).value());
  }
  return figures;
}

}  // namespace argil::evaluation
