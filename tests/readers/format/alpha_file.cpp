// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/alpha_file.h"

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/alpha_maker.h"
#include "support/bytes/jpeg_maker.h"
#include "support/bytes/png_maker.h"
#include "support/effort.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

using test::fill;
using test::PngMaker;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class AlphaFile : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_ / "a.png"; }

  std::vector<std::uint16_t> pixels_of(const std::string& png) const {
    fill(file(), png);
    const auto image = read_alpha(file());
    EXPECT_TRUE(image) << image.error().message;
    return image ? image.value()->pixels() : std::vector<std::uint16_t>();
  }
  /// What is wrong with a file, without its name.
  std::string error_of(const std::string& png) const {
    fill(file(), png);
    const auto image = read_alpha(file());
    if (image) return "";
    EXPECT_EQ(image.error().kind, ErrorKind::bad_input) << image.error().message;
    const std::string name = "'" + file().string() + "'";
    EXPECT_THAT(image.error().message, StartsWith(name));
    return image.error().message.substr(name.size());
  }

  test::ScratchFolder folder_;
};

/// Any bits that fit, the same in each call.
unsigned sample_of(unsigned x, unsigned y, unsigned channel, int bits) {
  return (x * 7919U + y * 104729U + channel * 1299709U) * 2654435761U >>
         static_cast<unsigned>(32 - bits);
}

TEST_F(AlphaFile, ReadsGreyOfAllDepthsInterlacedOrNot) {
  for (const bool is_interlaced : {false, true}) {
    for (const int bits : {1, 2, 4, 8, 16}) {
      const PngMaker maker{13, 11, bits, 0, is_interlaced};
      const auto pixels = pixels_of(
          maker.png([&](unsigned x, unsigned y, int) { return sample_of(x, y, 0, bits); }));
      ASSERT_EQ(pixels.size(), 143U);
      const unsigned most = (1U << static_cast<unsigned>(bits)) - 1U;
      for (unsigned n = 0; n < 143; ++n) {
        ASSERT_EQ(pixels[n], sample_of(n % 13, n / 13, 0, bits) * (65535U / most))
            << bits << " bits, pixel " << n;
      }
    }
  }
}

TEST_F(AlphaFile, TakesTheLumaOfColoursAndBlackForWhatIsTransparent) {
  const auto of_column = [](std::vector<std::vector<int>> columns) {
    return [columns = std::move(columns)](unsigned x, unsigned, int channel) {
      return columns[x][static_cast<std::size_t>(channel)];
    };
  };
  PngMaker maker{3, 2, 8, 2};
  const std::string primaries = maker.png(of_column({{255, 0, 0}, {0, 255, 0}, {0, 0, 255}}));
  EXPECT_THAT(pixels_of(primaries), ElementsAre(13933, 46871, 4732, 13933, 46871, 4732));
  maker.color = 6;
  EXPECT_THAT(pixels_of(maker.png(
                  of_column({{255, 255, 255, 255}, {255, 255, 255, 0}, {100, 100, 100, 51}}))),
              ElementsAre(65535, 0, 5140, 65535, 0, 5140));
  maker.color = 4;
  maker.bits = 16;
  EXPECT_THAT(pixels_of(maker.png(of_column({{65535, 65535}, {40000, 0}, {40000, 32768}}))),
              ElementsAre(65535, 0, 20000, 65535, 0, 20000));
  maker = {3, 2, 2, 3};
  maker.palette = std::string("\xff\xff\xff\x00\x00\x00\x80\x80\x80", 9);
  maker.clear = "\x80";  // the first colour is half transparent
  EXPECT_THAT(pixels_of(maker.png([](unsigned x, unsigned, int) { return x; })),
              ElementsAre(32896, 0, 32896, 32896, 0, 32896));
}

TEST_F(AlphaFile, TakesValuesAsHeightsWhateverGammaTheFileNames) {
  PngMaker maker{4, 2, 8, 0};
  const auto sample = [](unsigned x, unsigned, int) { return 40 * x; };
  const auto plain = pixels_of(maker.png(sample));
  maker.gamma = PngMaker::number(45455);
  EXPECT_EQ(pixels_of(maker.png(sample)), plain);
}

TEST_F(AlphaFile, TakesAJpegByItsGreyOrLumaAndAsItIsSeen) {
  test::JpegMaker maker{16, 8, 1};
  const auto ramp = [](unsigned x, unsigned y, int) { return 10 * x + 3 * y; };
  const auto grey = pixels_of(maker.jpeg(ramp));
  ASSERT_EQ(grey.size(), 128U);
  for (unsigned n = 0; n < 128; ++n) {
    EXPECT_NEAR(grey[n], 257.0 * ramp(n % 16, n / 16, 0), 2 * 257.0) << n;
    EXPECT_EQ(grey[n] % 257, 0) << "eight bits";
  }
  maker.exif = test::JpegMaker::exif_of(6);
  const auto turned = pixels_of(maker.jpeg(ramp));  // clockwise: eight wide, sixteen high
  for (unsigned n = 0; n < 128; ++n) EXPECT_EQ(turned[(n % 16) * 8 + 7 - n / 16], grey[n]) << n;
  maker = {16, 8, 3};
  const auto colours = pixels_of(maker.jpeg([](unsigned x, unsigned, int channel) {
    return x < 8 ? (channel == 0 ? 255U : 0U) : (channel == 1 ? 255U : 0U);
  }));
  EXPECT_NEAR(colours[3], 13933, 3 * 257);
  EXPECT_NEAR(colours[12], 46871, 3 * 257);
  maker = {16, 1, 1};
  EXPECT_EQ(error_of(maker.jpeg(ramp)), " is 16 by 1 pixels; each side must be from 2 to 4096");
}

