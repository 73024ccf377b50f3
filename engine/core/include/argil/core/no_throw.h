// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <new>
#include <string>

#include "argil/core/pace.h"
#include "argil/core/result.h"

namespace argil {

/// Runs `work`, which returns a Result, and turns what a library throws inside into an Error, so
/// that no exception crosses the border of this target.
///
/// Shapes       work: called once, without arguments. It returns a Result whose error is an Error.
///              what: names the thing worked on, usually a file; each message begins with it.
/// Returns      what `work` returns. Nothing is taken back here of what `work` had changed when it
///              threw: it must itself leave nothing behind, as the message of an interrupt says.
/// Errors       interrupted  `work` threw Interrupted (pace.h).
///              memory       it threw std::bad_alloc.
///              internal     it threw any other std::exception, whose text the message quotes.
///              What is not a std::exception passes through, and so does the std::bad_alloc of a
///              message that finds no memory either.
/// Threads      any. Catches what leaves `work` on this thread, to which TBB also brings what its
///              tasks throw. Allocates the message.
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

}  // namespace argil
