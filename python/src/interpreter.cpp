// SPDX-License-Identifier: GPL-3.0-or-later
#include "interpreter.h"

#include <cassert>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace argil::python {
namespace {

constexpr std::chrono::seconds kLongestWait{10};

[[noreturn]] void sleep_for_ever() noexcept {
  while (true) pause();
}

/// Who is at work without the interpreter, and whether the program ends.
class Work {
 public:
  void begin() {
    const std::lock_guard lock(mutex_);
    ++count_;
  }

  /// Of a thread that the interpreter knows, and that has let it go.
  void begin_unless_ending() {
    std::unique_lock lock(mutex_);
    if (is_ending_here()) {
      lock.unlock();
      sleep_for_ever();
    }
    ++count_;
  }

  void end() {
    const std::lock_guard lock(mutex_);
    assert(count_ > 0);
    --count_;
    none_.notify_all();
  }

  void sleep_if_ending() {
    if (is_ending()) sleep_for_ever();
  }

  bool is_ending() {
    const std::lock_guard lock(mutex_);
    return is_ending_here();
  }

  /// Without the interpreter, which work that asks for signals needs.
  void stop_all() {
    std::unique_lock lock(mutex_);
    ender_ = std::this_thread::get_id();
    if (getpid() != process_) return;  // a fork has none of the threads
    none_.wait_for(lock, kLongestWait, [this] { return count_ == 0; });
  }

 private:
  bool is_ending_here() const { return ender_ && *ender_ != std::this_thread::get_id(); }

  std::mutex mutex_;
  std::condition_variable none_;
  int count_ = 0;
  std::optional<std::thread::id> ender_;
  pid_t process_ = getpid();
};

/// Left to the end of the process: threads come here after statics are gone.
Work& work() {
  static Work& all = *new Work;
  return all;
}

}  // namespace

void add_end_of_work(py::module_& module) {
  work();  // in this process
  module.def("_stop_all_work", [] {
    const py::gil_scoped_release released;
    work().stop_all();
  });
  py::module_::import("atexit").attr("register")(module.attr("_stop_all_work"));
}

bool is_ending() noexcept { return work().is_ending(); }

WorkInProgress::WorkInProgress() { work().begin(); }
WorkInProgress::~WorkInProgress() { work().end(); }

InterpreterReleased::InterpreterReleased() : thread_(PyEval_SaveThread()) {
  work().begin_unless_ending();
}

InterpreterReleased::~InterpreterReleased() {
  work().end();
  work().sleep_if_ending();
  take_interpreter([this] { PyEval_RestoreThread(thread_); });
}

}  // namespace argil::python
