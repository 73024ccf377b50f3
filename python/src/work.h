// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>

#include "argil/core/progress.h"

#include "binding.h"
#include "errors.h"
#include "interpreter.h"

namespace argil::python {

/// Ctrl-C during work that has let the interpreter go.
///
/// Threads  that of the work; Python runs its handlers on its main thread alone, so that elsewhere
///          nothing stops the work.
class SignalWatch {
 public:
  /// For work: asks the interpreter every 50 ms whether a signal came. Lives no longer than this.
  Progress progress() {
    return [this](std::string_view, double) { return goes_on(); };
  }
  /// False where a handler of Python threw, and where the program ends.
  bool goes_on();
  /// With the interpreter held: throws what the handler threw.
  void rethrow() const;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point asked_ = Clock::now();
  bool has_thrown_ = false;
};

/// Runs `work(progress)`, which returns a Result, without the interpreter. Its value, or a throw.
template <class Work>
auto run(Work&& work) {
  SignalWatch watch;
  auto result = [&] {
    const InterpreterReleased released;
    return work(watch.progress());
  }();
  watch.rethrow();
  return value_of(std::move(result));
}

/// Adds set_threads.
void add_threads(py::module_& module);

/// Something that one thread at a time may work with, without the interpreter: others wait for it.
///
/// Errors   a thread that holds it already, as a handler of a signal may, gets BadInput instead of
///          waiting for itself. Ctrl-C ends waiting.
class WorkLock {
 public:
  class Held {
   public:
    explicit Held(WorkLock& lock) : lock_(lock) {}
    ~Held() {
      lock_.owner_ = std::thread::id{};
      lock_.mutex_.unlock();
    }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;

   private:
    WorkLock& lock_;
  };

  /// With the interpreter held, which is let go while this waits.
  Held hold();

 private:
  std::timed_mutex mutex_;
  std::atomic<std::thread::id> owner_;
};

}  // namespace argil::python
