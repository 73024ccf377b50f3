// SPDX-License-Identifier: GPL-3.0-or-later
// Stroke modes, the mask's edits with numbers, the palette of images and the pen's curve in a real
// window: by keys, widgets and a dropped file.
#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "argil/io/project_file.h"

#include "settings/settings.h"
#include "viewer/support/window_run.h"

namespace argil {
namespace {

namespace fs = std::filesystem;

class StrokeModesGl : public test::WindowTest {
 protected:
  void SetUp() override {
    test::WindowTest::SetUp();
    if (IsSkipped()) return;
    ASSERT_TRUE(
        io::save_project(folder_ / "b.vdb", Clay::ball(25.0, ClayOptions{.voxel_mm = 0.5}).value())
            .ok());
  }

  /// What the script made of the ball, seen from the front, a pixel in the middle being at y = -25.
  Clay worked(const std::string& script) {
    run_ = play("settle\nkey Num1\nframes 3\n" + script +
                    "settle\nkey Ctrl+S\nsettle\nkey Ctrl+Q\nframes 3\n",
                "b.vdb", "--width 1280 --height 720");
    EXPECT_EQ(run_.status, 0) << run_.words;
    EXPECT_EQ(run_.report.at("gl_errors"), 0);
    EXPECT_EQ(run_.report.at("complaints").size(), 0U) << run_.report.dump();
    auto read = io::load_project(folder_ / "b.vdb");
    EXPECT_TRUE(read.ok());
    return std::move(read).value();
  }

  /// How far the clay stands out beyond the ball in a direction of the front, in degrees.
  static double grown_at(const Clay& clay, double right_deg, double up_deg) {
    const double right = right_deg * 0.017453292519943295;
    const double up = up_deg * 0.017453292519943295;
    const Vec3 out{std::sin(right) * std::cos(up), -std::cos(right) * std::cos(up), std::sin(up)};
    return -clay.distance_at(25.0 * out);
  }

  static std::string method(const std::string& name) {
    return "click Stroke\nframes 3\nclick Method\nframes 3\nclick Method/" + name +
           "\nframes 3\nclick Stroke\nframes 3\n";
  }

  test::WindowRun run_;
};

TEST_F(StrokeModesGl, ALineIsStraightOnTheScreenAndACurveGoesThroughItsPoints) {
  // From left to right through the middle, by a hand that strays far above.
  const Clay line = worked(method("Line") +
                           "move 540 360\npress left\nmove 600 200\nmove 740 360\nframes 3\n"
                           "shot line.png\nrelease left\n");
  EXPECT_GT(grown_at(line, 0.0, 0.0), 0.3);
  EXPECT_GT(grown_at(line, 12.0, 0.0), 0.3);
  EXPECT_GT(grown_at(line, -12.0, 0.0), 0.3);
  EXPECT_LT(std::abs(grown_at(line, 0.0, 35.0)), 0.1) << "where the hand strayed";

  ASSERT_TRUE(
      io::save_project(folder_ / "b.vdb", Clay::ball(25.0, ClayOptions{.voxel_mm = 0.5}).value())
          .ok());
  const Clay curve = worked(method("Curve") +
                            "move 540 360\npress left\nrelease left\nmove 640 260\npress left\n"
                            "release left\nmove 740 360\npress left\nrelease left\nframes 3\n"
                            "shot curve.png\nkey Enter\n");
  EXPECT_LT(std::abs(grown_at(curve, 0.0, -20.0)), 0.1);
  EXPECT_GT(curve.bounds_mm().max.z, 20.0);
  double most_up = 0.0;
  for (double up = 5.0; up < 45.0; up += 1.0) most_up = std::max(most_up, grown_at(curve, 0.0, up));
  EXPECT_GT(most_up, 0.3) << "through the point above the middle";
}

TEST_F(StrokeModesGl, AnAnchoredDabIsLaidOnceAndADragDotWhereTheHandLetGo) {
  const Clay anchored =
      worked(method("Anchored") +
             "move 640 360\npress left\nmove 660 360\nframes 5\nmove 700 360\n"
             "frames 5\nmove 720 360\nframes 5\nshot anchored.png\nrelease left\n");
  EXPECT_GT(grown_at(anchored, 0.0, 0.0), 0.15);
  EXPECT_LT(std::abs(grown_at(anchored, -50.0, 0.0)), 0.05);

  ASSERT_TRUE(
      io::save_project(folder_ / "b.vdb", Clay::ball(25.0, ClayOptions{.voxel_mm = 0.5}).value())
          .ok());
  const Clay dot = worked(method("Drag dot") +
                          "move 560 360\npress left\nframes 5\nmove 600 360\nframes 5\n"
                          "move 640 360\nframes 5\nrelease left\n");
  EXPECT_GT(grown_at(dot, 0.0, 0.0), 0.07);
  EXPECT_LT(std::abs(grown_at(dot, -25.0, 0.0)), 0.03) << "where it was dragged from";
}

TEST_F(StrokeModesGl, TheMaskIsGrownByItsPanelAndItsKey) {
  const std::string masked = "key M\nframes 3\ndrag left 640 360 641 360 3\nsettle\n";
  const Clay grown = worked(masked +
                            "click Grow##mask\nsettle\nkey Alt+G\n"
                            "settle\nshot mask.png\n");
  ASSERT_TRUE(grown.has_mask());
  // Eight voxels each time, from where the brush left it.
  const Vec3 beside = 25.0 * Vec3{std::sin(0.4), -std::cos(0.4), 0.0};
  EXPECT_GT(grown.mask_at(beside), 0.3);
}

TEST_F(StrokeModesGl, ADroppedImageJoinsThePaletteAndIsChosen) {
  fs::copy_file("examples/alphas/stars.png", folder_ / "mine.png");
  const Clay clay = worked(
      "drop mine.png\nframes 5\nclick Emboss with it\nsettle\nframes 5\nshot palette.png\n"
      "click medal\nsettle\nframes 3\nclick mine\nsettle\nframes 3\n"
      "click Image\nframes 3\nclick Image/Dragged\nframes 3\n"
      "move 640 360\npress left\nmove 660 330\nmove 720 260\nrelease left\n");
  EXPECT_TRUE(fs::exists(home() / "alphas" / "mine.png"));
  EXPECT_TRUE(fs::exists(home() / "alphas" / "weave.png")) << "with those of the program";
  EXPECT_GT(grown_at(clay, 0.0, 0.0), 0.3);
}

TEST_F(StrokeModesGl, ThePensCurveIsDrawnWhereItsPointsAreDraggedAndKept) {
  worked(
      "click Stroke\nframes 3\npen 0.3\ndrag left 560 300 720 380 30\nsettle\npen 0.6\n"
      "drag left 560 380 720 420 30\nsettle\nframes 3\nclick Firm\nframes 5\nshot pen.png\n");
  EXPECT_EQ(viewer::read_settings(home()).pressure, viewer::kFirmPressure);
}

}  // namespace
}  // namespace argil
