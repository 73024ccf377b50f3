// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace argil {

/// Calls `work(n)` for n below `count`, on several threads where that is worth waking them.
template <class Work>
void for_each_leaf(std::size_t count, const Work& work) {
  constexpr std::size_t kGrain = 8;
  if (count < 2 * kGrain) {
    for (std::size_t n = 0; n < count; ++n) work(n);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t n = range.begin(); n < range.end(); ++n) work(n);
                    });
}

}  // namespace argil
