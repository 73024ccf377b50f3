// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#include <sys/mman.h>

namespace argil::io {

/// Memory that is about to be written as a whole: not filled with zeros first, and asked for in
/// pages of 2 MB where it is large, since the first touch of 4 KB costs as much as copying them.
template <class T>
struct UnwrittenAllocator {
  using value_type = T;
  static constexpr std::size_t kPage = std::size_t{1} << 21;

  UnwrittenAllocator() noexcept = default;
  template <class U>
  UnwrittenAllocator(const UnwrittenAllocator<U>&) noexcept {}

  T* allocate(std::size_t count) {
    if (count > (static_cast<std::size_t>(-1) - kPage) / sizeof(T)) throw std::bad_alloc();
    const std::size_t bytes = count * sizeof(T);
    if (bytes < 2 * kPage) return static_cast<T*>(::operator new(bytes));
    const std::size_t whole = (bytes + kPage - 1) / kPage * kPage;
    void* const at = std::aligned_alloc(kPage, whole);
    if (at == nullptr) throw std::bad_alloc();
    // Where the system refuses, the pages are small.
    static_cast<void>(::madvise(at, whole, MADV_HUGEPAGE));
    return static_cast<T*>(at);
  }
  void deallocate(T* at, std::size_t count) noexcept {
    if (count * sizeof(T) < 2 * kPage) return ::operator delete(at);
    std::free(at);
  }
  template <class U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }

  friend bool operator==(const UnwrittenAllocator&, const UnwrittenAllocator&) noexcept {
    return true;
  }
};

/// Bytes that a resize makes, and does not write.
using UnwrittenBytes = std::vector<std::byte, UnwrittenAllocator<std::byte>>;
using UnwrittenText = std::vector<char, UnwrittenAllocator<char>>;

}  // namespace argil::io
