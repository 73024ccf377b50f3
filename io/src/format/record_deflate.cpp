// SPDX-License-Identifier: GPL-3.0-or-later
// Notation: a symbol is what a code word stands for; those of literals are their bytes, 256 ends
// the block, those above are lengths. Sections are of RFC 1951.
#include "format/record_deflate.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace argil::io {
namespace {

constexpr std::size_t kLeastMatch = 3;
constexpr std::size_t kMostMatch = 258;
constexpr std::size_t kFarthestMatch = 32768;
constexpr std::size_t kEndOfBlock = 256;
constexpr int kLongestWord = 15;       // of a code
constexpr int kLongestLengthWord = 7;  // of the code for lengths of words

/// A symbol and what of a value it leaves to further bits (3.2.5).
struct Share {
  std::uint16_t symbol = 0;
  std::uint16_t least = 0;  ///< value that the symbol stands for with further bits of 0
  int bits = 0;
};

/// Of each length of a match.
constexpr std::array<Share, kMostMatch + 1> kOfLength = [] {
  std::array<Share, kMostMatch + 1> shares{};
  std::size_t length = kLeastMatch;
  for (std::uint16_t symbol = 257; symbol < 285; ++symbol) {
    const int bits = symbol < 265 ? 0 : (symbol - 261) / 4;
    const auto least = static_cast<std::uint16_t>(length);
    for (std::size_t end = length + (1U << bits); length < end; ++length) {
      shares[length] = {symbol, least, bits};
    }
  }
  shares[kMostMatch] = {285, kMostMatch, 0};
  return shares;
}();

Share share_of_distance(std::size_t distance) noexcept {
  const auto from_1 = static_cast<std::uint32_t>(distance - 1);
  if (from_1 < 2)
    return {static_cast<std::uint16_t>(from_1), static_cast<std::uint16_t>(distance), 0};
  const int high = std::bit_width(from_1) - 1;
  const std::uint32_t half = from_1 >> (high - 1) & 1U;
  return {static_cast<std::uint16_t>(2U * static_cast<std::uint32_t>(high) + half),
          static_cast<std::uint16_t>(((2U + half) << (high - 1)) + 1U), high - 1};
}

/// How many bytes from both places on are equal, of so many.
std::size_t equal_bytes(const char* a, const char* b, std::size_t most) noexcept {
  static_assert(std::endian::native == std::endian::little, "the first byte is the lowest");
  std::size_t n = 0;
  for (; n + 8 <= most; n += 8) {
    std::uint64_t first = 0;
    std::uint64_t second = 0;
    std::memcpy(&first, a + n, 8);
    std::memcpy(&second, b + n, 8);
    if (first != second) return n + static_cast<std::size_t>(std::countr_zero(first ^ second)) / 8;
  }
  while (n < most && a[n] == b[n]) ++n;
  return n;
}

/// A Huffman code: the word of each symbol, its first bit lowest, and how long it is; 0: none.
template <std::size_t kSymbols>
struct Code {
  std::array<std::uint16_t, kSymbols> word{};
  std::array<std::uint8_t, kSymbols> length{};
};

/// Depths in a Huffman tree over weights in ascending order; their greatest is returned. Of two
/// queues, the weights and the sums made of them, the lowest come first (J. van Leeuwen, 1976).
int tree_depths(const std::vector<std::uint32_t>& weights, std::vector<int>& depths) {
  const std::size_t count = weights.size();
  assert(count >= 2 && std::is_sorted(weights.begin(), weights.end()));
  std::vector<std::uint64_t> all(weights.begin(), weights.end());
  std::vector<std::size_t> parent(2 * count - 1);
  std::size_t leaf = 0;
  std::size_t sum = count;
  while (all.size() < 2 * count - 1) {
    std::uint64_t both = 0;
    for (int n = 0; n < 2; ++n) {
      const bool takes_leaf = leaf < count && (sum == all.size() || all[leaf] <= all[sum]);
      const std::size_t taken = takes_leaf ? leaf++ : sum++;
      both += all[taken];
      parent[taken] = all.size();
    }
    all.push_back(both);
  }
  depths.assign(all.size(), 0);
  for (std::size_t n = all.size() - 1; n-- > 0;) depths[n] = depths[parent[n]] + 1;
  return *std::max_element(depths.begin(), depths.end());
}

/// Lengths of words of at most so many bits: where the tree is deeper, that of flatter counts.
template <std::size_t kSymbols>
void choose_lengths(std::array<std::uint32_t, kSymbols> counts, int most, Code<kSymbols>& code) {
  for (;;) {
    std::vector<std::pair<std::uint32_t, std::size_t>> used;
    for (std::size_t s = 0; s < kSymbols; ++s) {
      if (counts[s] > 0) used.emplace_back(counts[s], s);
    }
    std::sort(used.begin(), used.end());
    std::vector<std::uint32_t> weights;
    for (const auto& [count, symbol] : used) weights.push_back(count);
    std::vector<int> depths;
    if (tree_depths(weights, depths) <= most) {
      for (std::size_t n = 0; n < used.size(); ++n) {
        code.length[used[n].second] = static_cast<std::uint8_t>(depths[n]);
      }
      return;
    }
    for (std::uint32_t& count : counts) count = (count + 1) / 2;
  }
}

/// Words by their lengths, in the order of the symbols (3.2.2).
template <std::size_t kSymbols>
void assign_words(Code<kSymbols>& code) {
  std::array<unsigned, kLongestWord + 2> next{};
  for (const std::uint8_t length : code.length) {
    if (length > 0) ++next[length + 1U];
  }
  for (std::size_t length = 1; length < next.size(); ++length) {
    next[length] = (next[length] + next[length - 1]) << 1;
  }
  for (std::size_t s = 0; s < kSymbols; ++s) {
    if (code.length[s] == 0) continue;
    unsigned word = next[code.length[s]]++;
    for (int bit = 0; bit < code.length[s]; ++bit, word >>= 1) {
      code.word[s] = static_cast<std::uint16_t>(code.word[s] << 1 | (word & 1U));
    }
  }
}

template <std::size_t kSymbols>
Code<kSymbols> code_for(const std::array<std::uint32_t, kSymbols>& counts, int most) {
  Code<kSymbols> code;
  choose_lengths(counts, most, code);
  assign_words(code);
  return code;
}

/// Bits, the first lowest. Writes eight bytes at a time, and counts those that are full.
class BitWriter {
 public:
  explicit BitWriter(char* to) : to_(to) {}

