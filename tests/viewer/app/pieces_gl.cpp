// SPDX-License-Identifier: GPL-3.0-or-later
// Several pieces in a real window: seen where they stand, chosen by a click, moved by the gizmo,
// named, coloured, combined and undone in the panel.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "argil/engine/pick.h"
#include "argil/engine/surface.h"
#include "argil/io/assembly.h"
#include "argil/io/project_file.h"

#include "picture/gizmo.h"
#include "picture/piece_frame.h"
#include "viewer/support/picture_alike.h"
#include "viewer/support/two_pieces.h"

namespace argil {
namespace {

using test::name_file;
using test::WindowRun;

class ViewPiecesGl : public test::TwoPiecesTest {
 protected:
  /// What the script does to the project, which is then saved.
  Sculpture sculpted(const std::string& script) {
    run_ = play("settle\nkey Tab\nmove 20 460\nframes 2\n" + script +
                    "settle\nkey Ctrl+S\nsettle\nkey Ctrl+Q\nframes 3\n",
                "s.vdb");
    EXPECT_EQ(run_.status, 0) << run_.words;
    EXPECT_EQ(run_.report.at("gl_errors"), 0);
    EXPECT_EQ(run_.report.at("complaints").size(), 0U) << run_.report.dump();
    auto read = io::load_sculpture(folder_ / "s.vdb");
    EXPECT_TRUE(read.ok());
    return std::move(read).value();
  }
  std::int64_t uploaded() const { return run_.report.at("uploaded_bytes"); }

