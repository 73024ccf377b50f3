// SPDX-License-Identifier: GPL-3.0-or-later
// The Falcon report, section 4.1 and 4.2: direct and indirect coupling in the same scenes.
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chart/chart.h"
#include "common/hand_option.h"
#include "report/parts.h"
#include "report/runs.h"

namespace argil::evaluation {
namespace {

using cli::lab::LabOptions;

constexpr std::array kCoupledScenes{"spring", "wall-rigid", "wall-linear", "wall-nonlinear",
                                    "sphere", "cylinder",   "pebbles",     "sine-z",
                                    "slider", "click"};

/// The worst of the hands in a scene.
struct HeldScene {
  bool is_quiet = true;
  double swing_mm = 0.0;
  /// Of the force, in one tick from the first touch on.
  double step_n = 0.0;
};

/// Of the force the device was given.
double largest_step_n(const std::vector<haptics::ServoTick>& ticks) {
  double largest_n = 0.0;
  for (std::size_t n = 1; n < ticks.size(); ++n) {
    largest_n = std::max(largest_n, length(ticks[n].force_n - ticks[n - 1].force_n));
  }
  return largest_n;
}

Result<HeldScene> held(const char* scene, std::size_t coupling, std::size_t first_hand,
                       const Progress& progress) {
  HeldScene worst;
  for (std::size_t hand = first_hand; hand < cli::kHands.size(); ++hand) {
    LabOptions options;
    options.scene = scene;
    options.coupling = coupling;
    options.hand = hand;
    const auto run = run_scene(options, progress);
    if (!run) return run.error();
    const auto& found = run.value().run.judgement;
    worst.is_quiet = worst.is_quiet && found.verdict == haptics::Verdict::quiet;
    worst.swing_mm = std::max(worst.swing_mm, found.position_pp_mm);
    worst.step_n = std::max(worst.step_n, largest_step_n(run.value().run.ticks));
  }
  return worst;
}

std::string tics_text() {
  std::string text;
  for (std::size_t n = 0; n < kCoupledScenes.size(); ++n) {
    text += (n == 0 ? "'" : ",'") + std::string(kCoupledScenes[n]) + "' " + std::to_string(n);
  }
  return "set xtics (" + text + ") rotate by -30 font ',10'\n";
}

using HeldBoth = std::array<std::vector<HeldScene>, 2>;

std::string held_panel(const HeldBoth& found, double HeldScene::*what,
                       std::optional<double> limit) {
  constexpr std::array<const char*, 2> kStyles{"points pt 7 ps 1.4 lc rgb '#d55e00'",
                                               "points pt 9 ps 1.4 lc rgb '#0072b2'"};
  constexpr std::array<const char*, 2> kNames{"direct (4.1)", "indirect (4.2)"};
  // Below this nothing can be told from nothing on axes of powers.
  constexpr double kLeast = 1e-3;
  PlotLines lines;
  for (std::size_t coupling = 0; coupling < 2; ++coupling) {
    std::string points;
    for (std::size_t n = 0; n < kCoupledScenes.size(); ++n) {
      points += point_text(static_cast<double>(n), std::max(kLeast, found[coupling][n].*what));
    }
    lines.add(points, kStyles[coupling], kNames[coupling]);
  }
  if (limit) {
    lines.add(point_text(-0.5, *limit) + point_text(kCoupledScenes.size() - 0.5, *limit),
              kAskedStyle, "counts as vibration");
  }
  return lines.text();
}

}  // namespace

Result<ReportFigure> coupling_figure(bool quick, const Progress& progress) {
  HeldBoth found;
  std::array<int, 2> quiet{};
  for (std::size_t coupling = 0; coupling < 2; ++coupling) {
    for (const char* scene : kCoupledScenes) {
      const auto one = held(scene, coupling, quick ? cli::kHands.size() - 2 : 0, progress);
      if (!one) return one.error();
      quiet[coupling] += one.value().is_quiet ? 1 : 0;
      found[coupling].push_back(one.value());
    }
  }
  ReportFigure figure;
  figure.title = "Falcon report, sections 4.1 and 4.2: direct and indirect coupling";
  figure.printed =
      "Direct coupling is simple and oscillates where a force is sharp, indirect "
      "coupling is smoother and takes more tuning; not measured there.";
  figure.ours = "Every scene of part 1 with " +
                std::string(quick ? "the two calmest hands" : "four hands from push to firm") +
                ", the worst of them. Through the coupling, whose spring the governor bounds, the "
                "rigid wall that vibrates directly is quiet, and the force takes smaller steps in "
                "every scene.";
  const std::string all = " of " + std::to_string(kCoupledScenes.size());
  figure.numbers = {
      {"scenes that are quiet, direct", all, "", static_cast<double>(quiet[0]), ""},
      {"scenes that are quiet, indirect", all, "", static_cast<double>(quiet[1]),
       "(4.2) as printed pushes the handle away from the proxy; here it draws it there"}};
  double least_ratio = std::numeric_limits<double>::infinity();
  double most_ratio = 0.0;
  for (std::size_t n = 0; n < kCoupledScenes.size(); ++n) {
    const double ratio = found[0][n].step_n / found[1][n].step_n;
    least_ratio = std::min(least_ratio, ratio);
    most_ratio = std::max(most_ratio, ratio);
  }
  figure.numbers.push_back({"step of the force, direct over indirect, least", "times",
                            "indirect is smoother", least_ratio, ""});
  figure.numbers.push_back({"step of the force, direct over indirect, most", "times", "",
                            most_ratio, "the gate cuts what is direct to 2 N a tick"});
  figure.command = "argil lab wall-rigid --coupling direct --hand push";
  const Sheet sheet{"report_falcon_coupling", 1280, 600, "The same scenes through both couplings",
                    "A tap, perhaps a slide, and a hold; the worst hand, 1 kHz. The gate lets 2 N "
                    "a tick through."};
  const PanelGrid grid{2, 1, 0.06, 0.96, 0.82, 0.17, 0.09, 0.1};
  figure.script = finished(
      sheet, tics_text() + "set logscale y\nset xrange [-0.5:9.5]\nset format y '%g'\n" +
                 panel_head(grid, 0, "swing of the handle / mm") + "set yrange [7e-4:40]\n" +
                 "set key right top samplen 1\n" +
                 held_panel(found, &HeldScene::swing_mm, haptics::kLimitCycleMm) +
                 panel_head(grid, 1, "largest step of the force in a tick / N") +
                 "unset key\nset yrange [7e-3:4]\n" + held_panel(found, &HeldScene::step_n, {}));
  return figure;
}

}  // namespace argil::evaluation