  /// Up to 56 bits between two calls of flush().
  void put(std::uint64_t bits, int count) noexcept {
    waiting_ |= bits << count_;
    count_ += count;
    assert(count_ < 64);
  }
  void flush() noexcept {
    std::memcpy(to_, &waiting_, 8);
    to_ += count_ >> 3;
    waiting_ >>= count_ & ~7;
    count_ &= 7;
  }
  /// To the next byte.
  char* close() noexcept {
    count_ = (count_ + 7) & ~7;
    flush();
    return to_;
  }

 private:
  char* to_;
  std::uint64_t waiting_ = 0;
  int count_ = 0;
};

using LetterCode = Code<286>;
using DistanceCode = Code<30>;

/// The lengths of the words of both codes, in a third one (3.2.7).
void put_codes(const LetterCode& letters, const DistanceCode& distances, BitWriter& out) {
  std::array<std::uint32_t, 19> counts{};
  for (const std::uint8_t length : letters.length) ++counts[length];
  for (const std::uint8_t length : distances.length) ++counts[length];
  const auto lengths = code_for(counts, kLongestLengthWord);
  out.put(letters.length.size() - 257, 5);
  out.put(distances.length.size() - 1, 5);
  out.put(counts.size() - 4, 4);
  constexpr std::array<std::size_t, 19> kOrder{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                               11, 4,  12, 3, 13, 2, 14, 1, 15};
  for (const std::size_t length : kOrder) {
    out.put(lengths.length[length], 3);
    out.flush();
  }
  const auto put_lengths = [&](const auto& code) {
    for (const std::uint8_t length : code.length) {
      out.put(lengths.word[length], lengths.length[length]);
      out.flush();
    }
  };
  put_lengths(letters);
  put_lengths(distances);
}

/// Words with the bits that follow them.
struct Word {
  std::uint32_t bits = 0;
  int count = 0;
};

class BlockWriter {
 public:
  BlockWriter(const LetterCode& letters, const DistanceCode& distances, BitWriter& out)
      : distances_(distances), out_(out) {
    for (std::size_t s = 0; s < literal_.size(); ++s) {
      literal_[s] = {letters.word[s], letters.length[s]};
    }
    for (std::size_t n = kLeastMatch; n <= kMostMatch; ++n) {
      const Share& share = kOfLength[n];
      const auto rest = static_cast<std::uint32_t>(n - share.least);
      const int count = letters.length[share.symbol];
      length_[n] = {letters.word[share.symbol] | rest << count, count + share.bits};
    }
  }

