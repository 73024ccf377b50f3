// SPDX-License-Identifier: GPL-3.0-or-later
// A still from a real window: as the window shows the clay, larger, without seams.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/operation.h"
#include "argil/io/project_file.h"

#include "viewer/support/picture_alike.h"
#include "viewer/support/window_run.h"

namespace argil {
namespace {

class StillGl : public test::WindowTest {
 protected:
  void SetUp() override {
    test::WindowTest::SetUp();
    Clay clay = Clay::ball(10.0, {0.5, 0.1}).value();
    ASSERT_TRUE(clay.apply(Operation(Cut{{0.0, 0.0, 4.0}, {0.5, -0.3, 1.0}, false})));
    ASSERT_TRUE(io::save_project(folder_ / "s.vdb", clay));
  }
  void worked(const std::string& script) {
    const test::WindowRun run =
        play("settle\nkey Tab\nframes 2\n" + script + "settle\nkey Ctrl+Q\nframes 3\n", "s.vdb");
    EXPECT_EQ(run.status, 0) << run.words;
    EXPECT_EQ(run.report.at("gl_errors"), 0);
    EXPECT_EQ(run.report.at("complaints").size(), 0U) << run.report.dump();
  }
  static std::string still(const std::string& width, const std::string& height) {
    const auto type = [](const std::string& field, const std::string& text) {
      return "click " + field + "\nframes 3\nkey Ctrl+A\ntype " + text + "\nkey Enter\nframes 3\n";
    };
    return "click File\nframes 3\nclick Still picture...\nframes 4\n" +
           type("Width, pixels", width) + type("Height, pixels", height) +
           "click Save the still\nframes 400\n";
  }

  /// The mean of a channel over a square of `times` by `times` pixels.
  static double mean_of_square(const Image& image, int x, int y, int times, std::size_t channel) {
    double sum = 0.0;
    for (int n = 0; n < times * times; ++n) {
      const int row = y * times + n / times;
      const int column = x * times + n % times;
      sum += image.rgb.at(3 * static_cast<std::size_t>(row * image.width + column) + channel);
    }
    return sum / (times * times);
  }

  /// The mean difference of the rows that no menu covers, the larger picture averaged by `times`.
  static double mean_difference(const Image& small, const Image& large, int times) {
    double sum = 0.0;
    int count = 0;
    for (int y = 40; y < small.height - 40; ++y) {
      for (int x = 0; x < small.width; ++x) {
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t at = 3 * static_cast<std::size_t>(y * small.width + x) + c;
          sum += std::abs(mean_of_square(large, x, y, times, c) - small.rgb.at(at));
          ++count;
        }
      }
    }
    return sum / count;
  }

  /// How much a column differs from the one before it, on average over its middle, which is clay.
  static double step_at(const Image& image, int x) {
    const int from = 3 * image.height / 8;
    const int to = 5 * image.height / 8;
    double sum = 0.0;
    for (int y = from; y < to; ++y) {
      const std::size_t at = 3 * static_cast<std::size_t>(y * image.width + x);
      for (std::size_t c = 0; c < 3; ++c) {
        sum += std::abs(static_cast<double>(image.rgb[at + c]) - image.rgb[at - 3 + c]);
      }
    }
    return sum / (3.0 * (to - from));
  }
  /// The largest that the step between two parts differs from those beside it, as a share of these,
  /// where parts are `step` pixels wide, in the middle half. Columns that are all alike have none.
  static double worst_seam(const Image& image, int step) {
    constexpr double kFlat = 0.02;
    double worst = 0.0;
    for (int x = step; x < 3 * image.width / 4; x += step) {
      if (x < image.width / 4) continue;
      const double beside = 0.25 * (step_at(image, x - 2) + step_at(image, x - 1) +
                                    step_at(image, x + 1) + step_at(image, x + 2));
      if (beside > kFlat) worst = std::max(worst, std::abs(step_at(image, x) / beside - 1.0));
    }
    return worst;
  }
  /// Rows as columns.
  static Image turned(const Image& image) {
    Image turned{image.height, image.width, std::vector<std::uint8_t>(image.rgb.size())};
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const std::size_t from = 3 * static_cast<std::size_t>(y * image.width + x);
        const std::size_t to = 3 * static_cast<std::size_t>(x * image.height + y);
        std::copy_n(image.rgb.begin() + static_cast<std::ptrdiff_t>(from), 3,
                    turned.rgb.begin() + static_cast<std::ptrdiff_t>(to));
      }
    }
    return turned;
  }
  /// The same, but that from column `x` on each pixel is its neighbour's on the right.
  static Image shifted(Image image, int x) {
    for (int y = 0; y < image.height; ++y) {
      const auto row = image.rgb.begin() + static_cast<std::ptrdiff_t>(3) * y * image.width;
      std::copy(row + 3 * (x + 1), row + 3 * image.width, row + 3 * x);
    }
    return image;
  }
};

TEST_F(StillGl, IsWhatTheWindowShowsThreeTimesAsLarge) {
  worked("move 2 470\nframes 3\nshot window.png\nframes 2\n" + still("1920", "1440"));
  ASSERT_TRUE(std::filesystem::exists(folder_ / "still-1.png"));
  const Image window = test::read_picture(folder_ / "window.png");
  const Image large = test::read_picture(folder_ / "still-1.png");
  ASSERT_EQ(large.width, 1920);
  ASSERT_EQ(large.height, 1440);
  EXPECT_LT(mean_difference(window, large, 3), 1.5);
  // A part is the window less eight pixels on each side, with two samples across a pixel.
  constexpr int kStepX = (test::kWindowWidth - 16) / 2;
  constexpr int kStepY = (test::kWindowHeight - 16) / 2;
  constexpr double kSeam = 0.5;
  const Image rows = turned(large);
  EXPECT_LT(worst_seam(large, kStepX), kSeam);
  EXPECT_LT(worst_seam(rows, kStepY), kSeam);
  // Where the clay is round, not on its flat cut, one pixel too few would be seen.
  EXPECT_GT(worst_seam(shifted(large, 3 * kStepX), kStepX), kSeam);
  EXPECT_GT(worst_seam(shifted(rows, 4 * kStepY), kStepY), kSeam);
}

TEST_F(StillGl, TheNextHasTheNextName) {
  worked(still("200", "300") + "frames 20\nclick Save the still\nframes 100\n");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "still-1.png"));
  const Image next = test::read_picture(folder_ / "still-2.png");
  EXPECT_EQ(next.width, 200);
  EXPECT_EQ(next.height, 300);
}

}  // namespace
}  // namespace argil
