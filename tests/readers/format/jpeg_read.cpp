// SPDX-License-Identifier: GPL-3.0-or-later
#include "format/jpeg_read.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/image_file.h"

#include "support/bytes/jpeg_maker.h"
#include "support/effort.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

using test::fill;
using test::JpegMaker;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::int64_t kMostTested = 67'108'864;

/// Smooth, and different in each corner and channel.
unsigned shade(unsigned x, unsigned y, int channel) {
  return channel == 0 ? 6 * x : channel == 1 ? 250 - 7 * y : 3 * x + 4 * y;
}

class JpegRead : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_ / "a.jpg"; }
  ClearImage image_of(const std::string& bytes) const {
    fill(file(), bytes);
    auto read = read_image(file(), kMostTested);
    EXPECT_TRUE(read) << read.error().message;
    return read ? std::move(read).value() : ClearImage();
  }
  /// Without its name; "" where it is taken.
  std::string error_of(const std::string& bytes) const {
    fill(file(), bytes);
    const auto read = read_image(file(), kMostTested);
    if (read) return "";
    EXPECT_EQ(read.error().kind, ErrorKind::bad_input) << read.error().message;
    const std::string name = "'" + file().string() + "'";
    EXPECT_THAT(read.error().message, StartsWith(name));
    return read.error().message.substr(name.size());
  }
  test::ScratchFolder folder_;
};

TEST_F(JpegRead, GivesGreyAndColoursWithFullOpacity) {
  for (const int channels : {1, 3}) {
    const ClearImage image = image_of(JpegMaker{40, 24, channels}.jpeg(shade));
    ASSERT_EQ(image.width, 40);
    ASSERT_EQ(image.height, 24);
    for (unsigned n = 0; n < 40 * 24; ++n) {
      for (int c = 0; c < 3; ++c) {
        const unsigned wanted = shade(n % 40, n / 40, channels == 1 ? 0 : c);
        EXPECT_NEAR(image.rgba[4 * n + static_cast<unsigned>(c)], static_cast<double>(wanted), 3.0)
            << channels << " channels, pixel " << n << ", " << c;
      }
      EXPECT_EQ(image.rgba[4 * n + 3], 255);
    }
  }
}

/// The same coefficients in another order, so the same pixels to the bit.
TEST_F(JpegRead, GivesTheSameOfProgressiveOnesAndOfScansForEachChannel) {
  JpegMaker maker{53, 37};
  const ClearImage plain = image_of(maker.jpeg(shade));
  maker.is_progressive = true;
  EXPECT_EQ(image_of(maker.jpeg(shade)).rgba, plain.rgba);
  maker.is_progressive = false;
  maker.is_in_parts = true;
  EXPECT_EQ(image_of(maker.jpeg(shade)).rgba, plain.rgba);
}

/// As Exif 2.32 words it: on which side, as it is seen, the file's first row and its first column
/// are.
TEST_F(JpegRead, ShowsItTheWayUpThatExifSays) {
  enum class Side { left, right, top, bottom };
  using enum Side;
  constexpr std::array<std::array<Side, 2>, 8> kFirst{{{top, left},
                                                       {top, right},
                                                       {bottom, right},
                                                       {bottom, left},
                                                       {left, top},
                                                       {right, top},
                                                       {right, bottom},
                                                       {left, bottom}}};
  for (const auto& [width, height] : {std::array{19U, 11U}, std::array{1U, 9U}}) {
    JpegMaker maker{width, height};
    const ClearImage plain = image_of(maker.jpeg(shade));
    for (int orientation = 1; orientation <= 8; ++orientation) {
      for (const bool is_little : {false, true}) {
        maker.exif = JpegMaker::exif_of(orientation, is_little);
        const ClearImage seen = image_of(maker.jpeg(shade));
        const auto [row, column] = kFirst[static_cast<std::size_t>(orientation - 1)];
        const bool is_turned = row == left || row == right;
        ASSERT_EQ(seen.width, static_cast<int>(is_turned ? height : width)) << orientation;
        ASSERT_EQ(seen.height, static_cast<int>(is_turned ? width : height)) << orientation;
        for (unsigned y = 0; y < height; ++y) {
          for (unsigned x = 0; x < width; ++x) {
            const unsigned from_row = row == left || row == top ? y : height - 1 - y;
            const unsigned from_column = column == left || column == top ? x : width - 1 - x;
            const unsigned seen_x = is_turned ? from_row : from_column;
            const unsigned seen_y = is_turned ? from_column : from_row;
            const std::size_t at =
                4 * (std::size_t{seen_y} * static_cast<std::size_t>(seen.width) + seen_x);
            for (std::size_t c = 0; c < 4; ++c) {
              ASSERT_EQ(seen.rgba.at(at + c), plain.rgba.at(4 * (y * width + x) + c))
                  << orientation << ": " << x << " " << y;
            }
          }
        }
      }
    }
  }
}