  WindowRun run_;
};

TEST_F(ViewPiecesGl, PiecesLookAsOneClayOfAllOfThemDoes) {
  auto merged = io::load_sculpture(folder_ / "s.vdb");
  ASSERT_TRUE(merged.ok());
  // A quarter turn, so that the box around it, and with it the camera, stays that of the clay.
  ChangePiece change{"Head"};
  change.placement = Placement{head_place_.position_mm, normalized(Quat{1.0, 0.0, 1.0, 0.0})};
  ASSERT_TRUE(merged.value().apply(change).ok());
  ASSERT_TRUE(io::save_sculpture(folder_ / "s.vdb", merged.value()).ok());
  sculpted("shot two.png\nframes 2\n");
  ASSERT_TRUE(merged.value().apply(MergePiece{"Body", "Head", CombineKind::unite, false}).ok());
  ASSERT_TRUE(io::save_sculpture(folder_ / "s.vdb", merged.value()).ok());
  sculpted("shot one.png\nframes 2\n");
  const Image two = test::read_picture(folder_ / "two.png");
  EXPECT_TRUE(test::are_alike(two, test::read_picture(folder_ / "one.png")));
  ASSERT_FALSE(two.rgb.empty());
}

TEST_F(ViewPiecesGl, AStrokeIsOnTheActivePieceAndAKeySwitchesToTheOneUnderThePointer) {
  // On the nearest point of the head, as it is seen: nothing is sculpted before it is chosen.
  const Vec3 toward = normalized(camera_.lens({}).eye_mm - head_place_.position_mm);
  const Vec3 front = head_place_.position_mm + 9.0 * toward;
  const std::string press = "drag left " + at(front) + " " + at(front) + " 3\nsettle\n";
  const Sculpture sculpture =
      sculpted(press + "move " + at(front) + "\nframes 2\nkey Alt+Q\nsettle\n" + press);
  ASSERT_EQ(sculpture.piece_count(), 2U);
  EXPECT_EQ(sculpture.active(), 1U);
  EXPECT_EQ(run_.report.at("dabs"), 1);
  // It stands out where the pointer was, in the frame of a piece that is turned.
  const Vec3 own = viewer::turned_back(head_place_, toward);
  EXPECT_LT(sculpture.clay(1).distance_at(9.0 * own), -0.08);
  EXPECT_NEAR(sculpture.clay(1).distance_at(-9.0 * own), 0.0, 0.03);
}

TEST_F(ViewPiecesGl, TheGizmoMovesThePieceAndUploadsNoByte) {
  sculpted("");
  const std::int64_t before = uploaded();
  const viewer::Gizmo gizmo = viewer::gizmo_at({0.0, 0.0, 0.0}, camera_);
  const Vec3 x{1.0, 0.0, 0.0};
  const Vec3 arrow = 1.2 * gizmo.length_mm * x;
  const Sculpture sculpture = sculpted("key Shift+G\nframes 3\ndrag left " + at(arrow) + " " +
                                       at(arrow - 8.0 * x) + " 6\nsettle\nframes 3\n");
  EXPECT_EQ(uploaded(), before);
  const Vec3 place = sculpture.look(0).placement.position_mm;
  EXPECT_NEAR(place.x, -8.0, 0.3);
  EXPECT_EQ(place.y, 0.0);
  EXPECT_EQ(sculpture.look(1).placement.position_mm, head_place_.position_mm);
}

TEST_F(ViewPiecesGl, ThePanelNamesColoursCombinesAndUndoes) {
  const Sculpture sculpture = sculpted(
      "key Ctrl+P\nframes 3\nclick Rename\nframes 3\nkey Ctrl+A\ntype Torso\nkey Enter\nsettle\n"
      "frames 3\nclick Colour Head\nframes 3\nclick Colour Blue\nsettle\nframes 3\n"
      "click Show Head\nsettle\nframes 3\nclick Show Head\nsettle\nframes 3\n"
      "click Lock Torso\nsettle\nframes 3\nclick Lock Torso\nsettle\nframes 3\n"
      "click Keep it\nframes 3\nclick Subtract##piece\nsettle\nframes 3\n"
      "click Add ball\nsettle\nframes 3\nclick Remove##piece\nsettle\nkey Ctrl+Z\nsettle\n");
  ASSERT_EQ(sculpture.piece_count(), 3U);
  EXPECT_EQ(sculpture.look(0).name, "Torso");
  EXPECT_EQ(sculpture.look(2).name, "Ball");
  EXPECT_TRUE(sculpture.look(1).is_visible);
  EXPECT_FALSE(sculpture.look(0).is_locked);
  EXPECT_EQ(sculpture.look(1).color, (Rgb8{72, 116, 196}));
  // The head reached into the body's top, which now has its hollow.
  EXPECT_GT(sculpture.clay(0).distance_at(head_place_.position_mm + Vec3{0.0, 0.0, -8.5}), 0.0);
}

TEST_F(ViewPiecesGl, NumbersOfThePanelPlaceThePieceExactly) {
  const auto type = [](const std::string& field, const std::string& text) {
    return "click " + field + "\nframes 3\nkey Ctrl+A\ntype " + text +
           "\nkey Enter\nsettle\nframes 3\n";
  };
  const Sculpture sculpture = sculpted("key Ctrl+P\nframes 3\n" + type("##x", "12.5") +
                                       type("##rz", "90") + type("##rx", "-30"));
  const Placement& placement = sculpture.look(0).placement;
  EXPECT_EQ(placement.position_mm, (Vec3{12.5, 0.0, 0.0}));
  EXPECT_LT(length(viewer::turns_of(placement.orientation) - Vec3{-30.0, 0.0, 90.0}), 1e-6);
}

/// A side in mm decides for all, and the percentage goes on from there.
TEST_F(ViewPiecesGl, NumbersOfThePanelScaleThePieceToTheMillimetre) {
  const auto type = [](const std::string& field, const std::string& text) {
    return "click " + field + "\nframes 3\nkey Ctrl+A\ntype " + text +
           "\nkey Enter\nsettle\nframes 3\n";
  };
  const Box3 before = surface_bounds_mm(io::load_sculpture(folder_ / "s.vdb").value().clay(0));
  const Sculpture sculpture = sculpted("key Ctrl+P\nframes 3\n" + type("##sz", "50"));
  const Box3 box = surface_bounds_mm(sculpture.clay(0));
  EXPECT_NEAR(box.size().z, 50.0, 1e-4);
  EXPECT_NEAR(box.size().x, before.size().x * 50.0 / before.size().z, 1e-3);
  const double foot = sculpture.look(0).placement.position_mm.z + box.min.z;
  EXPECT_NEAR(foot, before.min.z, 1e-4) << "what stands on the bed stays there";
  const Sculpture half =
      sculpted("key Ctrl+P\nframes 3\n" + type("Scale, %", "50") + "shot half.png\nframes 2\n");
  EXPECT_NEAR(surface_bounds_mm(half.clay(0)).size().z, 25.0, 1e-4);
}

TEST_F(ViewPiecesGl, TheOuterRingScalesAndTheDragIsShownAsItWillBe) {
  const viewer::Gizmo gizmo = viewer::gizmo_at({0.0, 0.0, 0.0}, camera_);
  const Vec3 right = gizmo.length_mm * camera_.lens({}).right;
  // Held, as large as it is about to be; then let go of.
  const Sculpture sculpture = sculpted("key Shift+G\nframes 3\nmove " + at(1.5 * right) +
                                       "\npress left\nframes 2\nmove " + at(2.1 * right) +
                                       "\nframes 3\nshot held.png\nframes 2\nrelease left\n"
                                       "settle\nframes 3\nshot done.png\nframes 2\n");
  const double factor = sculpture.clay(0).options().voxel_mm / kPieceVoxelMm;
  EXPECT_NEAR(factor, 1.4, 0.02);
  const Image held = test::read_picture(folder_ / "held.png");
  EXPECT_TRUE(test::are_alike(held, test::read_picture(folder_ / "done.png")));
  ASSERT_FALSE(held.rgb.empty());
}

}  // namespace
}  // namespace argil
