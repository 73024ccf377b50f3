// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/png.h"

#include <filesystem>
#include <random>

#include <gtest/gtest.h>

#include "support/scratch.h"

namespace argil::io {
namespace {

using test::ScratchFolder;

/// Noise, which no packing makes small.
Image noise(int width, int height) {
  Image image{width, height, {}};
  std::mt19937 random(1);
  for (int n = 0; n < 3 * width * height; ++n) {
    image.rgb.push_back(static_cast<std::uint8_t>(random() & 0xffU));
  }
  return image;
}

TEST(PngWrite, StopsWhereItIsToldAndLeavesNoFile) {
  const ScratchFolder scratch;
  const Image image = noise(300, 200);
  int asked = 0;
  ASSERT_TRUE(write_png(scratch / "whole.png", image, [&](std::string_view, double) {
    ++asked;
    return true;
  }));
  EXPECT_GE(std::filesystem::file_size(scratch / "whole.png"), image.rgb.size());
  ASSERT_GT(asked, 3);
  for (const int last : {0, 2, asked - 1}) {
    int left = last;
    const auto stopped = write_png(scratch / "stopped.png", image,
                                   [&](std::string_view, double) { return left-- > 0; });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted);
    EXPECT_EQ(scratch.names(), std::vector<std::string>{"whole.png"});
  }
}

}  // namespace
}  // namespace argil::io
