// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace argil {

/// A bounded queue from one producing thread to one consuming thread. When it is full the new value
/// is dropped and counted: the producer is never held up, and what is in the ring stays in order.
///
/// Shapes       T: has a default, which fills the slots. Copy assignment must not throw and should
///              not allocate: both ends copy values. A value that was popped stays in its slot
///              until that is written again, and with it whatever it owns.
/// Returns      values in the order in which they were pushed (SpscRing.GivesValuesBackInOrder).
/// Errors       full: push returns false and counts (SpscRing.DropsAndCountsTheNewWhenFull).
/// Threads      Realtime: one producer (`push`), one consumer (`pop`), `dropped` from anywhere;
///              wait-free. SpscRingStress.* runs under the thread sanitizer. Either end may move
///              to another thread where something else orders the two, as joining one does.
/// Cost         all memory is allocated by the constructor. Each end remembers how far the other
///              was and reads its counter again only when the ring looks full or empty.
template <class T>
class SpscRing {  // NOLINT(clang-analyzer-optin.performance.Padding): one cache line for each end
  static_assert(std::is_nothrow_copy_assignable_v<T>, "copying must not throw on the servo thread");

 public:
  /// Room for at least `capacity` values (1 to 2^31), rounded up to a power of two, so that a mask
  /// finds the slot (SpscRing.RoundsItsCapacityUpToAPowerOfTwo).
  explicit SpscRing(std::size_t capacity)
      : slots_(std::bit_ceil(capacity)), mask_(slots_.size() - 1) {
    assert(capacity >= 1 && capacity <= (std::size_t{1} << 31));
  }

  /// Neither copied nor moved: two threads refer to it. It must outlive both their last calls.
  SpscRing(const SpscRing&) = delete;
  SpscRing& operator=(const SpscRing&) = delete;

  /// Values that fit, after rounding up; constant, so that any thread may ask.
  std::size_t capacity() const noexcept { return slots_.size(); }

  /// Producer: appends a copy; false, and counted, when the ring is full. The consumer sees the
  /// value whole, or not yet.
  bool push(const T& value) noexcept {
    // Relaxed: only this thread writes the counter. The release below publishes the slot's value.
    const std::uint64_t at = written_.load(std::memory_order_relaxed);
    if (at - known_read_ == slots_.size()) {
      known_read_ = read_.load(std::memory_order_acquire);
      if (at - known_read_ == slots_.size()) {
        dropped_.fetch_add(1, std::memory_order_relaxed);
        return false;
      }
    }
    slots_[static_cast<std::size_t>(at) & mask_] = value;
    written_.store(at + 1, std::memory_order_release);
    return true;
  }

  /// Consumer: takes the oldest value; false when the ring is empty, and then `value` is what it
  /// was. A consumer that is to empty the ring must bound itself: a fast producer fills it again
  /// meanwhile.
  bool pop(T& value) noexcept {
    // The release below gives the slot back: the producer must not write it before it was copied.
    const std::uint64_t at = read_.load(std::memory_order_relaxed);
    if (at == known_written_) {
      known_written_ = written_.load(std::memory_order_acquire);
      if (at == known_written_) return false;
    }
    value = slots_[static_cast<std::size_t>(at) & mask_];
    read_.store(at + 1, std::memory_order_release);
    return true;
  }

  /// How many values `push` has dropped since construction. Relaxed: another thread may see a drop
  /// a little later, and before or after values that were pushed around it.
  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::size_t kCacheLine = 64;

  std::vector<T> slots_;
  std::size_t mask_;  ///< capacity - 1: `count & mask_` is a slot

  // The producer's line.
  alignas(kCacheLine) std::atomic<std::uint64_t> written_{0};  ///< values pushed; never wraps
  std::uint64_t known_read_ = 0;  ///< the producer's copy, so that it rarely touches `read_`
  std::atomic<std::uint64_t> dropped_{0};

  // The consumer's line.
  alignas(kCacheLine) std::atomic<std::uint64_t> read_{0};  ///< values popped
  std::uint64_t known_written_ = 0;                         ///< the consumer's copy
};

}  // namespace argil
