// SPDX-License-Identifier: GPL-3.0-or-later
#include "rig/rig_watch.h"

#include <cassert>
#include <chrono>
#include <thread>

namespace argil::haptics {

void RigWatch::stop_recording() noexcept {
  recorder_.store(nullptr);
  // A tick that is running may still use the ring; the one after it sees that there is none, since
  // all four accesses are sequentially consistent.
  const std::uint64_t done = ticks_done_.load();
  while (ticks_done_.load() == done) {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

/// Numbers ticks from 1 from where the recorder's ring was put in.
void RigWatch::record_tick(const ServoTick& tick) noexcept {
  ServoTickRing* const ring = recorder_.load();
  if (ring != recording_) recorded_before_ = tick.number - 1;
  recording_ = ring;
  assert(tick.number > recorded_before_ || ring == nullptr);
  if (ring != nullptr) {
    ServoTick numbered = tick;
    numbered.number -= recorded_before_;
    ring->push(numbered);
  }
  ticks_done_.store(tick.number);
}

/// Collects ticks into a point, and ends it every 10 ms.
void RigWatch::plot(const ServoTick& tick) noexcept {
  if (tick.number == 1) point_began_s_ = tick.time_s;
  if (length(tick.force_n) >= length(point_.force_n)) point_.force_n = tick.force_n;
  ++ticks_in_point_;
  const double lasted_s = tick.time_s - point_began_s_;
  is_due_ = tick.number == 1 || lasted_s >= kEveryS || lasted_s < 0.0;
  if (!is_due_) return;
  point_.time_s = tick.time_s;
  point_.position_mm = tick.position_mm;
  point_.rate_hz = lasted_s > 0.0 ? ticks_in_point_ / lasted_s : 0.0;
  points_.push(point_);
  point_ = {};
  ticks_in_point_ = 0;
  point_began_s_ = tick.time_s;
}

void RigWatch::after_tick(const ServoTick& tick) {
  record_tick(tick);
  plot(tick);
  tick_ = tick;
}

void RigWatch::after_tick_of(const ServoRun& run) {
  if (!is_due_) return;
  RigSnapshot& snapshot = snapshots_.write_slot();
  snapshot.tick = tick_;
  snapshot.placement = scene_.placement();
  snapshot.tool_mm = scene_.tool_mm();
  snapshot.is_clutched = scene_.is_clutched();
  if (guided_ != nullptr) snapshot.guidance = guided_->guidance();
  snapshot.late_ticks = run.late_ticks;
  snapshot.skipped_ticks = run.skipped_ticks;
  snapshot.faults = run.faults;
  snapshot.lateness = run.lateness;
  snapshot.window_age = run.window_age;
  snapshot.dropped_samples = samples_.dropped();
  snapshots_.publish();
}

}  // namespace argil::haptics
