// SPDX-License-Identifier: GPL-3.0-or-later
#include "format/record_deflate.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <zlib.h>

namespace argil::io {
namespace {

/// What zlib makes of blocks that are not the last.
std::string unpacked(std::string_view blocks) {
  // An empty block with the code that the format fixes: the last.
  const std::string whole = std::string(blocks) + std::string("\x03\x00", 2);
  std::string text(std::size_t{1} << 22, '\0');
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, -MAX_WBITS), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(whole.data()));
  stream.avail_in = static_cast<uInt>(whole.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END) << (stream.msg ? stream.msg : "");
  EXPECT_EQ(stream.avail_in, 0U);
  text.resize(stream.total_out);
  inflateEnd(&stream);
  return text;
}

TEST(RecordDeflate, UnpacksToItsText) {
  RecordDeflate records;
  std::string text;
  for (int i = 0; i < 5000; ++i) {
    const float x = 12.5F + 1e-3F * static_cast<float>(i % 70);
    records.field(0, "<vertex x=\"", x);
    records.field(1, "\" y=\"", 1e-3F * static_cast<float>(i));
    records.field(2, "\"/>\n");
    std::array<char, 64> digits{};
    const auto shortest = [&](float value) {
      return std::string(digits.data(), std::to_chars(digits.data(), digits.end(), value).ptr);
    };
    text += "<vertex x=\"" + shortest(x);
    text += "\" y=\"" + shortest(1e-3F * static_cast<float>(i)) + "\"/>\n";
  }
  EXPECT_EQ(records.text(), text);
  const std::string_view packed = records.packed();
  EXPECT_EQ(unpacked(packed), text);
  EXPECT_LT(packed.size(), text.size() / 5);
}

/// Fields of any bytes and lengths: whole ones again, parts of others, none at all, and blocks one
/// after the other from the same memory.
TEST(RecordDeflateProperty, UnpacksToItsTextWhateverFieldsAre) {
  std::mt19937 engine(20261127);
  const auto random = [&] { return static_cast<unsigned>(engine()); };
  RecordDeflate records;
  std::string blocks;
  std::string text;
  for (int block = 0; block < 40; ++block) {
    records.clear();
    std::string own;
    const unsigned letters = 1U + random() % 256;
    std::vector<std::string> before(RecordDeflate::kMostFields);
    for (unsigned count = random() % 2000; count > 0; --count) {
      const std::size_t n = random() % before.size();
      std::string field = before[n].substr(0, random() % (before[n].size() + 2));
      while (field.size() < 150 && random() % 4 != 0) {
        field += static_cast<char>(random() % letters);
      }
      records.field(n, field);
      own += field;
      before[n] = std::move(field);
    }
    ASSERT_EQ(records.text(), own);
    blocks += records.packed();
    text += own;
  }
  EXPECT_EQ(unpacked(blocks), text);
}

/// Each letter as often as all before it together makes the deepest trees: deeper than the longest
/// word of the format.
TEST(RecordDeflate, KeepsToTheLongestWordOfTheFormat) {
  std::string letters;
  std::size_t count = 1;
  for (char c = 'a'; c < 'a' + 18; ++c, count *= 2) letters.append(count, c);
  std::shuffle(letters.begin(), letters.end(), std::mt19937(7));
  RecordDeflate records;
  for (std::size_t at = 0; at < letters.size(); at += 2) {
    records.field(at / 2 % 8, std::string_view(letters).substr(at, 2));  // too short to match
  }
  EXPECT_EQ(unpacked(records.packed()), letters);
}

/// A match reaches back 32 768 bytes at most, and 258 is its longest.
TEST(RecordDeflate, WritesFieldsAnewThatAreTooFarBackOrLong) {
  const std::string longest(1000, 'x');
  RecordDeflate records;
  std::string text;
  const auto add = [&](std::size_t n, const std::string& field) {
    records.field(n, field);
    text += field;
  };
  add(0, "the first of all");
  for (int i = 0; i < 2000; ++i) add(1, "some text of " + std::to_string(i * 7919));
  ASSERT_GT(text.size(), 32768U);
  add(0, "the first of all");
  for (int i = 0; i < 3; ++i) add(2, longest);
  EXPECT_EQ(records.text(), text);
  EXPECT_EQ(unpacked(records.packed()), text);
}

TEST(RecordDeflate, OfNothingIsABlockOfNothing) {
  RecordDeflate records;
  EXPECT_EQ(unpacked(records.packed()), "");
}

}  // namespace
}  // namespace argil::io
