// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/servo_run.h"

#include <cassert>
#include <cerrno>
#include <cmath>

#include <time.h>

#include "servo/thread_priority.h"

namespace argil::haptics {
namespace {

constexpr double kUsPerS = 1e6;

double monotonic_s() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

SteadyClock::SteadyClock() noexcept : start_s_(monotonic_s()) {}

double SteadyClock::now_s() noexcept { return monotonic_s() - start_s_; }

void SteadyClock::wait_until(double time_s) noexcept {
  const double due_s = start_s_ + time_s;
  timespec due{};
  due.tv_sec = static_cast<time_t>(std::floor(due_s));
  due.tv_nsec = static_cast<long>((due_s - std::floor(due_s)) * 1e9);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) == EINTR) {
  }
}

ServoRun run_servo(Servo& servo, ServoClock& clock, double seconds, const std::atomic<bool>& stop,
                   ServoObserver* observer) {
  ServoRun run;
  const double period_s = servo.options().period_s;
  assert(period_s > 0.0 && !std::isnan(seconds));
  const double begin_s = clock.now_s();
  // Ticks are due at multiples of the period: no rounding adds up.
  std::uint64_t due_tick = 0;
  double last_s = begin_s;
  while (!stop.load(std::memory_order_relaxed)) {
    const double due_s = begin_s + static_cast<double>(due_tick) * period_s;
    if (due_s - begin_s > seconds - 0.5 * period_s) break;
    clock.wait_until(due_s);
    const double now_s = clock.now_s();
    const ServoTick tick = servo.tick(now_s);
    run.cost.add((clock.now_s() - now_s) * kUsPerS);
    run.lateness.add((now_s - due_s) * kUsPerS);
    if (run.ticks > 0) run.period.add((now_s - last_s) * kUsPerS);
    if (now_s - due_s > 0.5 * period_s) ++run.late_ticks;
    last_s = now_s;
    ++run.ticks;
    run.faults |= tick.faults;
    if (tick.window.age_s >= 0.0) run.window_age.add(tick.window.age_s * kUsPerS);
    if (observer != nullptr) {
      observer->after_tick(tick);
      observer->after_tick_of(run);
    }
    const double behind = std::floor((clock.now_s() - due_s) / period_s);
    // Late by more than a period, ticks are left out rather than made up for in a burst.
    const std::uint64_t skipped = behind > 1.0 ? static_cast<std::uint64_t>(behind) - 1 : 0;
    run.skipped_ticks += skipped;
    due_tick += 1 + skipped;
  }
  servo.stop();
  return run;
}

ServoThread::ServoThread(Servo& servo, ServoObserver* observer) {
  thread_ = std::thread([this, &servo, observer] {
    SteadyClock clock;
    run_ = run_servo(servo, clock, HUGE_VAL, stop_, observer);
  });
  // From here and not from the thread itself: what is refused is known at once.
  priority_refusal_ = ask_for_priority(thread_);
}

const ServoRun& ServoThread::stop() {
  stop_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) thread_.join();
  return run_;
}

}  // namespace argil::haptics
