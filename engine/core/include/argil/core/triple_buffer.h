// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <cassert>
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
/// A reader that goes over from one value to the next in its own time holds several: it has
/// `kHeld` places, and `fetch` fills the one that it names and leaves the others alone.
///
/// Shapes       T: can be copied, or has a default. A T that owns memory should be built from a
///              prototype that is large enough (TripleBuffer.KeepsTheMemoryOfItsSlots).
///              kHeld: 1 (usual) to 5.
/// Threads      Realtime: one writer thread and one reader thread; wait-free, one atomic exchange
///              each. TripleBufferStress.* runs under the thread sanitizer, and
///              TripleBuffer.NeverGivesBothSidesTheSameSlot goes through all orders of 12.
/// Cost         2 + kHeld T, allocated by the constructor; nothing is allocated afterwards.
template <class T, std::size_t kHeld = 1>
class TripleBuffer {
 public:
  static_assert(kHeld >= 1 && kHeld <= 5, "the slot's index has three bits");

  /// Default values; the reader sees them until the first `publish`.
  TripleBuffer() = default;
  /// Copies of `prototype`, so that each slot has its memory from the start.
  explicit TripleBuffer(const T& prototype) {
    for (Slot& slot : slots_) slot.value = prototype;
  }

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

  /// Reader: takes the newest value into `place` if one was published since the last call, and
  /// gives the one that was there back; false when none was, and then nothing changes. What was
  /// published in between is never seen (TripleBuffer.HandsOverTheNewestAndSkipsOlder).
  bool fetch(std::size_t place = 0) noexcept {
    assert(place < kHeld);
    if (!has_fresh()) return false;
    held_[place] = middle_.exchange(held_[place], std::memory_order_acq_rel) & kIndex;
    return true;
  }

  /// Reader: the value in `place`; it stays until the next `fetch` of that place that returns true
  /// (TripleBuffer.KeepsTheReadersValueWhileTheWriterGoesOn,
  /// TripleBuffer.HoldsOneValueWhileItTakesAnother). Before the first it is the default, or the
  /// prototype (TripleBuffer.ShowsThePrototypeBeforeTheFirstPublish).
  const T& read_slot(std::size_t place = 0) const noexcept {
    assert(place < kHeld);
    return slots_[held_[place]].value;
  }

  /// Reader: the same, to change it: the slot is the reader's until it is given back, and the
  /// writer then fills all of it.
  T& held_slot(std::size_t place = 0) noexcept {
    assert(place < kHeld);
    return slots_[held_[place]].value;
  }

 private:
  // middle_ holds the index of the slot that neither side has, with kFresh set while it is unread.
  static constexpr std::uint8_t kIndex = 7;
  static constexpr std::uint8_t kFresh = 8;  ///< set by publish, cleared by fetch
  static constexpr std::size_t kCacheLine = 64;

  /// On its own cache lines: writer and reader do not slow each other down.
  struct alignas(kCacheLine) Slot {
    T value{};
  };

  /// The slots from the third on are the reader's at first.
  static constexpr std::array<std::uint8_t, kHeld> first_held() noexcept {
    std::array<std::uint8_t, kHeld> held{};
    for (std::size_t n = 0; n < kHeld; ++n) held[n] = static_cast<std::uint8_t>(n + 2);
    return held;
  }

  std::array<Slot, 2 + kHeld> slots_{};
  alignas(kCacheLine) std::atomic<std::uint8_t> middle_{1};
  alignas(kCacheLine) std::uint8_t back_ = 0;                                ///< the writer's
  alignas(kCacheLine) std::array<std::uint8_t, kHeld> held_ = first_held();  ///< the reader's
};

}  // namespace argil
