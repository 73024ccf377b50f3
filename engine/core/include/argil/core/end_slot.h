// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <utility>

namespace argil {

/// A file that a forced end of the program takes back: a second signal, or the time after the first
/// one that `end_within` gives (safe_file.h). Ends with the object. There are kEndSlots of them, in
/// memory that a signal handler may read; one more, or a path beyond PATH_MAX, is not taken back,
/// and nothing else goes wrong.
///
/// Errors       none: an object without a slot does nothing
///              (EndSlot.HasRoomForSoManyAndGoesWithoutMore).
/// Threads      any; slots are taken by atomic exchange. One object belongs to one thread.
/// Cost         at most kEndSlots atomic exchanges; a slot is two paths of PATH_MAX bytes, static.
class EndSlot {
 public:
  /// Files that can be held at the same time by the whole program.
  static constexpr std::size_t kEndSlots = 32;

  /// Holds no file.
  EndSlot() = default;
  /// Holds `file`, which a forced end removes.
  explicit EndSlot(const std::filesystem::path& file);
  /// Holds `file`, which a forced end cuts to its first `bytes` bytes, or removes when that is 0;
  /// but only while `witness`, which must exist, is still the same file (device and inode). An
  /// empty `witness` asks for nothing (EndSlot.LeavesWhatBelongsToAReplacedWitness).
  EndSlot(const std::filesystem::path& file, std::size_t bytes,
          const std::filesystem::path& witness);
  /// Moving hands the slot over; assignment swaps, so `other` frees what this held.
  EndSlot(EndSlot&& other) noexcept : slot_(std::exchange(other.slot_, kNone)) {}
  EndSlot& operator=(EndSlot&& other) noexcept {
    std::swap(slot_, other.slot_);
    return *this;
  }
  /// From here on the file stays whatever happens.
  ~EndSlot();

 private:
  static constexpr std::size_t kNone = kEndSlots;
  std::size_t slot_ = kNone;
};

/// True once end_forced was called: what is made now would be left behind.
bool is_end_forced() noexcept;

/// Takes back all files and ends the program with the status of a signal, 128 + `signal_number`.
///
/// Threads      in signal handlers that no other interrupts: it uses fixed memory, lock-free
///              atomics and plain system calls only. A second caller waits for the end of the
///              first.
[[noreturn]] void end_forced(int signal_number) noexcept;

}  // namespace argil
