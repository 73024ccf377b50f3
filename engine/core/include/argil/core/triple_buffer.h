// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace argil {

/// Hands the newest value from one writing thread to one reading thread; older values that were not
/// read in time are skipped. Neither side ever waits, and neither sees a value half written.
///
/// The writer fills `write_slot()` and calls `publish()`. The reader calls `fetch()` and reads
/// `read_slot()`, which stays as it is until the next `fetch()`. A slot is given back to the writer
/// with an old value in it, so the writer must fill all of it; its memory is kept, which is how
/// buffers that were large enough once are never allocated again.
///
/// Shapes       T: can be copied, or has a default. A T that owns memory should be built from a
///              prototype that is large enough (TripleBuffer.KeepsTheMemoryOfItsSlots).
/// Threads      Realtime: one writer thread and one reader thread; wait-free, one atomic exchange
///              each. TripleBufferStress.* runs under the thread sanitizer, and
///              TripleBuffer.NeverGivesBothSidesTheSameSlot goes through all orders of 12.
/// Cost         three T, allocated by the constructor; nothing is allocated afterwards.
template <class T>
class TripleBuffer {
 public:
  /// Three default values; the reader sees one of them until the first `publish`.
  TripleBuffer() = default;
  /// Three copies of `prototype`, so that each slot has its memory from the start.
  explicit TripleBuffer(const T& prototype) : slots_{{{prototype}, {prototype}, {prototype}}} {}

  TripleBuffer(const TripleBuffer&) = delete;
  TripleBuffer& operator=(const TripleBuffer&) = delete;

  /// Writer: the slot to fill. The same until `publish`.
  T& write_slot() noexcept { return slots_[back_].value; }

  /// Writer: makes the filled slot the newest value and takes a free one instead.
  void publish() noexcept {
    const auto fresh = static_cast<std::uint8_t>(back_ | kFresh);
    back_ = middle_.exchange(fresh, std::memory_order_acq_rel) & kIndex;
  }

  /// Reader: whether the next `fetch` will take a value. Once true it stays so until then.
  bool has_fresh() const noexcept {
    return (middle_.load(std::memory_order_relaxed) & kFresh) != 0;
  }

  /// Reader: takes the newest value if one was published since the last call; false when none was.
  bool fetch() noexcept {
    if (!has_fresh()) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }

  /// Reader: the value taken by the last `fetch`; it stays until the next one
  /// (TripleBuffer.KeepsTheReadersValueWhileTheWriterGoesOn).
  const T& read_slot() const noexcept { return slots_[front_].value; }

 private:
  // middle_ holds the index of the slot that neither side has, with kFresh set while it is unread.
  static constexpr std::uint8_t kIndex = 3;
  static constexpr std::uint8_t kFresh = 4;  ///< set by publish, cleared by fetch
  static constexpr std::size_t kCacheLine = 64;

  /// On its own cache lines: writer and reader do not slow each other down.
  struct alignas(kCacheLine) Slot {
    T value{};
  };

  std::array<Slot, 3> slots_{};
  alignas(kCacheLine) std::atomic<std::uint8_t> middle_{1};
  alignas(kCacheLine) std::uint8_t back_ = 0;   ///< the writer's own
  alignas(kCacheLine) std::uint8_t front_ = 2;  ///< the reader's own
};

}  // namespace argil
