// SPDX-License-Identifier: GPL-3.0-or-later
// The Falcon report, section 4.1 and 4.2: direct and indirect coupling in the same scenes.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "chart/chart.h"
#include "common/hand_option.h"
#include "common/output.h"
#include "report/parts.h"
#include "report/runs.h"
#include "stability/verdict_look.h"

namespace argil::evaluation {
namespace {

using cli::lab::LabOptions;

constexpr std::array kCoupledScenes{"spring", "wall-rigid", "wall-linear", "wall-nonlinear",
                                    "sphere", "cylinder",   "pebbles",     "sine-z",
                                    "slider", "click"};

/// A hold in a scene: by whom, on which device, and how it went.
struct CoupledHold {
  std::size_t scene = 0;
  std::size_t hand = 0;
  bool is_frictionless = false;
  haptics::HoldJudgement found;
  double step_n = 0.0;  ///< the largest of the force, in one tick
};
using CoupledHolds = std::vector<CoupledHold>;

/// Of the force the device was given.
double largest_step_n(const std::vector<haptics::ServoTick>& ticks) {
  double largest_n = 0.0;
  for (std::size_t n = 1; n < ticks.size(); ++n) {
    largest_n = std::max(largest_n, length(ticks[n].force_n - ticks[n - 1].force_n));
  }
  return largest_n;
}

Result<CoupledHolds> hold_all(std::size_t coupling, std::size_t first_hand,
                              const Progress& progress) {
  CoupledHolds holds;
  for (std::size_t scene = 0; scene < kCoupledScenes.size(); ++scene) {
    for (const bool is_frictionless : {false, true}) {
      for (std::size_t hand = first_hand; hand < cli::kHands.size(); ++hand) {
        LabOptions options;
        options.scene = kCoupledScenes[scene];
        options.coupling = coupling;
        options.hand = hand;
        options.is_frictionless = is_frictionless;
        const auto run = run_scene(options, progress);
        if (!run) return run.error();
        holds.push_back({scene, hand, is_frictionless, run.value().run.judgement,
                         largest_step_n(run.value().run.ticks)});
      }
    }
  }
  return holds;
}

/// Scenes in which every hand is quiet.
double quiet_scenes(const CoupledHolds& holds, bool is_frictionless) {
  std::array<bool, kCoupledScenes.size()> vibrates{};
  for (const CoupledHold& hold : holds) {
    if (hold.is_frictionless != is_frictionless) continue;
    if (hold.found.verdict != haptics::Verdict::quiet) vibrates[hold.scene] = true;
  }
  return static_cast<double>(std::count(vibrates.begin(), vibrates.end(), false));
}

/// The largest step of any hand in a scene.
double worst_step_n(const CoupledHolds& holds, std::size_t scene) {
  double worst_n = 0.0;
  for (const CoupledHold& hold : holds) {
    if (hold.scene == scene) worst_n = std::max(worst_n, hold.step_n);
  }
  return worst_n;
}

std::string tics_text() {
  std::string text;
  for (std::size_t n = 0; n < kCoupledScenes.size(); ++n) {
    text += (n == 0 ? "'" : ",'") + std::string(kCoupledScenes[n]) + "' " + std::to_string(n);
  }
  return "set xtics (" + text + ") rotate by -30 font ',10'\n";
}

/// Rows of the maps from the top: hands with friction, and below them without.
double map_row(const CoupledHold& hold) {
  const auto hands = static_cast<double>(cli::kHands.size());
  return (hold.is_frictionless ? hands : 2.0 * hands + 0.4) - 1.0 - static_cast<double>(hold.hand);
}

std::string hand_tics() {
  std::string text;
  for (const bool is_frictionless : {false, true}) {
    for (std::size_t hand = 0; hand < cli::kHands.size(); ++hand) {
      text += (text.empty() ? "'" : ",'") +
              std::string(haptics::hand_model(cli::kHands[hand]).name) +
              (is_frictionless ? ", no friction' " : "' ") +
              cli::number(map_row({0, hand, is_frictionless, {}, 0.0}));
    }
  }
  return "set ytics (" + text + ") font ',11'\n";
}

/// A box for each hold, coloured by its verdict, with the swing where it cycles and the force where
/// it buzzes.
std::string verdict_map(const CoupledHolds& holds) {
  PlotLines lines;
  for (const VerdictLook& look : kVerdictLooks) {
    std::string boxes;
    for (const CoupledHold& hold : holds) {
      if (hold.found.verdict != look.verdict) continue;
      const auto x = static_cast<double>(hold.scene);
      const double y = map_row(hold);
      for (const double value : {x, y, x - 0.46, x + 0.46, y - 0.44, y + 0.44}) {
        boxes += cli::number(value) + " ";
      }
      boxes.back() = '\n';
    }
    lines.add(boxes, std::string("boxxyerror ") + look.style);
  }
  std::string words;
  for (const CoupledHold& hold : holds) {
    if (hold.found.verdict == haptics::Verdict::quiet) continue;
    const bool cycles = hold.found.verdict == haptics::Verdict::limit_cycle;
    char text[32];
    std::snprintf(text, sizeof text, "%.1f",
                  cycles ? hold.found.position_pp_mm : hold.found.force_pp_n);
    words += point_text(static_cast<double>(hold.scene), map_row(hold));
    words.back() = ' ';
    words += text;
    words += "\n";
  }
  lines.add(words, "labels font ',9' tc rgb '#222222'");
  return lines.text();
}

using BothCouplings = std::array<CoupledHolds, 2>;

std::string step_panel(const BothCouplings& found) {
  constexpr std::array<const char*, 2> kStyles{"points pt 7 ps 1.2 lc rgb '#d55e00'",
                                               "points pt 9 ps 1.2 lc rgb '#0072b2'"};
  constexpr std::array<const char*, 2> kNames{"direct (4.1)", "indirect (4.2)"};
  PlotLines lines;
  for (std::size_t coupling = 0; coupling < 2; ++coupling) {
    std::string points;
    for (std::size_t n = 0; n < kCoupledScenes.size(); ++n) {
      points += point_text(static_cast<double>(n), worst_step_n(found[coupling], n));
    }
    lines.add(points, kStyles[coupling], kNames[coupling]);
  }
  return lines.text();
}

Script coupling_script(const BothCouplings& found) {
  const Sheet sheet{"report_falcon_coupling", 1280, 880, "The same scenes through both couplings",
                    "A tap, perhaps a slide, and a hold, 1 kHz. In a box: mm of swing where it "
                    "cycles, N of chatter where it buzzes."};
  const PanelGrid maps{2, 1, 0.105, 0.985, 0.86, 0.47, 0.02, 0.1};
  const PanelGrid steps{1, 1, 0.105, 0.985, 0.36, 0.1};
  KeyStrip key(0.045, 3);
  for (const VerdictLook& look : kVerdictLooks) {
    key.add(std::string("boxes ") + look.style, look.title);
  }
  return finished(
      sheet, tics_text() + "unset key\nset xrange [-0.6:9.6]\nset yrange [-0.6:8]\n" + hand_tics() +
                 panel_head(maps, 0, "direct (4.1)") + verdict_map(found[0]) + "unset ytics\n" +
                 panel_head(maps, 1, "indirect (4.2)") + verdict_map(found[1]) +
                 "set xtics norotate\nset ytics nomirror autofreq\nset key right top samplen 1\n"
                 "set logscale y\nset format y '%g'\nset yrange [5e-2:4]\n" +
                 panel_head(steps, 0, "largest step of the force in a tick, worst hand / N") +
                 step_panel(found) + key.text());
}

}  // namespace

Result<ReportFigure> coupling_figure(bool quick, const Progress& progress) {
  BothCouplings found;
  for (std::size_t coupling = 0; coupling < 2; ++coupling) {
    auto holds = hold_all(coupling, quick ? cli::kHands.size() - 2 : 0, progress);
    if (!holds) return holds.error();
    found[coupling] = std::move(holds).value();
  }
  ReportFigure figure;
  figure.title = "Falcon report, sections 4.1 and 4.2: direct and indirect coupling";
  figure.printed =
      "Direct coupling is simple and oscillates where a force is sharp, indirect "
      "coupling is smoother and takes more tuning; not measured there.";
  figure.ours = "Every scene of part 1 with " +
                std::string(quick ? "the two calmest hands" : "four hands from push to firm") +
                ", each on a Falcon with its dry friction and on one without. Through the "
                "coupling, whose spring the governor bounds, none vibrates, and the force takes "
                "smaller steps in every scene. Directly friction hides much of what vibrates.";
  const std::string all = " of " + std::to_string(kCoupledScenes.size());
  const char* why =
      "(4.2) as printed pushes the handle away from the proxy; here it draws it there";
  figure.numbers = {
      {"scenes that are quiet, direct", all, "", quiet_scenes(found[0], false), ""},
      {"scenes that are quiet, direct, no friction", all, "", quiet_scenes(found[0], true), ""},
      {"scenes that are quiet, indirect", all, "", quiet_scenes(found[1], false), why},
      {"scenes that are quiet, indirect, no friction", all, "", quiet_scenes(found[1], true), ""}};
  double least_ratio = std::numeric_limits<double>::infinity();
  double most_ratio = 0.0;
  for (std::size_t n = 0; n < kCoupledScenes.size(); ++n) {
    const double ratio = worst_step_n(found[0], n) / worst_step_n(found[1], n);
    least_ratio = std::min(least_ratio, ratio);
    most_ratio = std::max(most_ratio, ratio);
  }
  figure.numbers.push_back({"step of the force, direct over indirect, least", "times",
                            "indirect is smoother", least_ratio, ""});
  figure.numbers.push_back({"step of the force, direct over indirect, most", "times", "",
                            most_ratio, "the gate cuts what is direct to 2 N a tick"});
  figure.command = "argil lab click --coupling direct --hand push --frictionless --plot run.svg";
  figure.script = coupling_script(found);
  return figure;
}

}  // namespace argil::evaluation
