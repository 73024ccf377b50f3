// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <new>
#include <string>

#include "argil/core/result.h"

#include "pace.h"

namespace argil::io {

/// Runs `work`, which returns a Result, and turns what a library throws inside into an Error, so
/// that no exception crosses the border of this target. `what` names the thing worked on.
template <class Work>
auto no_throw(const std::string& what, Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const Interrupted&) {
    return Error{ErrorKind::interrupted, what + ": interrupted; nothing was changed"};
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::memory,
                 what + ": not enough memory; close other programs or use a " + "smaller mesh"};
  } catch (const std::exception& error) {
    return Error{ErrorKind::internal, what + ": a library failed (" + error.what() +
                                          "); please report this file as a bug of Argil"};
  }
}

}  // namespace argil::io
