// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace argil::viewer {

/// Hands out ranges of a buffer, the smallest gap that fits, and joins gaps when they come back.
/// Units are the caller's. Cost: logarithmic in the number of gaps.
class FreeRanges {
 public:
  explicit FreeRanges(std::uint32_t size);

  /// Where a range of this length, not 0, begins; nothing when no gap is that long.
  std::optional<std::uint32_t> take(std::uint32_t length);
  /// Gives back what `take` returned, with the same length.
  void give(std::uint32_t begin, std::uint32_t length);

  std::uint32_t size() const noexcept { return size_; }
  std::uint32_t longest() const noexcept { return gaps_.empty() ? 0 : gaps_.rbegin()->first; }

 private:
  void add(std::uint32_t begin, std::uint32_t length);
  void remove(std::uint32_t begin, std::uint32_t length);

  std::uint32_t size_;
  std::map<std::uint32_t, std::uint32_t> begins_;           ///< begin to length, of each gap
  std::set<std::pair<std::uint32_t, std::uint32_t>> gaps_;  ///< length and begin of each
};

}  // namespace argil::viewer
