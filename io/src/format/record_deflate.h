// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "file/unwritten_bytes.h"

namespace argil::io {

/// Text of records whose fields mostly begin as they did in the record before, such as tables of
/// numbers, and the same deflated. Where a match may begin, and how far back, is known without a
/// search: each field is held against the same field of the record before. What is equal becomes a
/// match, the rest literals; one block with a Huffman code of its own holds all of it.
///
/// Shapes       up to kMostFields fields a record. A field that comes again after more than 32 KB
///              is written as if it were new. The same calls give the same bytes.
/// Threads      one; others may fill theirs beside it.
/// Cost         45 ns a field with its number, against 110 with zlib's fastest, whose result is
///              three tenths larger (vertices and triangles of the bunny, split in sixteen).
/// Source       P. Deutsch, RFC 1951.
class RecordDeflate {
 public:
  static constexpr std::size_t kMostFields = 8;

  /// Forgets everything but the memory.
  void clear();
  /// Appends fixed text and, as part of the same field, a number in its shortest form.
  template <class Number>
  void field(std::size_t n, std::string_view before, Number value) {
    char* at = room(n, before);
    at = std::to_chars(at, at + kLongestNumber, value).ptr;
    end_field(n, static_cast<std::size_t>(at - text_.data()));
  }
  /// Appends fixed text as a field.
  void field(std::size_t n, std::string_view text) {
    const char* const at = room(n, text);
    end_field(n, static_cast<std::size_t>(at - text_.data()));
  }

  std::string_view text() const noexcept { return {text_.data(), size_}; }
  /// The text as a block of deflate, and an empty stored one, so that it ends at a byte. Not the
  /// last of a stream, and refers to nothing before it.
  std::string_view packed();

 private:
  static constexpr std::size_t kLongestNumber = 32;
  /// Literals, and then a match; of a length of 0: none.
  struct Run {
    std::uint32_t literals = 0;
    std::uint16_t length = 0;
    std::uint16_t distance = 0;
  };
  struct Field {
    std::size_t at = 0;
    std::size_t size = 0;
  };

  char* room(std::size_t n, std::string_view before) {
    assert(n < kMostFields);
    static_cast<void>(n);
    const std::size_t most = before.size() + kLongestNumber;
    if (text_.size() - size_ < most) text_.resize(2 * text_.size() + most + (1U << 16));
    std::memcpy(text_.data() + size_, before.data(), before.size());
    return text_.data() + size_ + before.size();
  }
  void end_field(std::size_t n, std::size_t end);
  void add_match(std::size_t length, std::size_t distance, bool follows_at_once);

  UnwrittenText text_;
  std::size_t size_ = 0;
  std::array<Field, kMostFields> before_{};
  bool is_whole_ = false;       ///< the last field was a match to its end
  std::uint32_t literals_ = 0;  ///< since the last match
  std::vector<Run> runs_;
  std::array<std::uint32_t, 286> letters_{};   ///< how many of each literal and length
  std::array<std::uint32_t, 30> distances_{};  ///< and of each distance
  UnwrittenText packed_;
};

}  // namespace argil::io
