// SPDX-License-Identifier: GPL-3.0-or-later
// Images with colours and transparency, as they are shown beside the clay.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/png.h"

#include "support/png_maker.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

using test::fill;
using test::PngMaker;
using testing::ElementsAre;
using testing::HasSubstr;

class PngRead : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_ / "a.png"; }
  std::string error_of(const std::string& bytes) const {
    fill(file(), bytes);
    const auto image = read_png(file());
    EXPECT_FALSE(image);
    if (image) return "";
    EXPECT_EQ(image.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(image.error().message, HasSubstr(file().string()));
    return image.error().message;
  }
  test::ScratchFolder folder_;
};

TEST_F(PngRead, GivesTheColoursThatWereWritten) {
  Image image{3, 2, {}};
  for (int n = 0; n < 18; ++n) image.rgb.push_back(static_cast<std::uint8_t>(13 * n));
  ASSERT_TRUE(write_png(file(), image));
  const auto read = read_png(file());
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
TEST_F(PngRead, KeepsWhatIsClear) {
  const PngMaker maker{2, 1, 8, 4, false};
  fill(file(), maker.png([](unsigned x, unsigned, int channel) {
    return channel == 0 ? 200U : 85U * (x + 1);
  }));
  const auto read = read_png(file());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_THAT(read.value().rgba, ElementsAre(200, 200, 200, 85, 200, 200, 200, 170));
}

TEST_F(PngRead, RefusesEveryTruncationAndWhatIsNoPng) {
  const PngMaker maker{9, 7, 8, 2, true};
  const std::string whole = maker.png([](unsigned x, unsigned y, int channel) {
    return (31U * x + 17U * y + 97U * static_cast<unsigned>(channel)) & 255U;
  });
  fill(file(), whole);
  ASSERT_TRUE(read_png(file()));
  // Without its last chunk, which says no more than that it is the end, a PNG is all there.
  constexpr std::size_t kEnd = 12;
  for (std::size_t length = 0; length + kEnd < whole.size(); ++length) {
    const std::string message = error_of(whole.substr(0, length));
    EXPECT_THAT(message, HasSubstr(length < 8 ? "is no PNG" : "is damaged")) << length;
  }
  EXPECT_THAT(error_of("JFIF, as a camera would have it"), HasSubstr("is no PNG"));
  EXPECT_FALSE(read_png(folder_ / "gone.png"));
}

TEST_F(PngRead, RefusesALargeOneBeforeItIsUnpacked) {
  const PngMaker maker{9000, 1, 1, 0, false};
  EXPECT_THAT(error_of(maker.png([](unsigned, unsigned, int) { return 0U; })),
              HasSubstr("is 9000 by 1 pixels; each side may be 8192 at most"));
}

}  // namespace
}  // namespace argil::io
