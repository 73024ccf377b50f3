// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>

namespace argil {

/// Items in columns of a lattice, found by many tasks: each column has its own in an order of
/// theirs, whichever task found them.
template <class Item>
class ColumnLists {
 public:
  struct Found {
    std::int32_t x;
    Item item;
  };

  /// `is_before(a, b)` must leave no two different items equal. `settle(items)` is called for each
  /// column once its items are in order.
  template <class IsBefore, class Settle>
  void fill(const std::vector<std::vector<Found>>& found, const IsBefore& is_before,
            const Settle& settle) {
    int low = std::numeric_limits<int>::max();
    int high = std::numeric_limits<int>::min();
    std::size_t count = 0;
    for (const auto& list : found) {
      count += list.size();
      for (const Found& each : list) {
        low = std::min(low, each.x);
        high = std::max(high, each.x);
      }
    }
    if (count == 0) return;
    low_x_ = low;
    first_.assign(static_cast<std::size_t>(high - low) + 2, 0);
    for (const auto& list : found) {
      for (const Found& each : list) ++first_[column_of(each.x) + 1];
    }
    for (std::size_t x = 1; x < first_.size(); ++x) first_[x] += first_[x - 1];
    items_.resize(count);
    std::vector<std::uint64_t> next(first_.begin(), first_.end() - 1);
    for (const auto& list : found) {
      for (const Found& each : list) items_[next[column_of(each.x)]++] = each.item;
    }
    tbb::parallel_for(std::size_t{0}, next.size(), [&](std::size_t column) {
      const std::span<Item> items{items_.data() + first_[column],
                                  first_[column + 1] - first_[column]};
      std::sort(items.begin(), items.end(), is_before);
      settle(items);
    });
  }

  /// Empty where there is none.
  std::span<const Item> at(int x) const noexcept {
    const std::size_t column = column_of(x);
    if (x < low_x_ || column + 1 >= first_.size()) return {};
    return {items_.data() + first_[column], first_[column + 1] - first_[column]};
  }

 private:
  std::size_t column_of(int x) const noexcept {
    return static_cast<std::size_t>(static_cast<std::int64_t>(x) - low_x_);
  }

  int low_x_ = 0;
  std::vector<std::uint64_t> first_;  ///< of each x, and one more
  std::vector<Item> items_;
};

}  // namespace argil
