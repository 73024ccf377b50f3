// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "argil/core/pace.h"

namespace argil::io {

/// A bound from above as a float: never less than it was.
inline float rounded_up(double bound) noexcept {
  const auto nearest = static_cast<float>(bound);
  constexpr float kMost = std::numeric_limits<float>::infinity();
  return static_cast<double>(nearest) < bound ? std::nextafter(nearest, kMost) : nearest;
}

/// The greatest value that is at least `found` among items of which only a bound is known.
/// `bounds`: by rounded_up(). `make_refine()` is asked once for each block of items: its
/// `refine(item, found)` gives an item's own greatest value, or anything not above `found` when it
/// does not exceed that. Items with the greatest bounds come first, so that the rest can be left
/// alone; in blocks of fixed size, so that bits do not depend on threads.
template <class MakeRefine>
double greatest_by_bound(const std::vector<float>& bounds, double found, const Pace& pace,
                         const MakeRefine& make_refine) {
  constexpr std::size_t kBlock = 256;
  std::vector<std::pair<float, std::uint32_t>> open;
  for (std::uint32_t i = 0; i < bounds.size(); ++i) {
    if (static_cast<double>(bounds[i]) > found) open.emplace_back(-bounds[i], i);
  }
  std::size_t begin = 0;
  // Ever larger rounds: each knows what those before it found.
  for (std::size_t size = kBlock; begin < open.size(); size *= 4) {
    pace.at(static_cast<double>(begin) / static_cast<double>(open.size()));
    const std::size_t end = std::min(open.size(), begin + size);
    assert(begin < end);
    const auto at = [&](std::size_t i) { return open.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(end - 1), open.end());
    std::sort(at(begin), at(end));
    std::vector<double> greatest((end - begin + kBlock - 1) / kBlock, found);
    tbb::parallel_for(std::size_t{0}, greatest.size(), [&](std::size_t block) {
      double& most = greatest[block];
      const auto refine = make_refine();
      const std::size_t stop = std::min(end, begin + (block + 1) * kBlock);
      for (std::size_t i = begin + block * kBlock; i < stop; ++i) {
        if (-static_cast<double>(open[i].first) <= most) break;
        most = std::max(most, refine(open[i].second, most));
      }
    });
    assert(*std::max_element(greatest.begin(), greatest.end()) >= found);
    found = *std::max_element(greatest.begin(), greatest.end());
    begin = end;
  }
  return found;
}

}  // namespace argil::io
