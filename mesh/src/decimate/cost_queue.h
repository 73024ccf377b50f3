// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace argil::mesh {

/// Hands out numbers by classes of cost, four classes for each factor of two, and within a class in
/// ascending order: neighbours in memory one after the other, at half the time of a heap, and one
/// order for all machines.
class CostQueue {
 public:
  // class_for keeps eight bits of exponent and two of fraction; the sign is always 0.
  static constexpr std::uint16_t kClasses = 0x400;
  static constexpr std::uint16_t kNone = 0xffff;

  /// `class_of` has the class of each number, kNone at first; queues that never hold the same
  /// number may share it, also at the same time.
  explicit CostQueue(std::span<std::uint16_t> class_of) : class_of_(class_of), classes_(kClasses) {}

  static std::uint16_t class_for(double cost) noexcept {
    assert(!std::isnan(cost));
    // A float's exponent and the two highest bits of its fraction ascend with its value.
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(std::max(cost, 0.0)));
    return static_cast<std::uint16_t>(bits >> 21U);
  }

  bool holds(std::uint32_t number) const noexcept { return class_of_[number] != kNone; }
  void forget(std::uint32_t number) noexcept { class_of_[number] = kNone; }

  /// Puts a number in, or in another class. A class that has passed means the present one.
  void put(std::uint32_t number, std::uint16_t cost_class) {
    assert(number < class_of_.size());
    const std::uint16_t at = std::clamp(cost_class, now_, static_cast<std::uint16_t>(kClasses - 1));
    if (class_of_[number] == at) return;
    class_of_[number] = at;
    classes_[at].push_back(number);
  }

  /// The class of the next number, kClasses when there is none.
  std::uint16_t next_class() noexcept {
    while (next_ < batch_.size() && class_of_[batch_[next_]] != now_) ++next_;
    if (next_ < batch_.size()) return now_;
    std::uint16_t next = now_;
    while (next < kClasses && classes_[next].empty()) ++next;
    return next;
  }

  /// The next number, which is out then; false when there is none of a class up to `last`.
  bool take(std::uint32_t& number, std::uint16_t last) {
    for (;;) {
      while (next_ < batch_.size()) {
        number = batch_[next_++];
        if (class_of_[number] != now_) continue;  // forgotten, or put elsewhere since
        class_of_[number] = kNone;
        return true;
      }
      const std::uint16_t next = next_class();
      if (next > last || next == kClasses) return false;
      now_ = next;
      batch_.clear();
      std::swap(batch_, classes_[now_]);
      std::sort(batch_.begin(), batch_.end());
      next_ = 0;
    }
  }
  std::uint16_t now() const noexcept { return now_; }

 private:
  std::span<std::uint16_t> class_of_;
  std::vector<std::vector<std::uint32_t>> classes_;
  std::vector<std::uint32_t> batch_;  ///< of the present class, ascending from next_ on
  std::size_t next_ = 0;
  std::uint16_t now_ = 0;
};

}  // namespace argil::mesh
