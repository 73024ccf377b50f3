// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "argil/core/no_throw.h"
#include "argil/core/pace.h"

namespace argil::python {

/// Does `act(begin, end)` for pieces of `count` rows, of `chunk` or more each, on all cores, and
/// without TBB where one is all; `progress` is told between them and may stop it: every 0.05 s or
/// so, whatever a row takes, unless one alone takes longer.
///
/// Errors   interrupted; what no_throw says of exceptions.
/// Cost     beside the work a few us for each 0.05 s.
template <class Act>
Result<void> in_pieces(const char* what, std::size_t count, std::size_t chunk,
                       const Progress& progress, const Act& act) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kShort{25};
  constexpr std::chrono::milliseconds kLong{100};
  constexpr std::size_t kFirstChunks = 16;
  return no_throw(what, [&]() -> Result<void> {
    const Pace pace(progress, what);
    std::size_t rows = kFirstChunks * chunk;
    for (std::size_t begin = 0; begin < count;) {
      pace.at(static_cast<double>(begin) / static_cast<double>(count));
      const auto start = Clock::now();
      const std::size_t end = std::min(count, begin + rows);
      // A child that is forked as another thread first comes to TBB finds its lock held for ever.
      if (end - begin <= chunk) {
        act(begin, end);
      } else {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, chunk),
                          [&](const auto& part) { act(part.begin(), part.end()); });
      }
      const auto took = Clock::now() - start;
      if (took < kShort) rows *= 2;
      if (took > kLong) rows = std::max(chunk, rows / 2);
      begin = end;
    }
    return {};
  });
}

}  // namespace argil::python
