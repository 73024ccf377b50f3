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

/// The ASCII of a text: of UTF-16 that begins with its mark each character beyond ASCII as '?', in
/// `decoded`; else the bytes themselves, without the mark of UTF-8.
std::string_view as_ascii(std::span<const std::byte> bytes, std::string& decoded);

/// Takes the next run of non-blank characters off the front of `rest`; empty at its end.
std::string_view take_token(std::string_view& rest) noexcept;

/// Decimal number, with or without sign and exponent. Too small to hold is 0, too large is
/// infinite; "nan" and "inf" are read as such. False when `token` is anything else.
bool read_number(std::string_view token, double& number) noexcept;
bool read_integer(std::string_view token, std::int64_t& number) noexcept;

/// `token` for an error message: in quotes, unprintable bytes as '?', long ones cut.
std::string in_quotes(std::string_view token);

/// What ends the lines of a text: a newline, or a carriage return where there is no newline, as on
/// old Macs.
char line_end_of(std::string_view text) noexcept;

/// Lines of a text, counted from 1. A carriage return before a newline is dropped.
class LineScan {
 public:
  explicit LineScan(std::string_view text) : LineScan(text, line_end_of(text)) {}
  LineScan(std::string_view text, char end) : text_(text), rest_(text), end_(end) {}

  /// The next line. With `continued`, a line ending in a backslash goes on in the next one.
  bool next(std::string_view& line, bool continued = false);

  /// Number of the line last returned (its first, when continued).
  std::int64_t number() const noexcept { return number_; }
  /// Where what follows that line begins.
  std::size_t end_of_line() const noexcept { return text_.size() - rest_.size(); }

 private:
  std::string_view take_physical_line() noexcept;
  std::string_view text_;
  std::string_view rest_;
  char end_;
  std::string joined_;
  std::int64_t number_ = 0;
  std::int64_t taken_ = 0;
};

/// bad_input "NAME:LINE: MESSAGE".
Error line_error(const std::string& name, std::int64_t line, const std::string& message);
/// bad_input "NAME: byte N: MESSAGE".
Error byte_error(const std::string& name, std::uint64_t byte, const std::string& message);

}  // namespace argil::io
