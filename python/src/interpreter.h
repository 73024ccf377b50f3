// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <cxxabi.h>
#include <unistd.h>

#include "binding.h"

namespace argil::python {

// When a program ends Python waits for no daemon thread. One within Argil would then meet statics
// that are gone, and one that wants the interpreter back is unwound (pthread_exit), which a
// destructor lets no one do but by an abort. So the module stops all work first, and a thread whose
// work is over then sleeps until the process ends, as Python 3.14 has it.

/// Has Python call, before it ends, what stops the work of other threads and waits for that, 10 s
/// at most. After it this thread may work on, others sleep.
void add_end_of_work(py::module_& module);

/// Whether the program ends, and this thread is another than the one that ends it.
bool is_ending() noexcept;

/// Runs `take`, which takes the interpreter. Where that is gone the thread sleeps.
template <class Take>
void take_interpreter(const Take& take) noexcept {
  try {
    take();
  } catch (const abi::__forced_unwind&) {
    while (true) pause();
  }
}

/// Work of a thread that never has the interpreter, counted while this lives.
class WorkInProgress {
 public:
  WorkInProgress();
  ~WorkInProgress();
  WorkInProgress(const WorkInProgress&) = delete;
  WorkInProgress& operator=(const WorkInProgress&) = delete;
};

/// The interpreter is let go while this lives, for work.
class InterpreterReleased {
 public:
  InterpreterReleased();
  ~InterpreterReleased();
  InterpreterReleased(const InterpreterReleased&) = delete;
  InterpreterReleased& operator=(const InterpreterReleased&) = delete;

 private:
  PyThreadState* thread_;
};

/// The interpreter is held while this lives, within work that let it go.
class InterpreterHeld {
 public:
  InterpreterHeld() {
    take_interpreter([this] { held_.emplace(); });
  }
  InterpreterHeld(const InterpreterHeld&) = delete;
  InterpreterHeld& operator=(const InterpreterHeld&) = delete;

 private:
  std::optional<py::gil_scoped_acquire> held_;
};

}  // namespace argil::python
