// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "argil/haptics/servo/histogram.h"
#include "argil/haptics/servo/servo.h"

namespace argil::haptics {

/// What time it is, and waiting for a time: real or virtual.
///
/// Threads  one, the servo's.
class ServoClock {
 public:
  virtual ~ServoClock() = default;
  ServoClock() = default;
  ServoClock(const ServoClock&) = delete;
  ServoClock& operator=(const ServoClock&) = delete;
  /// Seconds since whatever the clock began at.
  virtual double now_s() noexcept = 0;
  /// Returns when that time has come; at once when it is past.
  virtual void wait_until(double time_s) noexcept = 0;
};

/// Time that passes only by waiting for it: for tests and the lab, as fast as the machine can.
class VirtualClock final : public ServoClock {
 public:
  double now_s() noexcept override { return now_s_; }
  void wait_until(double time_s) noexcept override {
    if (time_s > now_s_) now_s_ = time_s;
  }
  /// Forwards or back: the fault of a clock.
  void jump(double by_s) noexcept { now_s_ += by_s; }

 private:
  double now_s_ = 0.0;
};

/// The machine's monotonic clock, 0 when it was made; waiting sleeps.
class SteadyClock final : public ServoClock {
 public:
  SteadyClock() noexcept;
  double now_s() noexcept override;
  void wait_until(double time_s) noexcept override;

 private:
  double start_s_;
};

/// What a run saw. On virtual time lateness and cost are 0. Histograms are in us.
struct ServoRun {
  std::uint64_t ticks = 0;
  /// Began more than half a period after they were due.
  std::uint64_t late_ticks = 0;
  /// Left out, to catch up.
  std::uint64_t skipped_ticks = 0;
  /// Of all ticks.
  std::uint32_t faults = kServoSound;
  /// From the beginning of a tick to that of the next.
  Histogram period;
  /// From when a tick was due to when it began.
  Histogram lateness;
  /// From a tick's beginning to its end, by the clock.
  Histogram cost;
  /// Of the clay that ticks felt: WindowStamp::age_s, where it is known. In virtual time too.
  Histogram window_age;
};

/// Sees every tick on the servo's own thread, and must be as fast as the servo unless time is
/// virtual.
class ServoObserver {
 public:
  virtual ~ServoObserver() = default;
  /// Called after each tick, when the device has its force.
  virtual void after_tick(const ServoTick& tick) = 0;

  /// What the run has seen so far, after each after_tick.
  virtual void after_tick_of(const ServoRun& /*run*/) {}

 protected:
  ServoObserver() = default;
  ServoObserver(const ServoObserver&) = default;
  ServoObserver& operator=(const ServoObserver&) = default;
};

/// Runs a servo for `seconds` (> 0; infinite: until `stop`), a tick each period, and stops it. A
/// tick that is late by more than a period is not made up for: what was missed is skipped and
/// counted.
///
/// Threads  Realtime in the loop but for the clock, the device and the observer.
ServoRun run_servo(Servo& servo, ServoClock& clock, double seconds, const std::atomic<bool>& stop,
                   ServoObserver* observer = nullptr);

/// A servo on a thread of its own and the machine's clock. The thread has real-time priority
/// (SCHED_FIFO) where that is allowed, and all memory of the program, present and future, is locked
/// where that is unlimited (ThreadPriority.*); it runs without where it is not.
///
/// Errors   std::system_error from the constructor when the system gives no thread; a refusal of
///          priority or memory is no error (priority_refusal).
/// Threads  for the thread that made it. The servo, its device and scene belong to the servo's
///          thread until `stop` has returned.
class ServoThread {
 public:
  /// Begins to tick. Servo and observer must outlive it.
  explicit ServoThread(Servo& servo, ServoObserver* observer = nullptr);
  ~ServoThread() { stop(); }
  ServoThread(const ServoThread&) = delete;
  ServoThread& operator=(const ServoThread&) = delete;

  /// Ends the loop, with zero force, and waits for its end. What the run saw; again: the same.
  const ServoRun& stop();

  /// "" with real-time priority and locked memory; else what was refused and the remedy.
  const std::string& priority_refusal() const noexcept { return priority_refusal_; }

 private:
  std::atomic<bool> stop_ = false;
  ServoRun run_;
  std::string priority_refusal_;
  std::thread thread_;
};

}  // namespace argil::haptics
