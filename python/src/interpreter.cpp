// SPDX-License-Identifier: GPL-3.0-or-later
#include "interpreter.h"

#include <atomic>
#include <cassert>
#include <chrono>
#include <thread>

#include <pthread.h>
#include <unistd.h>

namespace argil::python {
namespace {

constexpr std::chrono::seconds kLongestWait{10};
constexpr std::chrono::milliseconds kWaitSlice{2};

// No mutex: a fork would find it locked by a thread that it has not.
std::atomic<int> g_at_work{0};
std::atomic<bool> g_has_ended{false};
/// Only the thread that ends Python lets the interpreter go after that has begun.
thread_local bool t_ends_python = false;

bool is_finalizing() noexcept {
#if PY_VERSION_HEX >= 0x030D0000
  return Py_IsFinalizing() != 0;
#else
  return _Py_IsFinalizing() != 0;
#endif
}

/// Python calls it when the interpreter is gone, and Ctrl-C ends the process as it is.
void wait_for_work() noexcept {
  g_has_ended = true;
  const auto until = std::chrono::steady_clock::now() + kLongestWait;
  while (g_at_work > 0 && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(kWaitSlice);
  }
}

[[noreturn]] void sleep_for_ever() noexcept {
  while (true) pause();
}

}  // namespace

void add_end_of_work() {
  g_has_ended = false;  // by an interpreter before this one
  [[maybe_unused]] static const int added =
      pthread_atfork(nullptr, nullptr, [] { g_at_work = 0; });  // a fork has none of the threads
  if (Py_AtExit(&wait_for_work) != 0)
    throw py::import_error("Python has no place for what ends argil's work");
}

bool is_ended_here() noexcept { return t_ends_python; }

bool is_ending() noexcept { return g_has_ended || (is_finalizing() && !t_ends_python); }

WorkInProgress::WorkInProgress() noexcept { ++g_at_work; }

WorkInProgress::~WorkInProgress() {
  [[maybe_unused]] const int others = --g_at_work;
  assert(others >= 0);
}

InterpreterReleased::InterpreterReleased() {
  t_ends_python = is_finalizing();
  work_.emplace();
  thread_ = PyEval_SaveThread();
}

// Of C, what takes the interpreter throws nothing: all that comes is the unwinding.
InterpreterReleased::~InterpreterReleased() {
  work_.reset();
  try {
    PyEval_RestoreThread(thread_);
  } catch (...) {
    sleep_for_ever();
  }
}

InterpreterHeld::InterpreterHeld() noexcept {
  try {
    before_ = PyGILState_Ensure();
  } catch (...) {
    --g_at_work;  // this thread's, which comes to no end
    sleep_for_ever();
  }
}

InterpreterHeld::~InterpreterHeld() { PyGILState_Release(before_); }

}  // namespace argil::python
