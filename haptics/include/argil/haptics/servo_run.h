// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "argil/haptics/histogram.h"
#include "argil/haptics/servo.h"

namespace argil::haptics {

/// What time it is, and waiting for a time.
class ServoClock {
 public:
  virtual ~ServoClock() = default;
  ServoClock() = default;
  ServoClock(const ServoClock&) = delete;
  ServoClock& operator=(const ServoClock&) = delete;
  virtual double now_s() noexcept = 0;
  virtual void wait_until(double time_s) noexcept = 0;
};

/// Time that passes only by waiting for it: for tests and the lab, as fast as the machine can.
class VirtualClock final : public ServoClock {
 public:
  double now_s() noexcept override { return now_s_; }
  void wait_until(double time_s) noexcept override {
    if (time_s > now_s_) now_s_ = time_s;
  }
  void jump(double by_s) noexcept { now_s_ += by_s; }  ///< a fault, for tests

 private:
  double now_s_ = 0.0;
};

/// The machine's monotonic clock, from 0 where it was made; waiting sleeps.
class SteadyClock final : public ServoClock {
 public:
  SteadyClock() noexcept;
  double now_s() noexcept override;
  void wait_until(double time_s) noexcept override;

 private:
  double start_s_;
};

/// What a run saw. On virtual time lateness and cost are 0.
struct ServoRun {
  std::uint64_t ticks = 0;
  std::uint64_t late_ticks = 0;        ///< began more than half a period after they were due
  std::uint64_t skipped_ticks = 0;     ///< left out, to catch up
  std::uint32_t faults = kServoSound;  ///< of all ticks
  Histogram period;                    ///< from tick to tick
  Histogram lateness;                  ///< from when a tick was due to when it began
  Histogram cost;                      ///< from its beginning to its end, by the clock
};

/// Sees every tick on the servo's own thread: must be as fast as the servo, unless time is virtual.
class ServoObserver {
 public:
  virtual ~ServoObserver() = default;
  virtual void after_tick(const ServoTick& tick) = 0;

  /// What the run has seen so far, after each after_tick.
  virtual void after_tick_of(const ServoRun& /*run*/) {}

 protected:
  ServoObserver() = default;
  ServoObserver(const ServoObserver&) = default;
  ServoObserver& operator=(const ServoObserver&) = default;
};

/// Runs a servo for `seconds` (infinite: until `stop`), a tick each period, and stops it. A tick
/// that is late by more than a period is not made up for: what was missed is skipped and counted.
///
/// Threads  Realtime in the loop but for the clock, the device and the observer.
ServoRun run_servo(Servo& servo, ServoClock& clock, double seconds, const std::atomic<bool>& stop,
                   ServoObserver* observer = nullptr);

/// A servo on a thread of its own and the machine's clock, with real-time priority (SCHED_FIFO)
/// where that is allowed, and all memory of the program locked, also what comes later, where that
/// is unlimited (ThreadPriority.*); and without where it is not.
///
/// Threads  for the thread that made it. The servo, its device and scene belong to the servo's
///          thread until `stop` has returned.
class ServoThread {
 public:
  /// `observer`, when given, must outlive it too.
  explicit ServoThread(Servo& servo, ServoObserver* observer = nullptr);
  ~ServoThread() { stop(); }
  ServoThread(const ServoThread&) = delete;
  ServoThread& operator=(const ServoThread&) = delete;

  /// Ends the loop, with zero force, and waits for it. What the run saw; again: the same.
  const ServoRun& stop();

  /// "" with real-time priority and locked memory, else why not and the remedy.
  const std::string& priority_refusal() const noexcept { return priority_refusal_; }

 private:
  std::atomic<bool> stop_ = false;
  ServoRun run_;
  std::string priority_refusal_;
  std::thread thread_;
};

}  // namespace argil::haptics
