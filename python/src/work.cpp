// SPDX-License-Identifier: GPL-3.0-or-later
#include "work.h"

#include <memory>
#include <string>

#include <tbb/global_control.h>

namespace argil::python {
namespace {

constexpr int kMostThreads = 1024;

/// The interpreter is held, so that one thread at a time comes here. Left to the end of the
/// process: TBB may be gone before statics are.
void set_threads(int threads) {
  static tbb::global_control* limit = nullptr;
  if (threads < 0 || threads > kMostThreads) {
    raise_bad_input("threads is " + std::to_string(threads) + "; give 1 to " +
                    std::to_string(kMostThreads) + ", or 0 for as many as there are cores");
  }
  std::unique_ptr<tbb::global_control> next;
  if (threads > 0) {
    next = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                 static_cast<std::size_t>(threads));
  }
  // The least of all limits counts, so the one before has to go.
  const std::unique_ptr<tbb::global_control> former(limit);
  limit = next.release();
}

}  // namespace

void add_threads(py::module_& module) {
  module.def("set_threads", &set_threads, py::arg("threads"));
}

bool SignalWatch::goes_on() {
  if (has_thrown_ || is_ending()) return false;
  const auto now = Clock::now();
  if (now - asked_ < kAskEvery) return true;
  asked_ = now;
  const InterpreterHeld held;
  // What the handler throws stays with this thread's state until rethrow().
  has_thrown_ = PyErr_CheckSignals() != 0;
  return !has_thrown_;
}

void SignalWatch::rethrow() const {
  if (has_thrown_) throw py::error_already_set();
}

WorkLock::Held WorkLock::hold() {
  if (owner_.load() == std::this_thread::get_id()) {
    raise_bad_input("this object is at work in this very thread; use it after that");
  }
  SignalWatch watch;
  bool has_it = mutex_.try_lock();
  if (!has_it) {
    const InterpreterReleased released;
    bool goes_on = true;
    while (!has_it && goes_on) {
      has_it = mutex_.try_lock_for(kAskEvery);
      goes_on = watch.goes_on() && !is_ended_here();
    }
  }
  if (!has_it) {
    watch.rethrow();
    raise_bad_input(
        "a thread that the end of the program stopped is at work on this object; join "
        "threads before");
  }
  owner_ = std::this_thread::get_id();
  return Held(*this);
}

}  // namespace argil::python
