// SPDX-License-Identifier: GPL-3.0-or-later
// What tests that compare pictures take for alike.
#include "viewer/support/picture_alike.h"

#include "argil/io/png.h"

#include "support/scratch.h"

namespace argil::test {
namespace {

/// A light disc on a dark ground, its middle at x.
Image disc_at(int x) {
  Image image{320, 240, std::vector<std::uint8_t>(3UL * 320UL * 240UL, 40)};
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const int dx = column - x;
      const int dy = row - 120;
      if (dx * dx + dy * dy > 50 * 50) continue;
      const auto at =
          3UL * (static_cast<std::size_t>(row) * 320UL + static_cast<std::size_t>(column));
      std::fill_n(image.rgb.begin() + static_cast<std::ptrdiff_t>(at), 3, std::uint8_t{200});
    }
  }
  return image;
}

TEST(PictureAlike, ForgivesAPixelAndTellsAMovedDisc) {
  EXPECT_TRUE(are_alike(disc_at(160), disc_at(160)));
  EXPECT_TRUE(are_alike(disc_at(160), disc_at(161)));
  EXPECT_FALSE(are_alike(disc_at(160), disc_at(180)));
}

TEST(PictureAlike, TellsAnotherSizeAndAnotherTint) {
  Image tinted = disc_at(160);
  for (std::size_t n = 0; n < tinted.rgb.size(); n += 3) tinted.rgb[n] += 25;
  EXPECT_FALSE(are_alike(tinted, disc_at(160)));
  Image narrow = disc_at(160);
  narrow.height = 120;
  EXPECT_FALSE(are_alike(narrow, disc_at(160)));
  EXPECT_FALSE(are_alike({}, {}));
}

TEST(PictureAlike, ReadsWhatWasWritten) {
  const ScratchFolder folder;
  const Image disc = disc_at(160);
  ASSERT_TRUE(io::write_png(folder / "disc.png", disc).ok());
  EXPECT_EQ(read_picture(folder / "disc.png").rgb, disc.rgb);
  EXPECT_TRUE(read_picture(folder / "none.png").rgb.empty());
}

}  // namespace
}  // namespace argil::test
