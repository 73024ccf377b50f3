// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/gmp_memory.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string_view>

#include <gmp.h>
#include <unistd.h>

#include "argil/core/end_slot.h"

namespace argil::mesh {
namespace {

alignas(std::max_align_t) std::array<std::byte, kGmpStoreBytes> g_gmp_store;
std::atomic<std::size_t> g_gmp_taken{0};

bool is_in_store(const void* block) noexcept {
  const auto* at = static_cast<const std::byte*>(block);
  const std::less<> is_before;
  return !is_before(at, g_gmp_store.data()) &&
         is_before(at, g_gmp_store.data() + g_gmp_store.size());
}

/// That so many numbers fit without a single `new` among them is not known to happen; GMP cannot be
/// told that they do not.
[[noreturn]] void end_without_memory() noexcept {
  constexpr std::string_view kWords =
      "argil: out of memory for exact numbers; raise --max-memory or use a smaller mesh\n";
  if (::write(STDERR_FILENO, kWords.data(), kWords.size()) < 0) errno = 0;  // nobody to tell
  end_forced(SIGABRT);
}

void* taken_from_store(std::size_t bytes) noexcept {
  constexpr std::size_t kStep = alignof(std::max_align_t);
  // Before rounding up, which could overflow.
  if (bytes > kGmpStoreBytes) end_without_memory();
  const std::size_t whole = (bytes + kStep - 1) / kStep * kStep;
  const std::size_t at = g_gmp_taken.fetch_add(whole);
  if (at > kGmpStoreBytes - whole) end_without_memory();
  return g_gmp_store.data() + at;
}

void* allocate_number(std::size_t bytes) noexcept {
  void* block = std::malloc(bytes);
  return block != nullptr ? block : taken_from_store(bytes);
}

/// Blocks of the store are never reused: it only bridges the time until an allocation in C++ fails.
void free_number(void* block, std::size_t /*bytes*/) noexcept {
  if (!is_in_store(block)) std::free(block);
}

/// When realloc fails the old block is as it was, so that its number can still be copied.
void* resize_number(void* block, std::size_t old_bytes, std::size_t bytes) noexcept {
  if (!is_in_store(block)) {
    if (void* resized = std::realloc(block, bytes); resized != nullptr) return resized;
  }
  void* moved = allocate_number(bytes);
  std::memcpy(moved, block, std::min(old_bytes, bytes));
  free_number(block, old_bytes);
  return moved;
}

}  // namespace

bool gives_gmp_memory() noexcept {
  mp_set_memory_functions(allocate_number, resize_number, free_number);
  return true;
}

}  // namespace argil::mesh