  void put_literals(const char* from, std::size_t count) noexcept {
    // Three words at most have 45 bits.
    for (; count >= 3; count -= 3, from += 3) {
      put(literal(from[0]));
      put(literal(from[1]));
      put(literal(from[2]));
      out_.flush();
    }
    for (; count > 0; --count) put(literal(*from++));
    out_.flush();
  }
  void put_match(std::size_t length, std::size_t distance) noexcept {
    const Share share = share_of_distance(distance);
    put(length_[length]);  // 20 bits at most, and 28 for the distance
    out_.put(distances_.word[share.symbol], distances_.length[share.symbol]);
    out_.put(distance - share.least, share.bits);
    out_.flush();
  }
  void put_end() noexcept {
    put(literal_[kEndOfBlock]);
    out_.flush();
  }

 private:
  const Word& literal(char c) const noexcept { return literal_[static_cast<unsigned char>(c)]; }
  void put(const Word& word) noexcept { out_.put(word.bits, word.count); }

  std::array<Word, kEndOfBlock + 1> literal_;
  std::array<Word, kMostMatch + 1> length_;
  const DistanceCode& distances_;
  BitWriter& out_;
};

}  // namespace

void RecordDeflate::clear() {
  size_ = 0;
  before_ = {};
  is_whole_ = false;
  literals_ = 0;
  runs_.clear();
  letters_ = {};
  distances_ = {};
}

void RecordDeflate::end_field(std::size_t n, std::size_t end) {
  assert(end >= size_);
  Field& before = before_[n];
  const char* const text = text_.data();
  const std::size_t size = end - size_;
  const std::size_t equal =
      equal_bytes(text + size_, text + before.at, std::min({size, before.size, kMostMatch}));
  std::size_t matched = 0;
  if (equal >= kLeastMatch && size_ - before.at <= kFarthestMatch) {
    matched = equal;
    add_match(equal, size_ - before.at, is_whole_);
  }
  is_whole_ = matched == size && matched > 0;
  for (std::size_t at = size_ + matched; at < end; ++at) {
    ++letters_[static_cast<unsigned char>(text[at])];
  }
  literals_ += static_cast<std::uint32_t>(size - matched);
  before = {size_, size};
  size_ = end;
}

/// One that goes on with the one before is part of it.
void RecordDeflate::add_match(std::size_t length, std::size_t distance, bool follows_at_once) {
  assert(distance > 0 && distance <= kFarthestMatch);
  if (follows_at_once) {
    Run& last = runs_.back();
    const std::size_t joined = last.length + length;
    if (last.distance == distance && joined <= kMostMatch) {
      --letters_[kOfLength[last.length].symbol];
      ++letters_[kOfLength[joined].symbol];
      last.length = static_cast<std::uint16_t>(joined);
      return;
    }
  }
  runs_.push_back(
      {literals_, static_cast<std::uint16_t>(length), static_cast<std::uint16_t>(distance)});
  literals_ = 0;
  ++letters_[kOfLength[length].symbol];
  ++distances_[share_of_distance(distance).symbol];
}

std::string_view RecordDeflate::packed() {
  // A code of fewer than two words is one that some readers refuse.
  letters_[kEndOfBlock] = 1;
  letters_[0] = std::max(letters_[0], 1U);
  distances_[0] = std::max(distances_[0], 1U);
  distances_[1] = std::max(distances_[1], 1U);
  const LetterCode letters = code_for(letters_, kLongestWord);
  const DistanceCode distances = code_for(distances_, kLongestWord);
  // No literal takes more than 15 bits, and no match more than its own three literals or more.
  constexpr std::size_t kOfCodes = 512;
  packed_.resize(std::max(packed_.size(), 2 * size_ + kOfCodes));
  BitWriter out(packed_.data());
  out.put(0, 1);  // not the last block
  out.put(2, 2);  // with codes of its own
  put_codes(letters, distances, out);
  BlockWriter block(letters, distances, out);
  const char* at = text_.data();
  for (const Run& run : runs_) {
    block.put_literals(at, run.literals);
    block.put_match(run.length, run.distance);
    at += run.literals + run.length;
  }
  block.put_literals(at, literals_);
  assert(at + literals_ == text_.data() + size_);
  block.put_end();
  // An empty stored block (3.2.4), whose lengths begin at a byte.
  out.put(0, 3);
  char* end = out.close();
  constexpr std::array<char, 4> kOfNothing{'\0', '\0', '\xff', '\xff'};
  end = std::copy(kOfNothing.begin(), kOfNothing.end(), end);
  assert(end <= packed_.data() + packed_.size());
  return {packed_.data(), static_cast<std::size_t>(end - packed_.data())};
}

}  // namespace argil::io
