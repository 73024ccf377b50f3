// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "argil/core/vec3.h"

namespace argil::haptics {

// The fields of a message as they lie on the wire: little-endian, binary32 and binary64, without
// padding. Both streams have the same field(value), so that a layout is written once for both.

/// Writes fields one after the other; the caller has made room.
class FieldWriter {
 public:
  explicit FieldWriter(std::span<std::byte> bytes) noexcept : bytes_(bytes) {}

  void field(std::uint16_t value) noexcept { put(value); }
  void field(std::uint32_t value) noexcept { put(value); }
  void field(std::uint64_t value) noexcept { put(value); }
  void field(std::int32_t value) noexcept { put(std::bit_cast<std::uint32_t>(value)); }
  void field(float value) noexcept { put(std::bit_cast<std::uint32_t>(value)); }
  void field(double value) noexcept { put(std::bit_cast<std::uint64_t>(value)); }

  /// The bytes of a text without its length.
  void text(const std::string& text) noexcept {
    assert(at_ + text.size() <= bytes_.size());
    for (const char letter : text) bytes_[at_++] = static_cast<std::byte>(letter);
  }

  std::size_t size() const noexcept { return at_; }

 private:
  template <class Number>
  void put(Number value) noexcept {
    assert(at_ + sizeof(Number) <= bytes_.size());
    const auto wide = static_cast<std::uint64_t>(value);
    for (std::size_t n = 0; n < sizeof(Number); ++n) {
      bytes_[at_++] = static_cast<std::byte>(wide >> (8 * n));
    }
  }
  std::span<std::byte> bytes_;
  std::size_t at_ = 0;
};

/// Reads them in the same order; the caller has checked the length.
class FieldReader {
 public:
  FieldReader(std::span<const std::byte> bytes, double most_number) noexcept
      : bytes_(bytes), most_number_(most_number) {}

  void field(std::uint16_t& value) noexcept { value = take<std::uint16_t>(); }
  void field(std::uint32_t& value) noexcept { value = take<std::uint32_t>(); }
  void field(std::uint64_t& value) noexcept { value = take<std::uint64_t>(); }
  void field(std::int32_t& value) noexcept {
    value = std::bit_cast<std::int32_t>(take<std::uint32_t>());
  }
  void field(float& value) noexcept {
    value = std::bit_cast<float>(take<std::uint32_t>());
    see(static_cast<double>(value));
  }
  void field(double& value) noexcept {
    value = std::bit_cast<double>(take<std::uint64_t>());
    see(value);
  }

  /// As many bytes as it has room for.
  void text(std::string& text) noexcept {
    assert(at_ + text.size() <= bytes_.size());
    for (char& letter : text) letter = static_cast<char>(bytes_[at_++]);
  }

  /// Whether all numbers so far were finite and within `most_number`.
  bool is_good() const noexcept { return is_good_; }

 private:
  template <class Number>
  Number take() noexcept {
    assert(at_ + sizeof(Number) <= bytes_.size());
    std::uint64_t wide = 0;
    for (std::size_t n = 0; n < sizeof(Number); ++n) {
      wide |= static_cast<std::uint64_t>(bytes_[at_++]) << (8 * n);
    }
    return static_cast<Number>(wide);
  }
  void see(double value) noexcept {
    is_good_ = is_good_ && std::abs(value) <= most_number_;  // also no NaN
  }
  std::span<const std::byte> bytes_;
  double most_number_;
  std::size_t at_ = 0;
  bool is_good_ = true;
};

template <class Stream>
void field(Stream& stream, Vec3& v) noexcept {
  stream.field(v.x);
  stream.field(v.y);
  stream.field(v.z);
}

}  // namespace argil::haptics
