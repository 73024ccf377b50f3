// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/core/hash.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace argil {
namespace {

std::uint64_t hash_of(std::string_view text) {
  Hash64 hash;
  hash.update(std::as_bytes(std::span(text)));
  return hash.digest();
}

TEST(Hash64, MatchesPublishedVectors) {
  EXPECT_EQ(Hash64().digest(), 0xEF46DB3751D8E999U);
  EXPECT_EQ(hash_of(""), 0xEF46DB3751D8E999U);
  EXPECT_EQ(hash_of("a"), 0xD24EC4F1A98C6E5BU);
  EXPECT_EQ(hash_of("abc"), 0x44BC2CF5AD770999U);
  EXPECT_EQ(hash_of("Nobody inspects the spammish repetition"), 0xFBCEA83C8A378BF1U);
}

TEST(Hash64, DoesNotDependOnHowTheBytesAreCut) {
  std::string text(1000, ' ');
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>('a' + i * i % 23);
  const std::uint64_t whole = hash_of(text);
  for (const std::size_t piece : {1U, 7U, 31U, 32U, 33U, 999U}) {
    Hash64 hash;
    for (std::size_t at = 0; at < text.size(); at += piece) {
      hash.update(std::as_bytes(std::span(text).subspan(at, std::min(piece, text.size() - at))));
    }
    EXPECT_EQ(hash.digest(), whole) << piece;
  }
}

TEST(Hash64, GoesOnAfterADigestAndAfterACopy) {
  Hash64 hash;
  hash.update(std::as_bytes(std::span(std::string_view("ab"))));
  const std::uint64_t half = hash.digest();
  EXPECT_EQ(half, hash_of("ab"));
  Hash64 copy = hash;
  hash.update(std::as_bytes(std::span(std::string_view("c"))));
  EXPECT_EQ(hash.digest(), hash_of("abc"));
  EXPECT_EQ(copy.digest(), half);
}

}  // namespace
}  // namespace argil
