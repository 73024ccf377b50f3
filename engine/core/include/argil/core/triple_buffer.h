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

  /// Neither copied nor moved: both threads hold references to its slots. It must outlive their
  /// last call.
  TripleBuffer(const TripleBuffer&) = delete;
  TripleBuffer& operator=(const TripleBuffer&) = delete;

  /// Writer: the slot to fill. The same until `publish`, then another: a reference that is kept
  /// across `publish` writes into what the reader reads.
  T& write_slot() noexcept { return slots_[back_].value; }

  /// Writer: makes the filled slot the newest value and takes a free one instead: the value that
  /// was published before, if the reader has not fetched it, else the one that it gave back.
  void publish() noexcept {
    // Release hands over what was written into the slot; acquire lets the reader's last look at the
    // slot that comes back happen before it is written again.
    const auto fresh = static_cast<std::uint8_t>(back_ | kFresh);
    back_ = middle_.exchange(fresh, std::memory_order_acq_rel) & kIndex;
  }

  /// Reader: whether the next `fetch` will take a value. Once true it stays so until then. Relaxed,
  /// since it hands nothing over: a value that was just published may be seen one call later.
  bool has_fresh() const noexcept {
    return (middle_.load(std::memory_order_relaxed) & kFresh) != 0;
  }

  /// Reader: takes the newest value if one was published since the last call; false when none was,
  /// and then `read_slot` is what it was. What was published in between is never seen
  /// (TripleBuffer.HandsOverTheNewestAndSkipsOlder).
  bool fetch() noexcept {
    if (!has_fresh()) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }

  /// Reader: the value taken by the last `fetch`; it stays until the next one that returns true
  /// (TripleBuffer.KeepsTheReadersValueWhileTheWriterGoesOn). Before the first it is the default,
  /// or the prototype (TripleBuffer.ShowsThePrototypeBeforeTheFirstPublish).
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
