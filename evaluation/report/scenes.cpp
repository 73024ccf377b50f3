// SPDX-License-Identifier: GPL-3.0-or-later
// Figures 4 to 11 of the Falcon report: walls, round bodies, rough walls and the slider.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "argil/haptics/scene/scene_round.h"

#include "common/hand_option.h"
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
  /// Steps of the tics along x, y and z of a body's picture, so that each axis has some, and none
  /// where two of them meet.
  std::array<int, 3> tics{20, 20, 20};
  /// Of its view: less for a body that fills its box.
  double zoom = 1.5;
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
      "k = 800 N/m and c = 10 N s/m, as chosen here. Force over position is a line, with the "
      "damper "
      "beside it while the handle moves."},
     {"wall-nonlinear", "report_falcon_6", "A nonlinear wall",
      "Falcon report, figure 6 and (3.8): a nonlinear wall",
      "The square of the depth: soft at first, like a balloon; vibrations nearly gone.",
      "Squares of depth and speed, k = 1e5 N/m^2 and c = 10 N s^2/m^2. It is soft where it is "
      "touched, and stiffer the deeper it "
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

constexpr std::array<SceneWords, 6> kBodies{
    {{"sphere",
      "report_falcon_7",
      "A slide over a ball of 50 mm",
      "Falcon report, figure 7 and (3.9): a sphere",
      "k = 3000 N/m, c = 50 N s/m: the path of the handle respects the ball.",
      "The same through the coupling. Directly 3000 N/m and 50 N s/m are as much as a sampled "
      "Falcon holds: quiet where it has friction, a buzz where it has none, and several newtons "
      "of it with velocities that are not filtered (docs/stability.md).",
      {20, 20, 20},
      1.05},
     {"cylinder", "report_falcon_8", "A slide over a cylinder of 30 mm",
      "Falcon report, figure 8 and (3.10) to (3.14): a cylinder",
      "R = 30 mm, H = 100 mm about z: the handle stays outside.",
      "Along an arc that rises. As printed, (3.12) and (3.13) have two signs that cancel; the "
      "force "
      "is outward."},
     {"pebbles",
      "report_falcon_9",
      "A slide over pebbles",
      "Falcon report, figure 9 and (3.15): a wall of spheres",
      "A grid of small spheres feels like pebbles; its cost grows with their number.",
      "Only the spheres near the handle are asked, at most 9 of any number.",
      {10, 5, 5}},
     {"sine-normal",
      "report_falcon_10",
      "A slide over a sine wall",
      "Falcon report, figure 10 and (3.16) to (3.22): a sine wall",
      "A picture of the wall; pushed along z, with the unit normal as an improvement.",
      "The hand slides along it with the force of (3.22), along the unit normal.",
      {20, 20, 5}},
     {"slider",
      "report_falcon_11",
      "A slide in a groove of the slider",
      "Falcon report, figure 11 and (3.23) to (3.27): the slider",
      "The handle stays in the groove and moves along x.",
      "The hand is led along a groove; it stays in it.",
      {20, 20, 5}},
     {"click",
      "report_falcon_click",
      "Over the ball in a groove, and back onto it",
      "Falcon report, section 3.7.2 and (3.28): the click",
      "A ball of 15 mm and 8000 N/m in the slider is felt as a click; no picture and no "
      "measurement.",
      "The slider is put 46 mm lower than printed, which would bury the ball. The hand slides "
      "along "
      "the groove, over the ball and on, and comes back to rest on it.",
      {10, 10, 10}}}};

/// Directly held by the four hands.
struct DirectHolds {
  int vibrating = 0;     ///< hands that cycle or buzz
  double most_mm = 0.0;  ///< the largest swing
  double most_n = 0.0;   ///< and chatter
};

Result<DirectHolds> direct_holds(const char* scene, bool is_frictionless,
                                 const Progress& progress) {
  DirectHolds holds;
  for (std::size_t hand = 0; hand < cli::kHands.size(); ++hand) {
    LabOptions options;
    options.scene = scene;
    options.coupling = 0;
    options.hand = hand;
    options.is_frictionless = is_frictionless;
    const auto run = run_scene(options, progress);
    if (!run) return run.error();
    const auto& found = run.value().run.judgement;
    holds.vibrating += found.verdict == haptics::Verdict::quiet ? 0 : 1;
    holds.most_mm = std::max(holds.most_mm, found.position_pp_mm);
    holds.most_n = std::max(holds.most_n, found.force_pp_n);
  }
  return holds;
}

/// What the same hold is without the coupling, with friction and without.
Result<void> add_direct_holds(const char* scene, ReportFigure& figure, const Progress& progress) {
  for (const bool is_frictionless : {false, true}) {
    const auto holds = direct_holds(scene, is_frictionless, progress);
    if (!holds) return holds.error();
    const std::string how = is_frictionless ? "directly, no friction" : "directly";
    figure.numbers.push_back({"hands that vibrate " + how, " of 4", "",
                              static_cast<double>(holds.value().vibrating), ""});
    figure.numbers.push_back(
        {"largest swing " + how, "mm", "", at_least_rounding(holds.value().most_mm), ""});
    figure.numbers.push_back(
        {"largest chatter " + how, "N", "", at_least_rounding(holds.value().most_n), ""});
  }
  return {};
}

/// (3.28) where the report gives its numbers.
double click_force_n() {
  const haptics::SphereScene ball(haptics::SphereOptions{{0.0, -20.0, -20.0}, 15.0, 8000.0, 0.0});
  haptics::HandleState handle;
  handle.position_mm = {0.0, -20.0, -6.0};  // 1 mm into it
  return length(ball.force_at(handle).force_n);
}

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
  const std::string scene = words.scene;
  if (scene == "sphere" || scene == "click") {
    if (auto added = add_direct_holds(words.scene, figure, progress); !added) return added.error();
  }
  if (scene == "click") {
    figure.numbers.push_back({"force 1 mm into the ball (3.28)", "N", "8", click_force_n(), ""});
  }
  const Sheet sheet{words.sheet, 1280, 960, words.title,
                    "The arm presses and slides; indirect coupling, 1 kHz."};
  const PanelGrid grid{1, 1, 0.07, 0.98, 0.24, 0.07};
  const auto step = [&](std::size_t axis) { return std::to_string(words.tics[axis]) + "\n"; };
  figure.script = finished(
      sheet,
      "$path << EOD\n" + path +
          "EOD\nset origin 0.06,0.25\nset size 0.88,0.7\nset xlabel 'x / mm'\nset ylabel 'y / mm'\n"
          "set zlabel 'z / mm' offset -2,0\nset view equal xyz\nset view 58,32," +
          cli::number(words.zoom) +
          "\nset xyplane relative 0\n"
          "set autoscale fix\nset tics font ',11'\nunset key\nset border 4095 lc rgb '#c0c0c0'\n"
          "set xtics " +
          step(0) + "set ytics " + step(1) + "set ztics " + step(2) +
          "set parametric\nset urange [0:pi]\nset vrange [0:2*pi]\nset isosamples 25,33\n" +
          run.value().scene.object +
          " with lines lw 0.5 lc rgb '#9dbfd8', $path with lines lw 2.4 lc rgb '#c0392b'\n"
          "unset parametric\nunset label 1\nunset label 2\nset border 3 lc rgb '#808080'\n"
          "set autoscale\nset tics font ',12'\nset xtics autofreq\nset ytics autofreq\n" +
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
