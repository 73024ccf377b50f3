// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "binding.h"

namespace argil::python {

// When a program ends Python waits for no daemon thread. One that then wants the interpreter is
// unwound (pthread_exit), which a destructor lets no one do but by an abort; one that is at work
// meets statics that are gone. So work is stopped once Python ends, its threads sleep until the
// process is gone, as Python 3.14 has it, and the last that Python does is to wait for that.

/// Has Python wait for work at its very end, 10 s at most.
void add_end_of_work();

/// Whether the program ends, and this thread is another than the one that ends it.
bool is_ending() noexcept;

/// Whether this thread ends the program, and what others hold is held for ever. Told of one that
/// has let the interpreter go.
bool is_ended_here() noexcept;

/// Work without the interpreter, counted while this lives.
class WorkInProgress {
 public:
  WorkInProgress() noexcept;
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
  std::optional<WorkInProgress> work_;
  PyThreadState* thread_;
};

/// The interpreter is held while this lives, within work that let it go.
class InterpreterHeld {
 public:
  InterpreterHeld() noexcept;
  ~InterpreterHeld();
  InterpreterHeld(const InterpreterHeld&) = delete;
  InterpreterHeld& operator=(const InterpreterHeld&) = delete;

 private:
  PyGILState_STATE before_;
};

}  // namespace argil::python
