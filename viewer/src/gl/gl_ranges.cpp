// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_ranges.h"

#include <cassert>

namespace argil::viewer {

FreeRanges::FreeRanges(std::uint32_t size) : size_(size) {
  if (size > 0) add(0, size);
}

void FreeRanges::add(std::uint32_t begin, std::uint32_t length) {
  begins_.emplace(begin, length);
  gaps_.emplace(length, begin);
}

void FreeRanges::remove(std::uint32_t begin, std::uint32_t length) {
  assert(begins_.contains(begin) && begins_.at(begin) == length);
  begins_.erase(begin);
  gaps_.erase({length, begin});
}

std::optional<std::uint32_t> FreeRanges::take(std::uint32_t length) {
  assert(length > 0);
  // The smallest gap that is long enough, and of several the first: best fit keeps large gaps
  // whole.
  const auto gap = gaps_.lower_bound({length, 0});
  if (gap == gaps_.end()) return std::nullopt;
  const auto [gap_length, begin] = *gap;
  remove(begin, gap_length);
  if (gap_length > length) add(begin + length, gap_length - length);
  return begin;
}

void FreeRanges::give(std::uint32_t begin, std::uint32_t length) {
  assert(length > 0 && begin + length <= size_);
  auto after = begins_.lower_bound(begin);
  assert(after == begins_.end() || begin + length <= after->first);
  // Joined with its neighbours, or the buffer would fall into pieces too short for anything.
  if (after != begins_.end() && after->first == begin + length) {
    const auto [next_begin, next_length] = *after;
    remove(next_begin, next_length);
    length += next_length;
    after = begins_.lower_bound(begin);
  }
  if (after != begins_.begin()) {
    const auto [last_begin, last_length] = *std::prev(after);
    assert(last_begin + last_length <= begin);
    if (last_begin + last_length == begin) {
      remove(last_begin, last_length);
      begin = last_begin;
      length += last_length;
    }
  }
  add(begin, length);
}

}  // namespace argil::viewer
