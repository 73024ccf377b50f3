// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cassert>
#include <cstdint>

#include "argil/core/spsc_ring.h"
#include "argil/core/tool_sample.h"
#include "argil/core/triple_buffer.h"
#include "argil/haptics/rig/rig.h"
#include "argil/haptics/servo/guided_scene.h"
#include "argil/haptics/servo/servo_run.h"

namespace argil::haptics {

/// What the servo's thread tells the main one after its ticks: a snapshot and a point for the plots
/// every 10 ms, and each tick to the recorder while there is one.
///
/// Threads  Realtime: the observer's calls are the servo's; the rest is for the main thread.
///          Wait-free but for stop_recording, in which the main thread waits for one tick.
class RigWatch final : public ServoObserver {
 public:
  static constexpr double kEveryS = 0.0099;  ///< 10 ms, whatever rounding does to ten ticks

  /// All must outlive it; `guided` may be null.
  RigWatch(const PlacedScene& scene, const ToolSampleRing& samples,
           const GuidedScene* guided = nullptr) noexcept
      : scene_(scene), samples_(samples), guided_(guided) {}

  void after_tick(const ServoTick& tick) override;
  void after_tick_of(const ServoRun& run) override;

  /// Main: ticks go there from now on, numbered from 1.
  void record(ServoTickRing* ring) noexcept {
    assert(ring != nullptr);
    recorder_.store(ring);
  }
  /// Main: ticks go nowhere from now on. Returns when the servo, which must run, no longer uses the
  /// ring.
  void stop_recording() noexcept;

  TripleBuffer<RigSnapshot>& snapshots() noexcept { return snapshots_; }
  SpscRing<RigPoint>& points() noexcept { return points_; }

 private:
  void record_tick(const ServoTick& tick) noexcept;
  void plot(const ServoTick& tick) noexcept;

  const PlacedScene& scene_;
  const ToolSampleRing& samples_;
  const GuidedScene* guided_;
  TripleBuffer<RigSnapshot> snapshots_;
  SpscRing<RigPoint> points_{1024};  ///< 10 s, for a main thread that does not look

  std::atomic<ServoTickRing*> recorder_ = nullptr;
  std::atomic<std::uint64_t> ticks_done_ = 0;  ///< with what they recorded
  ServoTickRing* recording_ = nullptr;         ///< the servo's own, to know when it changes
  std::uint64_t recorded_before_ = 0;          ///< ticks before the recording

  ServoTick tick_;
  RigPoint point_;  ///< the one being made
  int ticks_in_point_ = 0;
  double point_began_s_ = 0.0;
  bool is_due_ = false;  ///< this tick ended a point
};

}  // namespace argil::haptics
