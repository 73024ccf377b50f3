// SPDX-License-Identifier: GPL-3.0-or-later
// Files that a forced end takes back: a table of fixed size, since a signal handler may neither
// allocate nor lock.
#include "argil/core/end_slot.h"

#include <array>
#include <atomic>
#include <cassert>
#include <climits>
#include <cstring>
#include <string>

#include <sys/stat.h>
#include <unistd.h>

namespace argil {
namespace {

namespace fs = std::filesystem;
using PathText = std::array<char, PATH_MAX>;

// What the signal handler may touch: fixed memory and lock-free atomics only.
struct Slot {
  std::atomic<bool> taken{false};  // owned by some EndSlot
  std::atomic<bool> armed{false};  // the rest is complete
  PathText file{};
  off_t bytes = 0;
  PathText witness{};  // "": none
  dev_t device = 0;    // of the witness, as the next
  ino_t inode = 0;
};
std::array<Slot, EndSlot::kEndSlots> g_slots;
std::atomic<bool> g_is_end_forced{false};
static_assert(std::atomic<bool>::is_always_lock_free);

bool fits(const fs::path& file) { return file.native().size() + 1 <= PATH_MAX; }

void copy_path(const fs::path& file, PathText& text) {
  assert(fits(file));
  std::memcpy(text.data(), file.c_str(), file.native().size() + 1);
}

std::size_t take_slot() {
  for (std::size_t n = 0; n < g_slots.size(); ++n) {
    if (!g_slots[n].taken.exchange(true)) return n;
  }
  return g_slots.size();
}

/// A save renames a new file over the witness: another inode under its name. What stands beside
/// belongs to that save then, and stays.
bool is_replaced(const Slot& slot) {
  if (slot.witness[0] == '\0') return false;
  struct stat now {};
  return ::stat(slot.witness.data(), &now) != 0 || now.st_dev != slot.device ||
         now.st_ino != slot.inode;
}

void take_back(const Slot& slot) {
  // Nobody can be told where that fails.
  if (slot.bytes == 0) {
    ::unlink(slot.file.data());
  } else if (::truncate(slot.file.data(), slot.bytes) != 0) {
    return;
  }
}

}  // namespace

EndSlot::EndSlot(const fs::path& file) : EndSlot(file, 0, {}) {}

EndSlot::EndSlot(const fs::path& file, std::size_t bytes, const fs::path& witness) {
  struct stat info {};
  if (!fits(file) || !fits(witness)) return;
  if (!witness.empty() && ::stat(witness.c_str(), &info) != 0) return;
  const std::size_t n = take_slot();
  if (n == kNone) return;
  slot_ = n;
  Slot& slot = g_slots[n];
  copy_path(file, slot.file);
  copy_path(witness, slot.witness);
  slot.bytes = static_cast<off_t>(bytes);
  slot.device = info.st_dev;
  slot.inode = info.st_ino;
  // Last: a signal may come between any two of these lines.
  slot.armed.store(true);
}

EndSlot::~EndSlot() {
  if (slot_ == kNone) return;
  // Before the slot is free: its next owner fills it in, and a signal meanwhile must not act on
  // half of a path.
  g_slots[slot_].armed.store(false);
  g_slots[slot_].taken.store(false);
}

bool is_end_forced() noexcept { return g_is_end_forced.load(); }

void end_forced(int signal_number) noexcept {
  if (g_is_end_forced.exchange(true)) {
    for (;;) ::pause();  // another thread is at it
  }
  // All witnesses before any of them is removed: a file may be its own.
  std::array<bool, EndSlot::kEndSlots> due{};
  for (std::size_t n = 0; n < g_slots.size(); ++n) {
    due[n] = g_slots[n].armed.load() && !is_replaced(g_slots[n]);
  }
  // Those that are cut last: who was writing there has had the most time to see that it is over.
  for (const bool cuts : {false, true}) {
    for (std::size_t n = 0; n < g_slots.size(); ++n) {
      if (due[n] && (g_slots[n].bytes > 0) == cuts) take_back(g_slots[n]);
    }
  }
  // As shells report the end by a signal.
  constexpr int kSignalStatus = 128;
  ::_exit(kSignalStatus + signal_number);
}

}  // namespace argil
