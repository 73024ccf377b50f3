// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "argil/core/no_throw.h"
#include "argil/core/progress.h"

#include "binding.h"
#include "errors.h"
#include "interpreter.h"

namespace argil::python {

/// How often it is looked whether a signal came.
inline constexpr std::chrono::milliseconds kAskEvery{50};

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

/// The same of `work()`, which makes something new and cannot be stopped: it runs in a thread of
/// its own, which Ctrl-C leaves behind to come to its end, and what it makes is let go. Copies what
/// it refers to. Where no thread can be had this one does it, and hears Ctrl-C after it.
///
/// Cost     beside the work some 50 us.
template <class Work>
auto run_apart(Work work) {
  using Made = decltype(work());
  struct Apart {
    WorkInProgress counted;
    std::promise<Made> made;
  };
  return run([&](const Progress& progress) -> Made {
    const auto apart = std::make_shared<Apart>();
    std::future<Made> made = apart->made.get_future();
    try {
      std::thread([apart, work] { apart->made.set_value(no_throw("work", work)); }).detach();
    } catch (const std::system_error&) {
      return no_throw("work", work);
    }
    while (made.wait_for(kAskEvery) != std::future_status::ready) {
      if (!progress("work", 0.0)) return Error{ErrorKind::interrupted, "interrupted"};
    }
    return made.get();
  });
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