TEST_F(AlphaFile, EndsWhereItIsToldToStop) {
  const auto sample = [](unsigned x, unsigned y, int) { return x + y; };
  for (const std::string& bytes :
       {PngMaker{90, 70, 8, 0, true}.png(sample), test::JpegMaker{90, 70, 1}.jpeg(sample)}) {
    fill(file(), bytes);
    int left = 20;
    const auto read = read_alpha(file(), [&](std::string_view, double) { return --left > 0; });
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, ErrorKind::interrupted);
    EXPECT_EQ(left, 0);
  }
}

TEST_F(AlphaFile, WritesWhatItReads) {
  std::mt19937 random(11);
  const auto noise = test::image_of(
      37, 19, [&](int, int) { return static_cast<double>(random() % 65536) / 65535.0; });
  ASSERT_TRUE(write_alpha(file(), *noise));
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"a.png"});
  const auto read = read_alpha(file());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read.value()->width(), 37);
  EXPECT_EQ(read.value()->pixels(), noise->pixels());
  EXPECT_EQ(alpha_hash(*read.value()), alpha_hash(*noise));
  // The hash is of the pixels and their places.
  const auto other = test::image_of(19, 37, [&](int column, int row) {
    return noise->pixels()[static_cast<std::size_t>(row * 19 + column)] / 65535.0;
  });
  ASSERT_EQ(other->pixels(), noise->pixels());
  EXPECT_NE(alpha_hash(*other), alpha_hash(*noise));
}

TEST_F(AlphaFile, RefusesBombsBeforeTheyAreUnpacked) {
  PngMaker maker{8, 8, 8, 0};
  const std::string small = maker.png([](unsigned, unsigned, int) { return 9; });
  for (const auto& [width, height] :
       {std::pair{1U, 8U}, {4097U, 8U}, {8U, 100000U}, {0x7fffffffU, 0x7fffffffU}}) {
    maker.width = width;
    maker.height = height;
    EXPECT_EQ(error_of(maker.png_of_rows("few")), " is " + std::to_string(width) + " by " +
                                                      std::to_string(height) +
                                                      " pixels; each side must be from 2 to 4096");
  }
  // Chunks that unpack to more than an image may have besides its pixels are passed over.
  std::string text = small;
  text.insert(33, PngMaker::chunk("zTXt", std::string("a\0\0", 3) + std::string(3000, 'x')));
  EXPECT_EQ(pixels_of(text).size(), 64U);
}

TEST_F(AlphaFile, NamesWhatIsWrongWithAFile) {
  PngMaker maker{40, 30, 8, 0};
  const std::string good = maker.png([](unsigned x, unsigned y, int) { return 3 * x + y; });
  EXPECT_EQ(error_of(""), " is neither PNG nor JPEG; save the image as one of them");
  EXPECT_EQ(error_of("GIF89a and more"), " is neither PNG nor JPEG; save the image as one of them");
  std::string broken = good;
  broken[20] = 7;  // the width, which its chunk's sum does not fit
  EXPECT_THAT(error_of(broken), AllOf(HasSubstr(" is damaged ("), HasSubstr("CRC")));
  broken = good;
  broken[500] = static_cast<char>(broken[500] ^ 1);
  EXPECT_THAT(error_of(broken), HasSubstr(" is damaged ("));
  EXPECT_THAT(error_of(maker.png_of_rows("few")), HasSubstr(" is damaged ("));
  maker.bits = 5;
  EXPECT_THAT(error_of(maker.png_of_rows("few")),
              AllOf(HasSubstr(" is damaged ("), HasSubstr("); save the image again")));
  const auto missing = read_alpha(folder_ / "none.png");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::disk);
}

/// An exact-size heap block each, so that a sanitizer sees one byte over.
TEST_F(AlphaFile, IsDamagedAtEveryLengthItMayBeCutTo) {
  for (const bool is_interlaced : {false, true}) {
    const PngMaker maker{5, 3, 16, 6, is_interlaced};
    const std::string good = maker.png([](unsigned x, unsigned y, int channel) {
      return sample_of(x, y, static_cast<unsigned>(channel), 16);
    });
    ASSERT_EQ(pixels_of(good).size(), 15U);
    for (std::size_t size = 0; size < good.size(); ++size) {
      ASSERT_NE(error_of(good.substr(0, size)), "") << size << " of " << good.size();
    }
  }
}

TEST_F(AlphaFile, SurvivesWhatIsChangedInIt) {
  std::mt19937 random(17);
  const PngMaker maker{9, 7, 8, 3, true, std::string(30, 'p')};
  const std::string good = maker.png([](unsigned x, unsigned, int) { return x; });
  int refused = 0;
  for (int n = 0; n < test::effort(300, 5000); ++n) {
    std::string changed = good;
    for (unsigned k = 0; k <= random() % 4; ++k) {
      changed[random() % changed.size()] = static_cast<char>(random());
    }
    fill(file(), changed);
    refused += read_alpha(file()) ? 0 : 1;
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace argil::io
