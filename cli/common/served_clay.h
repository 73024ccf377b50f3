// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "argil/core/clay_heartbeat.h"
#include "argil/core/result.h"
#include "argil/engine/clay_thread.h"
#include "argil/engine/clay_worker.h"
#include "argil/haptics/scene/scene.h"
#include "argil/haptics/scene/scene_clay.h"

#include "common/command.h"

namespace argil::cli {

/// How many samples of the tool may wait for the clay.
inline constexpr std::size_t kClayRingSamples = 1024;
/// How often the clay answers on virtual time: what its thread reaches with a tool of some mm.
inline constexpr double kClayStepS = 0.010;

/// A clay behind a servo: in a thread of its own on the machine's clock, stepped between ticks on
/// virtual time, and made to answer as recorded in a replay.
class ServedClay {  // NOLINT(clang-analyzer-optin.performance.Padding): the ring's cache lines
 public:
  /// `clay` must outlive it. `scene.heartbeat` is set here. `after_step`, when given, is called
  /// after each step on the clay's thread, as ClayThread has it.
  ServedClay(Clay& clay, const ClayWorkerOptions& worker, const haptics::ClaySceneOptions& scene,
             std::function<Result<void>()> after_step = {});

  haptics::ClayScene& scene() noexcept { return scene_; }

  /// Virtual time: after a tick. A step is due every 10 ms.
  Result<void> after_tick(double now_s);
  /// Replay: before a tick that felt this window.
  Result<void> answer_as(const haptics::WindowStamp& window);
  /// Real time: from here to `stop` the clay belongs to its own thread.
  Result<void> start();
  /// Ends the thread, when there is one, and the stroke.
  Result<void> stop();

  const ClayWorkerCounts& counts() const noexcept { return worker_.counts(); }
  /// "dabs", "strokes", "windows", "dropped_samples"; with a texture "texture_n", the strongest
  /// that it was.
  Json report() const;

 private:
  ToolSampleRing ring_;
  WindowChannel channel_;
  ClayHeartbeat heartbeat_;
  ClayWorker worker_;
  haptics::ClayScene scene_;
  std::function<Result<void>()> after_step_;
  std::unique_ptr<ClayThread> thread_;
  double next_step_s_ = 0.0;
  std::uint64_t answered_ = 0;
};

}  // namespace argil::cli
