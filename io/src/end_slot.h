// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <utility>

namespace argil::io {

/// A file that a forced end of the program takes back: a second signal, or the time after the first
/// one that `end_within` gives (safe_file.h). Ends with the object. There are kEndSlots of them, in
/// memory that a signal handler may read; one more, or a path beyond PATH_MAX, is not taken back,
/// and nothing else goes wrong.
class EndSlot {
 public:
  static constexpr std::size_t kEndSlots = 32;

  EndSlot() = default;
  /// To be removed.
  explicit EndSlot(const std::filesystem::path& file);
  /// To be cut to its first `bytes`, 0: removed; as long as `witness`, which exists, was not
  /// replaced.
  EndSlot(const std::filesystem::path& file, std::size_t bytes,
          const std::filesystem::path& witness);
  EndSlot(EndSlot&& other) noexcept : slot_(std::exchange(other.slot_, kNone)) {}
  EndSlot& operator=(EndSlot&& other) noexcept {
    std::swap(slot_, other.slot_);
    return *this;
  }
  ~EndSlot();

 private:
  static constexpr std::size_t kNone = kEndSlots;
  std::size_t slot_ = kNone;
};

/// True once end_forced was called: what is made now would be left behind.
bool is_end_forced() noexcept;

/// Takes back all files and ends the program with the status of a signal. In signal handlers
/// that no other interrupts.
[[noreturn]] void end_forced(int signal_number) noexcept;

}  // namespace argil::io
