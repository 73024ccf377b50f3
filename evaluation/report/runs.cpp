// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/runs.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "common/hand_option.h"
#include "common/output.h"

namespace argil::evaluation {

using cli::lab::LabOptions;

Result<SceneRun> run_scene(const LabOptions& options, const Progress& progress) {
  const auto& kinds = cli::lab::scene_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const auto& one) { return one.name == options.scene; });
  assert(kind != kinds.end());
  auto scene = kind->make(options, progress);
  if (!scene) return scene.error();
  SceneRun made{options, std::move(scene).value(), {}};
  auto run = cli::lab::run_lab(options, made.scene, nullptr, progress);
  if (!run) return run.error();
  made.run = std::move(run).value();
  return made;
}

std::string command_of(const LabOptions& options) {
  std::string text = "argil lab " + options.scene;
  if (options.coupling == 0) text += " --coupling direct";
  if (options.hand != LabOptions().hand) {
    text += std::string(" --hand ") + haptics::hand_model(cli::kHands[options.hand]).name;
  }
  if (options.feel.damping == 1) text += " --damping adaptive";
  if (options.is_frictionless) text += " --frictionless";
  for (const auto& [name, value] : options.settings) {
    text += " --set " + name + "=" + cli::number(value);
  }
  return text + " --plot run.svg";
}

std::string tick_points(const std::vector<haptics::ServoTick>& ticks, std::size_t stride,
                        const TickValue& x, const TickValue& y) {
  assert(stride > 0);
  std::string points;
  std::string last;
  for (std::size_t n = 0; n < ticks.size(); n += stride) {
    if (!ticks[n].is_ready) continue;
    std::string point = point_text(x(ticks[n]), y(ticks[n]));
    if (point == last) continue;  // a handle that rests
    points += point;
    last = std::move(point);
  }
  return points;
}

}  // namespace argil::evaluation
