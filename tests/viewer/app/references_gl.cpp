// SPDX-License-Identifier: GPL-3.0-or-later
// Reference images in a real window: dragged in, shown in their view alone, kept with the project.
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/io/png.h"
#include "argil/io/project_file.h"

#include "settings/reference_list.h"
#include "support/bytes/jpeg_maker.h"
#include "support/scratch.h"
#include "viewer/support/picture_alike.h"
#include "viewer/support/window_run.h"

namespace argil {
namespace {

using Color = std::array<int, 3>;

class ReferencesGl : public test::WindowTest {
 protected:
  void SetUp() override {
    test::WindowTest::SetUp();
    // What shows it is red, and nothing else but the clay is, less.
    Image image{64, 64, {}};
    for (int n = 0; n < 64 * 64; ++n) {
      for (const int c : {250, 10, 20}) image.rgb.push_back(static_cast<std::uint8_t>(c));
    }
    ASSERT_TRUE(io::write_png(folder_ / "red.png", image));
    ASSERT_TRUE(io::save_project(folder_ / "s.vdb", Clay::ball(10.0, {0.5, 0.1}).value()));
  }
  void worked(const std::string& script) {
    const test::WindowRun run =
        play("settle\nkey Tab\nframes 2\n" + script + "settle\nkey Ctrl+Q\nframes 3\n", "s.vdb");
    EXPECT_EQ(run.status, 0) << run.words;
    EXPECT_EQ(run.report.at("gl_errors"), 0);
    EXPECT_EQ(run.report.at("complaints").size(), 0U) << run.report.dump();
  }
  Color color_at(const std::string& shot, int x, int y) const {
    const Image image = test::read_picture(folder_ / shot);
    Color color{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t at = 3 * static_cast<std::size_t>(y * image.width + x) + c;
      color[c] = image.rgb.at(at);
    }
    return color;
  }
};

/// In the middle there is the clay, near the picture's right edge what is behind.
TEST_F(ReferencesGl, AnImageIsDraggedInShownInItsViewAndKeptWithTheProject) {
  const std::string panel = "click View\nframes 3\nclick Reference images\nframes 5\n";
  const auto shot = [&](const std::string& name) {
    return panel + "shot " + name + "\nframes 2\n" + panel;
  };
  worked(
      "drop red.png\nframes 5\nclick Sculpt by it as a reference\nsettle\n"
      "click Width, mm##ref1\nframes 3\nkey Ctrl+A\ntype 60\nkey Enter\nframes 5\n" +
      shot("behind.png") + "click Over the clay##ref1\nframes 5\n" + shot("over.png") + panel +
      "drag right 600 300 560 300 4\nframes 5\nshot aslant.png\nframes 2\n");
  constexpr int kMiddleX = test::kWindowWidth / 2;
  constexpr int kMiddleY = test::kWindowHeight / 2;
  constexpr int kAside = test::kWindowWidth - 60;
  const auto redness = [&](const std::string& name, int x) {
    const Color color = color_at(name, x, kMiddleY);
    return color[0] - color[1];
  };
  EXPECT_GT(redness("behind.png", kAside), 60);
  EXPECT_LT(redness("aslant.png", kAside), 10) << "only straight";
  EXPECT_NEAR(redness("behind.png", kMiddleX), redness("aslant.png", kMiddleX), 20)
      << "behind the clay";
  EXPECT_GT(redness("over.png", kMiddleX), redness("behind.png", kMiddleX) + 40) << "over it";
  const auto list = viewer::read_references(folder_ / "s.vdb");
  ASSERT_EQ(list.images.size(), 1U);
  EXPECT_TRUE(list.problems.empty());
  EXPECT_EQ(list.images[0].width_mm, 60.0);
  EXPECT_TRUE(list.images[0].is_over);
  EXPECT_EQ(list.images[0].view, viewer::StraightView::front);
  // Opened again it is there, and gone where it is removed.
  worked("key Num1\nframes 5\nshot again.png\nframes 2\n" + panel +
         "click Remove##ref1\nframes 5\n" + panel + "shot without.png\nframes 2\n");
  EXPECT_GT(redness("again.png", kAside), 60);
  EXPECT_LT(redness("without.png", kAside), 10);
  EXPECT_TRUE(viewer::read_references(folder_ / "s.vdb").images.empty());
}

/// A JPEG under the name of a PNG, on its side: its left is red when it is seen the right way up.
TEST_F(ReferencesGl, AJpegIsToldByItsContentAndStandsUpright) {
  test::JpegMaker maker{64, 128};
  maker.exif = test::JpegMaker::exif_of(8);  // the file's first row is at the left
  test::fill(folder_ / "photo.png", maker.jpeg([](unsigned, unsigned y, int channel) {
    return y < 64 ? (channel == 0 ? 250U : 10U) : (channel == 1 ? 250U : 10U);
  }));
  worked(
      "drop photo.png\nframes 5\nclick Sculpt by it as a reference\nsettle\n"
      "click Width, mm##ref1\nframes 3\nkey Ctrl+A\ntype 100\nkey Enter\nframes 5\n"
      "click View\nframes 3\nclick Reference images\nframes 5\nshot seen.png\nframes 2\n");
  const Color left = color_at("seen.png", 40, test::kWindowHeight / 2);
  const Color right = color_at("seen.png", test::kWindowWidth - 40, test::kWindowHeight / 2);
  EXPECT_GT(left[0], left[1] + 60);
  EXPECT_GT(right[1], right[0] + 60);
}

/// What cannot be read is said, and the window that is closed meanwhile goes without it: thirty
/// images, each of which takes a while, wait in the list.
TEST_F(ReferencesGl, ABrokenImageIsSaidAndClosingDoesNotWaitForTheRest) {
  test::fill(folder_ / "broken.png", "no image");
  const test::WindowRun run = play(
      "settle\ndrop broken.png\nframes 5\nclick Sculpt by it as a reference\nsettle\nframes 3\n"
      "key Ctrl+Q\nframes 3\n",
      "s.vdb");
  EXPECT_EQ(run.status, 0) << run.words;
  ASSERT_EQ(run.report.at("complaints").size(), 1U) << run.report.dump();
  EXPECT_NE(run.report.at("complaints")[0].get<std::string>().find("is neither PNG nor JPEG"),
            std::string::npos);
  EXPECT_TRUE(viewer::read_references(folder_ / "s.vdb").images.empty());

  // One that is gone may be back the next time: no more than a warning.
  std::string list = "front 0 0 100 0.5 behind shown gone.png\n";
  Image image{2000, 2000, std::vector<std::uint8_t>(std::size_t{3} * 2000 * 2000, 77)};
  ASSERT_TRUE(io::write_png(folder_ / "large.png", image));
  for (int n = 0; n < 30; ++n) {
    const std::string name = "large" + std::to_string(n) + ".png";
    std::filesystem::create_hard_link(folder_ / "large.png", folder_ / name);
    list += "front 0 0 100 0.5 behind shown " + name + "\n";
  }
  test::fill(folder_ / "s.references.txt", list);
  // Without `settle`, which waits for all of them.
  const test::WindowRun left = play("frames 40\nkey Ctrl+Q\nframes 3\n", "s.vdb");
  EXPECT_EQ(left.status, 0) << left.words;
  EXPECT_EQ(left.report.at("complaints").size(), 0U) << left.report.dump();
  EXPECT_EQ(test::content_of(folder_ / "s.references.txt"), list) << "pixels are no change of it";
}

}  // namespace
}  // namespace argil
