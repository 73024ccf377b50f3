// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

#include "argil/core/result.h"

#include "binding.h"

namespace argil::python {

/// Adds Argil's exceptions to the module: `Error` and one class for each ErrorKind, which are also
/// what Python calls such a thing (ValueError, MemoryError, OSError).
void add_errors(py::module_& module);

/// Throws the exception of an error; `interrupted` is KeyboardInterrupt.
[[noreturn]] void raise(const Error& error);

/// The value, or a throw of its error.
template <class T>
T value_of(Result<T> result) {
  if (!result) raise(result.error());
  return std::move(result).value();
}
inline void value_of(const Result<void>& result) {
  if (!result) raise(result.error());
}

/// bad_input with a sentence that names the thing, its value and the remedy.
[[noreturn]] void raise_bad_input(const std::string& message);

}  // namespace argil::python
