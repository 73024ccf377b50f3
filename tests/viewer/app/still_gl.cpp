// SPDX-License-Identifier: GPL-3.0-or-later
// A still from a real window: as the window shows the clay, larger, without seams.
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>

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

  /// The mean difference of the rows that no menu covers, the larger picture averaged by `times`.
  static double mean_difference(const Image& small, const Image& large, int times) {
    double sum = 0.0;
    int count = 0;
    for (int y = 40; y < small.height - 40; ++y) {
      for (int x = 0; x < small.width; ++x) {
        for (std::size_t c = 0; c < 3; ++c) {
          double mean = 0.0;
          for (int n = 0; n < times * times; ++n) {
            const int row = y * times + n / times;
            const int column = x * times + n % times;
            mean += large.rgb.at(3 * static_cast<std::size_t>(row * large.width + column) + c);
          }
          mean /= times * times;
          sum +=
              std::abs(mean - small.rgb.at(3 * static_cast<std::size_t>(y * small.width + x) + c));
          ++count;
        }
      }
    }
    return sum / count;
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
}

/// Its edges are softer than pixels: two samples, four with the window's own.
TEST_F(StillGl, TheNextHasTheNextName) {
  worked(still("200", "300") + "frames 20\nclick Save the still\nframes 100\n");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "still-1.png"));
  const Image next = test::read_picture(folder_ / "still-2.png");
  EXPECT_EQ(next.width, 200);
  EXPECT_EQ(next.height, 300);
}

}  // namespace
}  // namespace argil
