// SPDX-License-Identifier: GPL-3.0-or-later
// Names as in RFC 1321: blocks of 64 bytes, each taken in by 64 steps in four rounds, change a
// state of four words A, B, C, D. Words have their low byte first.
#include "base/md5.h"

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>

namespace argil::viewer {
namespace {

using Md5State = std::array<std::uint32_t, 4>;
constexpr std::size_t kMd5Block = 64;

/// The whole part of 2^32 |sin(n + 1)|.
constexpr std::array<std::uint32_t, 64> kMd5Sines{
    0xd76aa478, 0xe8c7b756, 0x242070db, 0xc1bdceee, 0xf57c0faf, 0x4787c62a, 0xa8304613, 0xfd469501,
    0x698098d8, 0x8b44f7af, 0xffff5bb1, 0x895cd7be, 0x6b901122, 0xfd987193, 0xa679438e, 0x49b40821,
    0xf61e2562, 0xc040b340, 0x265e5a51, 0xe9b6c7aa, 0xd62f105d, 0x02441453, 0xd8a1e681, 0xe7d3fbc8,
    0x21e1cde6, 0xc33707d6, 0xf4d50d87, 0x455a14ed, 0xa9e3e905, 0xfcefa3f8, 0x676f02d9, 0x8d2a4c8a,
    0xfffa3942, 0x8771f681, 0x6d9d6122, 0xfde5380c, 0xa4beea44, 0x4bdecfa9, 0xf6bb4b60, 0xbebfbc70,
    0x289b7ec6, 0xeaa127fa, 0xd4ef3085, 0x04881d05, 0xd9d4d039, 0xe6db99e5, 0x1fa27cf8, 0xc4ac5665,
    0xf4292244, 0x432aff97, 0xab9423a7, 0xfc93a039, 0x655b59c3, 0x8f0ccc92, 0xffeff47d, 0x85845dd1,
    0x6fa87e4f, 0xfe2ce6e0, 0xa3014314, 0x4e0811a1, 0xf7537e82, 0xbd3af235, 0x2ad7d2bb, 0xeb86d391};

constexpr std::array<std::array<int, 4>, 4> kMd5Turns{
    {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}}};

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t n = 4; n-- > 0;) {
    word = word << 8U | static_cast<unsigned char>(bytes[at + n]);
  }
  return word;
}

/// What a step mixes of B, C and D, and the word of the block that it takes in.
struct Md5Mix {
  std::uint32_t bits;
  std::size_t word;
};
Md5Mix mix_of(std::size_t step, const Md5State& s) {
  const auto [a, b, c, d] = s;
  switch (step / 16) {
    case 0:
      return {(b & c) | (~b & d), step};
    case 1:
      return {(b & d) | (c & ~d), (5 * step + 1) % 16};
    case 2:
      return {b ^ c ^ d, (3 * step + 5) % 16};
    default:
      return {c ^ (b | ~d), (7 * step) % 16};
  }
}

void take_block(std::string_view block, Md5State& state) {
  assert(block.size() == kMd5Block);
  Md5State s = state;
  for (std::size_t step = 0; step < 64; ++step) {
    const Md5Mix mix = mix_of(step, s);
    const std::uint32_t sum = s[0] + mix.bits + kMd5Sines[step] + word_at(block, 4 * mix.word);
    s = {s[3], s[1] + std::rotl(sum, kMd5Turns[step / 16][step % 4]), s[1], s[2]};
  }
  for (std::size_t n = 0; n < 4; ++n) state[n] += s[n];
}

}  // namespace

std::string md5_of(std::string_view bytes) {
  Md5State state{0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476};
  const std::size_t whole = bytes.size() / kMd5Block * kMd5Block;
  for (std::size_t at = 0; at < whole; at += kMd5Block) {
    take_block(bytes.substr(at, kMd5Block), state);
  }
  // The rest, a bit that is set, and how many bits there were, in one block or two.
  std::string rest(bytes.substr(whole));
  rest += static_cast<char>(0x80);
  rest.resize(rest.size() <= kMd5Block - 8 ? kMd5Block - 8 : 2 * kMd5Block - 8, '\0');
  const std::uint64_t bits = 8 * std::uint64_t{bytes.size()};
  for (unsigned shift = 0; shift < 64; shift += 8) rest += static_cast<char>(bits >> shift & 0xFFU);
  for (std::size_t at = 0; at < rest.size(); at += kMd5Block) {
    take_block(std::string_view(rest).substr(at, kMd5Block), state);
  }
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string digits;
  for (const std::uint32_t word : state) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
      const std::uint32_t byte = word >> shift & 0xFFU;
      digits += kDigits[byte >> 4U];
      digits += kDigits[byte & 0xFU];
    }
  }
  return digits;
}

}  // namespace argil::viewer