TEST_F(JpegRead, RefusesKindsThatItDoesNotReadByTheirNames) {
  const std::string good = JpegMaker{16, 16}.jpeg(shade);
  EXPECT_THAT(error_of(JpegMaker{16, 16, 4}.jpeg([](unsigned, unsigned, int) { return 90U; })),
              HasSubstr(" is a JPEG in CMYK, which are inks"));
  EXPECT_THAT(error_of(JpegMaker::with_bits(good, 12)),
              HasSubstr(" is a JPEG of more than 8 bits a channel; save it with 8"));
  EXPECT_THAT(error_of(JpegMaker::with_frame(good, 0xC3)),  // without loss
              HasSubstr(" is a JPEG of a kind that is not read (Unsupported"));
}

TEST_F(JpegRead, RefusesLargeOnesBeforeTheyAreUnpacked) {
  const std::string small = JpegMaker{16, 16}.jpeg(shade);
  const auto sized = [&](unsigned width, unsigned height) {
    return error_of(JpegMaker::with_sides(small, width, height));
  };
  EXPECT_EQ(sized(65535, 65535),
            " is larger than 65500 pixels; each side may be 16384 at most: make it smaller");
  EXPECT_EQ(sized(20000, 8), " is 20000 by 8 pixels; each side must be from 1 to 16384");
  EXPECT_EQ(sized(16384, 16384),
            " is 16384 by 16384 pixels; it may have 67108864 in all: make it smaller");
  EXPECT_THAT(sized(0, 16), HasSubstr(" is damaged (Empty JPEG image"));
}

TEST_F(JpegRead, RefusesMoreScansThanAnybodyWrites) {
  JpegMaker maker{16, 16};
  maker.is_in_parts = true;
  const std::string good = maker.jpeg(shade);
  const std::size_t last = good.rfind("\xFF\xDA");
  const std::string scan = good.substr(last, good.size() - 2 - last);
  std::string more = good.substr(0, good.size() - 2);
  for (int n = 0; n < 90; ++n) more += scan;
  EXPECT_EQ(error_of(more + "\xFF\xD9"), "");
  for (int n = 0; n < 10; ++n) more += scan;
  EXPECT_EQ(error_of(more + "\xFF\xD9"), " is damaged (more than 100 scans); save the image again");
}

TEST_F(JpegRead, RefusesEveryTruncation) {
  for (const bool is_progressive : {false, true}) {
    JpegMaker maker{19, 11};
    maker.is_progressive = is_progressive;
    maker.exif = JpegMaker::exif_of(3);
    const std::string whole = maker.jpeg(shade);
    ASSERT_EQ(error_of(whole), "");
    for (std::size_t length = 0; length < whole.size(); ++length) {
      // A block of just that size, so that a sanitizer sees one byte over.
      const std::vector<char> cut(whole.begin(),
                                  whole.begin() + static_cast<std::ptrdiff_t>(length));
      const auto read = parse_jpeg(file(), std::as_bytes(std::span(cut)), {1, 99, 9999}, {});
      ASSERT_FALSE(read) << length << " of " << whole.size();
      EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
      EXPECT_THAT(read.error().message, HasSubstr(" is damaged (the file ends too early)"));
    }
    EXPECT_EQ(error_of(whole + "what a phone puts behind it"), "");
  }
}

/// A scan that ends before its last block, with a sound end of the file behind it: libjpeg would
/// fill it with grey.
TEST_F(JpegRead, RefusesAnImageWithAHole) {
  const std::string whole = JpegMaker{64, 64}.jpeg(shade);
  const std::string holed = whole.substr(0, whole.size() - 200) + "\xFF\xD9";
  EXPECT_THAT(error_of(holed), HasSubstr(" is damaged (Corrupt JPEG data"));
}

TEST_F(JpegRead, SurvivesWhatIsChangedInIt) {
  std::mt19937 random(23);
  int refused = 0;
  for (int n = 0; n < test::effort(400, 6000); ++n) {
    JpegMaker maker{21, 17};
    maker.is_progressive = n % 2 == 0;
    maker.exif = JpegMaker::exif_of(5, n % 3 == 0);
    std::string changed = maker.jpeg(shade);
    for (unsigned k = 0; k <= random() % 4; ++k) {
      changed[random() % changed.size()] = static_cast<char>(random());
    }
    fill(file(), changed);
    const auto read = read_image(file(), 1'000'000);
    refused += read ? 0 : 1;
    if (!read) {
      EXPECT_NE(read.error().kind, ErrorKind::internal) << read.error().message;
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace argil::io
