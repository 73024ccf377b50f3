// SPDX-License-Identifier: GPL-3.0-or-later
// The Falcon report, sections 3.4.2 and 3.4.3: walls whose damping follows the swing.
#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "common/output.h"
#include "report/parts.h"
#include "report/runs.h"

namespace argil::evaluation {
namespace {

using cli::lab::LabOptions;
using haptics::ServoTick;

/// A wall that a loose hand makes cycle, without a damper of its own.
struct DampedWall {
  const char* scene;
  const char* name;
  double stiffness;
};
constexpr DampedWall kDampedWalls[] = {{"wall-linear", "linear, 8000 N/m", 8000.0},
                                       {"wall-nonlinear", "nonlinear, 1e6 N/m^2", 1e6}};

struct DampedRuns {
  SceneRun fixed;
  SceneRun adaptive;
};

Result<DampedRuns> run_both(const DampedWall& wall, const Progress& progress) {
  LabOptions options;
  options.scene = wall.scene;
  options.settings = {{"k", wall.stiffness}, {"c", 0.0}};
  options.coupling = 0;
  options.hand = 0;
  auto fixed = run_scene(options, progress);
  if (!fixed) return fixed.error();
  options.feel.damping = 1;
  auto adaptive = run_scene(options, progress);
  if (!adaptive) return adaptive.error();
  return DampedRuns{std::move(fixed).value(), std::move(adaptive).value()};
}

std::string motion_panel(const DampedRuns& runs) {
  const auto height = [](const ServoTick& tick) { return tick.position_mm.y; };
  PlotLines lines;
  lines.add(tick_points(runs.fixed.run.ticks, 2, time_of, height), "lines lw 1.2 lc rgb '#d55e00'",
            "fixed, c = 0");
  lines.add(tick_points(runs.adaptive.run.ticks, 2, time_of, height),
            "lines lw 1.6 lc rgb '#0072b2'", "adaptive");
  return "set ylabel 'y / mm'\n" + lines.text();
}

std::string added_panel(const DampedRuns& runs) {
  PlotLines lines;
  lines.add(tick_points(runs.adaptive.run.ticks, 2, time_of,
                        [](const ServoTick& tick) { return tick.added_damping_n_s_per_m; }),
            "lines lw 1.6 lc rgb '#0072b2'");
  return "set ylabel 'added / N s/m'\n" + lines.text();
}

void add_numbers(const DampedWall& wall, const DampedRuns& runs, ReportFigure& figure) {
  const std::string name = wall.name;
  double most = 0.0;
  for (const ServoTick& tick : runs.adaptive.run.ticks) {
    most = std::max(most, tick.added_damping_n_s_per_m);
  }
  figure.numbers.push_back(
      {"swing, " + name + ", fixed", "mm", "", runs.fixed.run.judgement.position_pp_mm, ""});
  const auto& adapted = runs.adaptive.run.judgement;
  figure.numbers.push_back({"swing, " + name + ", adaptive", "mm", "",
                            adapted.position_pp_mm < 1e-9 ? 0.0 : adapted.position_pp_mm, ""});
  figure.numbers.push_back(
      {"most added, " + name, "N s/m", "", most, "bounded by what velocities so late can render"});
  figure.ours += " " + std::string(haptics::verdict_name(runs.fixed.run.judgement.verdict)) +
                 " with the first and " + haptics::verdict_name(adapted.verdict) +
                 " with the second (" + name + ").";
}

}  // namespace

Result<ReportFigure> damping_figure(const Progress& progress) {
  ReportFigure figure;
  figure.title = "Falcon report, sections 3.4.2 and 3.4.3: dynamic damping";
  figure.printed =
      "The damping of the walls of figures 5 and 6 was adjusted while they ran, by the logarithmic "
      "decrement of consecutive peaks. It gives no rule and no number; slight oscillations are "
      "left "
      "at the linear wall, nearly none at the nonlinear one.";
  figure.ours =
      "Two walls without a damper of their own, pressed with 3 N that nothing damps, directly: "
      "with "
      "fixed damping, and with a rule of our own for what the swing lacks (docs/stability.md).";
  const Sheet sheet{"report_falcon_damping", 1280, 760, "Damping that follows the swing",
                    "A tap and a press of 3 N by the push hand, c = 0, direct coupling, 1 kHz."};
  const PanelGrid grid{2, 2, 0.07, 0.985, 0.86, 0.09, 0.08, 0.15};
  std::string text = "set xrange [0.4:2.4]\nset xlabel 'time / s'\nset key right top samplen 2\n";
  std::size_t panel = 0;
  for (const DampedWall& wall : kDampedWalls) {
    const auto runs = run_both(wall, progress);
    if (!runs) return runs.error();
    add_numbers(wall, runs.value(), figure);
    if (panel == 0) figure.command = command_of(runs.value().adaptive.options);
    text += panel_head(grid, panel, wall.name) + motion_panel(runs.value());
    text += panel_head(grid, panel + 1, std::string(wall.name) + ": the damper") +
            added_panel(runs.value());
    panel += 2;
  }
  figure.script = finished(sheet, text);
  return figure;
}

}  // namespace argil::evaluation
