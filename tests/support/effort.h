// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>

namespace argil::test {

/// How much of a long test is run: `usual` by ./tests/run.sh, `thorough` by ./tests/run.sh
/// --thorough, which sets ARGIL_THOROUGH. The claim is the same; seeds, scenes or repeats are more.
/// Under a sanitizer it is usual: what that finds needs no repeats, each of which takes ten times
/// as long.
template <class T>
T effort(T usual, T thorough) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  static_cast<void>(thorough);
  return usual;
#else
  const char* asked = std::getenv("ARGIL_THOROUGH");  // NOLINT(concurrency-mt-unsafe): read only
  return asked != nullptr && *asked != '\0' ? thorough : usual;
#endif
}

}  // namespace argil::test
