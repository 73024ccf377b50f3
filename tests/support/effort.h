// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>

namespace argil::test {

/// How much of a long test is run: `usual` by ./tests/run.sh, `thorough` by ./tests/run.sh
/// --thorough, which sets ARGIL_THOROUGH. The claim is the same; seeds, scenes or repeats are more.
template <class T>
T effort(T usual, T thorough) {
  const char* asked = std::getenv("ARGIL_THOROUGH");  // NOLINT(concurrency-mt-unsafe): read only
  return asked != nullptr && *asked != '\0' ? thorough : usual;
}

}  // namespace argil::test
