// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstddef>
#include <cstring>
#include <span>

namespace argil::io {

/// A number, or an array of them, as it lies in memory; the bytes need not be aligned.
template <class T>
T load(const std::byte* at) noexcept {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}
template <class T>
T load(std::span<const std::byte> bytes, std::size_t at) noexcept {
  assert(at + sizeof(T) <= bytes.size());
  return load<T>(bytes.data() + at);
}

}  // namespace argil::io
