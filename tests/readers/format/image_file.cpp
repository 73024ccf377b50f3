// SPDX-License-Identifier: GPL-3.0-or-later
// Images with colours and transparency, as they are shown beside the clay: what is of PNG, and of
// both.
#include "argil/io/image_file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/png.h"

#include "support/bytes/jpeg_maker.h"
#include "support/bytes/png_maker.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

constexpr std::int64_t kAnyNumber = 1'000'000'000;

using test::fill;
using test::JpegMaker;
using test::PngMaker;
using testing::ElementsAre;
using testing::HasSubstr;

class ImageFile : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_ / "a.png"; }
  std::string error_of(const std::string& bytes) const {
    fill(file(), bytes);
    const auto image = read_image(file(), kAnyNumber);
    EXPECT_FALSE(image);
    if (image) return "";
    EXPECT_EQ(image.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(image.error().message, HasSubstr(file().string()));
    return image.error().message;
  }
  test::ScratchFolder folder_;
};

TEST_F(ImageFile, GivesTheColoursThatWereWritten) {
  Image image{3, 2, {}};
  for (int n = 0; n < 18; ++n) image.rgb.push_back(static_cast<std::uint8_t>(13 * n));
  ASSERT_TRUE(write_png(file(), image));
  const auto read = read_image(file(), kAnyNumber);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read.value().width, 3);
  ASSERT_EQ(read.value().height, 2);
  ASSERT_EQ(read.value().rgba.size(), 24U);
  for (std::size_t n = 0; n < 6; ++n) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(read.value().rgba[4 * n + c], image.rgb[3 * n + c]);
    }
    EXPECT_EQ(read.value().rgba[4 * n + 3], 255);
  }
}

/// Grey with opacity: what is clear stays so.
TEST_F(ImageFile, KeepsWhatIsClear) {
  const PngMaker maker{2, 1, 8, 4, false};
  fill(file(), maker.png([](unsigned x, unsigned, int channel) {
    return channel == 0 ? 200U : 85U * (x + 1);
  }));
  const auto read = read_image(file(), kAnyNumber);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_THAT(read.value().rgba, ElementsAre(200, 200, 200, 85, 200, 200, 200, 170));
}

TEST_F(ImageFile, RefusesEveryTruncationAndWhatIsNoImage) {
  const PngMaker maker{9, 7, 8, 2, true};
  const std::string whole = maker.png([](unsigned x, unsigned y, int channel) {
    return (31U * x + 17U * y + 97U * static_cast<unsigned>(channel)) & 255U;
  });
  fill(file(), whole);
  ASSERT_TRUE(read_image(file(), kAnyNumber));
  // Without its last chunk, which says no more than that it is the end, a PNG is all there.
  constexpr std::size_t kEnd = 12;
  for (std::size_t length = 0; length + kEnd < whole.size(); ++length) {
    const std::string message = error_of(whole.substr(0, length));
    EXPECT_THAT(message, HasSubstr(length < 8 ? "is neither PNG nor JPEG" : "is damaged"))
        << length;
  }
  EXPECT_THAT(error_of("JFIF, as a camera would have it"), HasSubstr("is neither PNG nor JPEG"));
  EXPECT_FALSE(read_image(folder_ / "gone.png", kAnyNumber));
}

TEST_F(ImageFile, RefusesALargeOneBeforeItIsUnpacked) {
  PngMaker maker{20000, 1, 1, 0, false};
  EXPECT_THAT(error_of(maker.png_of_rows("few")),
              HasSubstr("is 20000 by 1 pixels; each side must be from 1 to 16384"));
  maker.width = maker.height = 16384;
  fill(file(), maker.png_of_rows("few"));
  const auto read = read_image(file(), 67'108'864);
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message,
              HasSubstr("is 16384 by 16384 pixels; it may have 67108864 in all"));
}

TEST_F(ImageFile, IsToldByItsContentWhateverItsName) {
  const auto sample = [](unsigned x, unsigned y, int) { return 20 * x + y; };
  const std::string png = PngMaker{9, 7, 8, 0, false}.png(sample);
  const std::string jpeg = JpegMaker{9, 7, 1}.jpeg(sample);
  for (const char* name : {"a.png", "a.jpg", "a", "a.txt"}) {
    for (const std::string& bytes : {png, jpeg}) {
      fill(folder_ / name, bytes);
      EXPECT_TRUE(is_image_file(folder_ / name)) << name;
      const auto read = read_image(folder_ / name, kAnyNumber);
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_NEAR(read.value().rgba[4 * (9 * 2 + 5)], 102, 1) << name;
    }
  }
  fill(folder_ / "a.png", "GIF89a");
  EXPECT_FALSE(is_image_file(folder_ / "a.png"));
  fill(folder_ / "a.png", "");
  EXPECT_FALSE(is_image_file(folder_ / "a.png"));
  EXPECT_FALSE(is_image_file(folder_ / "gone.png"));
  EXPECT_FALSE(is_image_file(folder_.path()));
}

TEST_F(ImageFile, EndsWhereItIsToldToStop) {
  const auto sample = [](unsigned x, unsigned y, int channel) {
    return (x * x + 3 * y + 50 * static_cast<unsigned>(channel)) & 255U;
  };
  JpegMaker progressive{200, 160};
  progressive.is_progressive = true;
  for (const std::string& bytes : {PngMaker{200, 160, 8, 2, false}.png(sample),
                                   JpegMaker{200, 160}.jpeg(sample), progressive.jpeg(sample)}) {
    fill(file(), bytes);
    int asked = 0;
    double told = 0.0;
    const auto count = [&](std::string_view, double fraction) {
      EXPECT_LE(told, fraction);
      told = fraction;
      return ++asked > 0;
    };
    ASSERT_TRUE(read_image(file(), kAnyNumber, count));
    EXPECT_LE(told, 1.0);
    ASSERT_GT(asked, 8);
    for (int last = 1; last < asked; last += 1 + asked / 9) {
      int left = last;
      const auto read =
          read_image(file(), kAnyNumber, [&](std::string_view, double) { return --left > 0; });
      ASSERT_FALSE(read);
      EXPECT_EQ(read.error().kind, ErrorKind::interrupted) << read.error().message;
      EXPECT_EQ(left, 0) << "it goes on for nothing";
    }
  }
}

}  // namespace
}  // namespace argil::io
