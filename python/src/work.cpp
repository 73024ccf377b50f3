// SPDX-License-Identifier: GPL-3.0-or-later
#include "work.h"

namespace argil::python {
namespace {

constexpr std::chrono::milliseconds kAskEvery{50};

}  // namespace

bool SignalWatch::goes_on() {
  if (has_thrown_) return false;
  const auto now = Clock::now();
  if (now - asked_ < kAskEvery) return true;
  asked_ = now;
  const py::gil_scoped_acquire held;
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
    const py::gil_scoped_release released;
    while (!has_it && watch.goes_on()) has_it = mutex_.try_lock_for(kAskEvery);
  }
  if (!has_it) watch.rethrow();
  owner_ = std::this_thread::get_id();
  return Held(*this);
}

}  // namespace argil::python
