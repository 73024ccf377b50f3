// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "argil/core/result.h"

namespace argil::io {

inline std::string_view as_text(std::span<const std::byte> bytes) noexcept {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Takes the next run of non-blank characters off the front of `rest`; empty at its end.
std::string_view take_token(std::string_view& rest) noexcept;

/// Decimal number, with or without sign and exponent. Too small to hold is 0, too large is
/// infinite; "nan" and "inf" are read as such. False when `token` is anything else.
bool read_number(std::string_view token, double& number) noexcept;
bool read_integer(std::string_view token, std::int64_t& number) noexcept;

/// `token` for an error message: in quotes, unprintable bytes as '?', long ones cut.
std::string in_quotes(std::string_view token);

/// Lines of a text, counted from 1. A carriage return before the newline is dropped.
class LineScan {
 public:
  explicit LineScan(std::string_view text) : rest_(text) {}

  /// The next line. With `continued`, a line ending in a backslash goes on in the next one.
  bool next(std::string_view& line, bool continued = false);

  /// Number of the line last returned (its first, when continued).
  std::int64_t number() const noexcept { return number_; }

 private:
  std::string_view take_physical_line() noexcept;
  std::string_view rest_;
  std::string joined_;
  std::int64_t number_ = 0;
  std::int64_t taken_ = 0;
};

/// bad_input "NAME:LINE: MESSAGE".
Error line_error(const std::string& name, std::int64_t line, const std::string& message);
/// bad_input "NAME: byte N: MESSAGE".
Error byte_error(const std::string& name, std::uint64_t byte, const std::string& message);

}  // namespace argil::io
