// SPDX-License-Identifier: GPL-3.0-or-later
#include "format/text_scan.h"

#include <charconv>
#include <limits>
#include <system_error>

namespace argil::io {
namespace {

bool is_text_space(char c) noexcept {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

/// Whether a number that does not fit is one too near zero, told from its spelling.
bool spells_tiny(std::string_view token) noexcept {
  const std::size_t exponent = token.find_first_of("eE");
  if (exponent != std::string_view::npos) return token.substr(exponent + 1).starts_with('-');
  return token.starts_with("0") || token.starts_with("-0") || token.starts_with(".");
}

/// from_chars takes no plus sign, which many programs write.
std::string_view without_plus(std::string_view token) noexcept {
  const bool plus = token.size() > 1 && token[0] == '+' && token[1] != '-' && token[1] != '+';
  return plus ? token.substr(1) : token;
}

}  // namespace

std::string_view as_ascii(std::span<const std::byte> bytes, std::string& decoded) {
  const std::string_view text = as_text(bytes);
  if (text.starts_with("\xEF\xBB\xBF")) return text.substr(3);
  const bool is_big = text.starts_with("\xFE\xFF");
  if (!is_big && !text.starts_with("\xFF\xFE")) return text;
  decoded.clear();
  decoded.reserve(text.size() / 2);
  for (std::size_t n = 2; n + 1 < text.size(); n += 2) {
    const char low = text[is_big ? n + 1 : n];
    const bool is_ascii = text[is_big ? n : n + 1] == '\0' && (low & 0x80) == 0;
    decoded += is_ascii ? low : '?';
  }
  // Half a character is none that a text could end in.
  if (text.size() % 2 != 0) decoded += '\0';
  return decoded;
}

std::string_view take_token(std::string_view& rest) noexcept {
  std::size_t begin = 0;
  while (begin < rest.size() && is_text_space(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !is_text_space(rest[end])) ++end;
  const std::string_view token = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return token;
}

bool read_number(std::string_view token, double& number) noexcept {
  token = without_plus(token);
  const char* const end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, number);
  if (stop != end || token.empty()) return false;
  if (error == std::errc::result_out_of_range) {
    number = spells_tiny(token) ? 0.0 : std::numeric_limits<double>::infinity();
    return true;
  }
  return error == std::errc{};
}

bool read_integer(std::string_view token, std::int64_t& number) noexcept {
  token = without_plus(token);
  const char* const end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, number);
  return stop == end && !token.empty() && error == std::errc{};
}

std::string in_quotes(std::string_view token) {
  constexpr std::size_t kLongest = 40;
  std::string text = "'";
  for (const char c : token.substr(0, kLongest)) text += (c >= ' ' && c <= '~') ? c : '?';
  return text + (token.size() > kLongest ? "...'" : "'");
}

char line_end_of(std::string_view text) noexcept {
  const bool is_old =
      text.find('\n') == std::string_view::npos && text.find('\r') != std::string_view::npos;
  return is_old ? '\r' : '\n';
}

std::string_view LineScan::take_physical_line() noexcept {
  const std::size_t newline = rest_.find(end_);
  std::string_view line = rest_.substr(0, newline);
  rest_.remove_prefix(newline == std::string_view::npos ? rest_.size() : newline + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  ++taken_;
  return line;
}

bool LineScan::next(std::string_view& line, bool continued) {
  if (rest_.empty()) return false;
  line = take_physical_line();
  number_ = taken_;
  if (!continued || !line.ends_with('\\')) return true;
  joined_.clear();
  while (line.ends_with('\\')) {
    joined_.append(line.substr(0, line.size() - 1)).append(" ");
    if (rest_.empty()) {
      line = {};
      break;
    }
    line = take_physical_line();
  }
  joined_.append(line);
  line = joined_;
  return true;
}

Error line_error(const std::string& name, std::int64_t line, const std::string& message) {
  return {ErrorKind::bad_input, name + ":" + std::to_string(line) + ": " + message};
}

Error byte_error(const std::string& name, std::uint64_t byte, const std::string& message) {
  return {ErrorKind::bad_input, name + ": byte " + std::to_string(byte) + ": " + message};
}

}  // namespace argil::io
