// SPDX-License-Identifier: GPL-3.0-or-later
// Small pictures with texts, which anybody may have written: thumbnails.
#include "format/png_text.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/image_file.h"
#include "argil/io/png.h"

#include "support/bytes/png_maker.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

using test::fill;
using test::PngMaker;
using testing::HasSubstr;

class PngTextRead : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_ / "a.png"; }

  static Image small_image() {
    Image image{3, 2, {}};
    for (int n = 0; n < 18; ++n) image.rgb.push_back(static_cast<std::uint8_t>(13 * n));
    return image;
  }
  static std::string packed(const std::vector<PngText>& texts) {
    const auto bytes = pack_png("a.png", small_image(), texts);
    EXPECT_TRUE(bytes) << bytes.error().message;
    return {reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size()};
  }
  Result<TextedImage> read(const std::string& bytes, int most_side = 16) const {
    fill(file(), bytes);
    return read_small_png(file(), most_side);
  }

  test::ScratchFolder folder_;
};

TEST_F(PngTextRead, GivesTheTextsThatWereWrittenAndThePixels) {
  const std::vector<PngText> texts{
      {"Thumb::URI", "file:///a%20b.vdb"}, {"Empty", ""}, {"Thumb::URI", "again, \xE4"}};
  const auto seen = read(packed(texts));
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_EQ(seen.value().texts, texts);
  EXPECT_EQ(seen.value().image.width, 3);
  EXPECT_EQ(seen.value().image.rgba[4], 13 * 3);
  // And whoever knows of no texts has the same picture.
  const auto plain = read_image(file(), 1 << 20);
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain.value().rgba, seen.value().image.rgba);
}

/// Each compressed text may unpack to megabytes, and libpng would keep a thousand of them.
TEST_F(PngTextRead, ReadsNoTextOnTheWayToThePixels) {
  const auto whole = pack_png("a.png", small_image(), {{"One", "text"}, {"Two", "texts"}}).value();
  const auto bare = pack_png("a.png", small_image()).value();
  std::vector<std::byte> kept;
  for (const auto& part : pixel_parts(whole)) kept.insert(kept.end(), part.begin(), part.end());
  EXPECT_EQ(kept, bare);
  // What is cut off is not judged here.
  for (std::size_t size = 0; size < whole.size(); ++size) {
    kept.clear();
    for (const auto& part : pixel_parts(std::span(whole).first(size))) {
      kept.insert(kept.end(), part.begin(), part.end());
    }
    EXPECT_LE(kept.size(), size);
  }
}

TEST_F(PngTextRead, RefusesToWriteWhatPngCannotKeep) {
  const std::string nul("a\0b", 3);
  const std::string newline = "a\nb";
  for (const PngText& text :
       {PngText{"", "x"}, PngText{std::string(80, 'k'), "x"}, PngText{" k", "x"},
        PngText{"k ", "x"}, PngText{nul, "x"}, PngText{newline, "x"}, PngText{"k", nul}}) {
    const auto bytes = pack_png("a.png", small_image(), {text});
    ASSERT_FALSE(bytes) << text.key;
    EXPECT_EQ(bytes.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(bytes.error().message, HasSubstr("a.png"));
  }
  EXPECT_TRUE(pack_png("a.png", small_image(), {{std::string(79, 'k'), newline}}));
}

TEST_F(PngTextRead, TakesNoPictureThatIsCutOffAnywhere) {
  const std::string whole = packed({{"Thumb::URI", "file:///a.vdb"}});
  ASSERT_TRUE(read(whole));
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto seen = read(whole.substr(0, length));
    // libpng does not miss the last chunk, which says that the file ends, but for its sum.
    EXPECT_TRUE(!seen || length + 12 >= whole.size()) << length;
  }
}

TEST_F(PngTextRead, TakesNoTextWhoseSumIsWrongOrThatHasNoKey) {
  std::string bad = packed({{"Thumb::URI", "file:///a.vdb"}});
  const std::size_t at = bad.find("a.vdb");
  ASSERT_NE(at, std::string::npos);
  bad[at] = 'b';
  const auto seen = read(bad);
  ASSERT_FALSE(seen);
  EXPECT_EQ(seen.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(seen.error().message, HasSubstr(file().string()));

  std::string whole = packed({});
  constexpr std::size_t kBehindHeader = 33;
  whole.insert(kBehindHeader, PngMaker::chunk("tEXt", "no end of the key"));
  EXPECT_FALSE(read(whole));
}

TEST_F(PngTextRead, FindsNoTextInAnyBytesBeyondTheirEnd) {
  // A length that reaches beyond the file, and one that would run over.
  const std::string head = packed({}).substr(0, 33);
  for (const std::uint32_t length : {1000U, 0x7FFFFFFFU, 0xFFFFFFFFU, 0xFFFFFFF4U}) {
    const std::string bytes = head + PngMaker::number(length) + "tEXtkey";
    std::vector<std::byte> exact(bytes.size());
    for (std::size_t n = 0; n < bytes.size(); ++n) exact[n] = static_cast<std::byte>(bytes[n]);
    EXPECT_FALSE(texts_of(exact)) << length;
  }
}

TEST_F(PngTextRead, UnpacksNothingThatIsTooLarge) {
  const std::string whole = packed({});
  EXPECT_TRUE(read(whole, 3));
  const auto wide = read(whole, 2);
  ASSERT_FALSE(wide);
  EXPECT_THAT(wide.error().message, HasSubstr("3 by 2"));
  // A sound picture, with bytes behind its end.
  const auto heavy = read(whole + std::string(80'000, '\0'), 16);
  ASSERT_FALSE(heavy);
  EXPECT_EQ(heavy.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(heavy.error().message, HasSubstr("bytes"));
  EXPECT_TRUE(read(whole + std::string(80'000, '\0'), 64));
}

TEST_F(PngTextRead, TakesNoFolderAndNoDevice) {
  EXPECT_FALSE(read_small_png(folder_.path(), 16));
  EXPECT_FALSE(read_small_png("/dev/zero", 16));
  EXPECT_FALSE(read_small_png(folder_ / "gone", 16));
}

}  // namespace
}  // namespace argil::io
