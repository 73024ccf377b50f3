// SPDX-License-Identifier: GPL-3.0-or-later
// The gizmo under the mouse, and clicks on pieces, against a document that does what it is told.
#include "gestures/piece_gestures.h"

#include <chrono>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "commands/command.h"
#include "commands/piece_edits.h"
#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

class PieceGesturesTest : public GesturesTest {
 protected:
  PieceGesturesTest() {
    ui_.camera.resize(800, 600);
    ui_.camera.look_from(normalized(Vec3{0.3, -1.0, 0.5}), {0.0, 0.0, 1.0});
    document_.send(NewClay{{io::StartShape::Kind::ball, {20.0, 0.0, 0.0}, {}}});
    settle();
    ui_.camera.frame(ui_.clay.all_bounds_mm);
  }

  void settle() {
    do {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      std::vector<double> inputs;
      document_.take_blocks(inputs);
    } while (!document_.is_idle());
    ui_.clay = document_.state();
  }

  /// Of the tip of the gizmo's arrow along x.
  Camera::Pixel arrow() const {
    const Gizmo gizmo = shown_gizmo(ui_, ui_.camera).value();
    return ui_.camera.pixel_of(gizmo.center_mm + 1.2 * gizmo.length_mm * Vec3{1.0, 0.0, 0.0});
  }
  Camera::Pixel beside_arrow(double mm) const {
    const Gizmo gizmo = shown_gizmo(ui_, ui_.camera).value();
    return ui_.camera.pixel_of(gizmo.center_mm +
                               (1.2 * gizmo.length_mm + mm) * Vec3{1.0, 0.0, 0.0});
  }
  double x_of_active() const {
    return ui_.clay.pieces->active_piece().look.placement.position_mm.x;
  }
};

/// Of an ellipsoid about no centre, so that nothing is as it was by chance.
TEST(FollowMarks, TheyAreScaledWithThePieceKeptByResamplingAndGoneWithASplit) {
  const MarkedClay small{{{-1.0, -2.0, -3.0}, {4.0, 5.0, 6.0}}, 0.25, 1};
  const MarkedClay large{{{-2.0, -4.0, -6.0}, {8.0, 10.0, 12.0}}, 0.5, 1};
  const MarkedClay coarse{{{-1.1, -2.0, -2.9}, {4.0, 5.1, 6.0}}, 0.5, 1};
  const MarkedClay part{{{-1.0, -2.0, -3.0}, {1.0, 5.0, 6.0}}, 0.25, 2};
  const MarkedClay joined{{{-1.0, -2.0, -3.0}, {4.0, 5.0, 6.0}}, 0.25, 2};
  UiState ui;
  follow_marks(small, large, ui);
  EXPECT_TRUE(ui.notices.empty()) << "there are none";
  ui.operation.drains.push_back({{4.0, 1.0, 2.0}, {-1.0, 0.0, 0.0}, 2.0});
  ui.haptics.guidance.path_mm = {{0.0, 5.0, 1.0}};
  follow_marks({}, small, ui);
  follow_marks(small, small, ui);
  follow_marks(small, coarse, ui);
  follow_marks(small, joined, ui);
  EXPECT_EQ(ui.operation.drains.at(0).point_mm, (Vec3{4.0, 1.0, 2.0}));
  EXPECT_TRUE(ui.notices.empty());
  follow_marks(small, large, ui);
  EXPECT_EQ(ui.operation.drains.at(0).point_mm, (Vec3{8.0, 2.0, 4.0}));
  EXPECT_EQ(ui.operation.drains.at(0).radius_mm, 2.0);
  EXPECT_EQ(ui.haptics.guidance.path_mm.at(0), (Vec3{0.0, 10.0, 2.0}));
  ASSERT_EQ(ui.notices.size(), 1U);
  follow_marks(large, small, ui);
  EXPECT_EQ(ui.operation.drains.at(0).point_mm, (Vec3{4.0, 1.0, 2.0})) << "taken back";
  follow_marks(small, part, ui);
  EXPECT_TRUE(ui.operation.drains.empty());
  EXPECT_TRUE(ui.haptics.guidance.path_mm.empty());
  ASSERT_EQ(ui.notices.size(), 3U);
}

TEST_F(PieceGesturesTest, ADragIsShownAtOnceAndIsOneStepAtItsEnd) {
  perform(Command::piece_gizmo, ui_, document_);
  const Camera::Pixel from = arrow();
  const Camera::Pixel to = beside_arrow(7.0);
  mouse_at(InputEvent::Kind::move, from);
  EXPECT_EQ(ui_.pieces.handle, (GizmoPart{GizmoPart::Kind::along, 0}));
  mouse_at(InputEvent::Kind::press, from);
  mouse_at(InputEvent::Kind::move, {0.5 * (from.x + to.x), 0.5 * (from.y + to.y)});
  mouse_at(InputEvent::Kind::move, to);
  EXPECT_NEAR(shown_placement(ui_).position_mm.x, 7.0, 1e-6);
  EXPECT_NEAR(shown_bounds(ui_).max.x, ui_.clay.bounds_mm.max.x + 7.0, 1e-6);
  settle();
  EXPECT_EQ(x_of_active(), 0.0) << "not before the button is let go";
  mouse_at(InputEvent::Kind::release, to);
  EXPECT_NEAR(shown_placement(ui_).position_mm.x, 7.0, 1e-6) << "until the document has it there";
  settle();
  EXPECT_NEAR(x_of_active(), 7.0, 1e-6);
  ASSERT_EQ(ui_.clay.steps->names.size(), 1U);
  EXPECT_EQ(ui_.clay.steps->names[0], "Clay moved");
  document_.send(DoStep{io::HistoryStep::undo});
  settle();
  EXPECT_EQ(x_of_active(), 0.0);
}

TEST_F(PieceGesturesTest, TheOuterRingMakesThePieceLargerAtOnceAndInOneStep) {
  perform(Command::piece_gizmo, ui_, document_);
  place_active({{4.0, 0.0, 0.0}, {}}, ui_, document_);
  settle();
  const Gizmo gizmo = shown_gizmo(ui_, ui_.camera).value();
  const Vec3 right = ui_.camera.lens({}).right;
  const auto pixel = [&](double along) {
    return ui_.camera.pixel_of(gizmo.center_mm + along * gizmo.length_mm * right);
  };
  mouse_at(InputEvent::Kind::press, pixel(1.5));
  mouse_at(InputEvent::Kind::move, pixel(3.0));
  EXPECT_NEAR(shown_factor(ui_), 2.0, 0.02);
  EXPECT_GT(shown_bounds(ui_).size().x, 70.0) << "for the camera's near and far plane";
  EXPECT_EQ(ui_.clay.voxel_mm, 0.25);
  const double factor = shown_factor(ui_);
  mouse_at(InputEvent::Kind::release, pixel(3.0));
  EXPECT_EQ(shown_factor(ui_), factor) << "until the document has it";
  EXPECT_FALSE(is_drag_done(ui_, false));
  settle();
  EXPECT_TRUE(is_drag_done(ui_, false));
  EXPECT_DOUBLE_EQ(ui_.clay.voxel_mm, 0.25 * factor);
  EXPECT_NEAR(x_of_active(), 4.0, 1e-9) << "about its middle";
  EXPECT_NEAR(ui_.clay.surface_mm.size().z, 40.0 * factor, 0.1);
  ui_.pieces.drag.reset();
  // From its foot it grows upwards.
  const double bottom = foot_of_active(ui_)->z;
  scale_active(0.5, *foot_of_active(ui_), ui_, document_);
  settle();
  EXPECT_NEAR(foot_of_active(ui_)->z, bottom, 1e-4);
  EXPECT_NEAR(ui_.clay.surface_mm.size().z, 20.0 * factor, 0.1);
}

TEST_F(PieceGesturesTest, InStereoADragGoesOnInThePictureThatItBeganIn) {
  ui_.show.is_stereo = true;
  perform(Command::piece_gizmo, ui_, document_);
  const WindowPart left = part_at(ui_.camera, true, {10.0, 300.0});
  const Gizmo gizmo = shown_gizmo(ui_, left.camera).value();
  const Camera::Pixel from =
      left.camera.pixel_of(gizmo.center_mm + 1.2 * gizmo.length_mm * Vec3{1.0, 0.0, 0.0});
  mouse_at(InputEvent::Kind::press, from);
  ASSERT_TRUE(ui_.pieces.drag);
  mouse_at(InputEvent::Kind::move, {399.0, from.y});
  const double before = shown_placement(ui_).position_mm.x;
  mouse_at(InputEvent::Kind::move, {401.0, from.y});
  const double step = shown_placement(ui_).position_mm.x - before;
  EXPECT_GT(step, 0.0);
  EXPECT_LT(step, 5.0) << "two pixels";
}

TEST_F(PieceGesturesTest, ThePieceToMergeWithIsTheChosenOneByAnyName) {
  document_.send(AddBallPiece{});
  document_.send(AddBallPiece{});
  settle();
  ASSERT_EQ(other_piece(ui_), "Clay");
  ui_.pieces.other = ui_.clay.pieces->pieces[1].key;
  ASSERT_EQ(other_piece(ui_), "Ball");
  ChangePiece change{"Ball"};
  change.new_name = "Nose";
  document_.send(DoStep{PieceEdit{change}});
  settle();
  EXPECT_EQ(other_piece(ui_), "Nose");
}

TEST_F(PieceGesturesTest, EscapeTakesADragBackAndAClickIsNoStep) {
  perform(Command::piece_gizmo, ui_, document_);
  const Camera::Pixel from = arrow();
  mouse_at(InputEvent::Kind::press, from);
  mouse_at(InputEvent::Kind::move, beside_arrow(7.0));
  key(kKeyEscape);
  EXPECT_EQ(shown_placement(ui_).position_mm.x, 0.0);
  mouse_at(InputEvent::Kind::release, from);
  mouse_at(InputEvent::Kind::press, from);
  mouse_at(InputEvent::Kind::release, from);
  settle();
  EXPECT_TRUE(ui_.clay.steps->names.empty());
  EXPECT_FALSE(ui_.pieces.drag);
}

TEST_F(PieceGesturesTest, ALockedOrHiddenPieceHasNoGizmo) {
  perform(Command::piece_gizmo, ui_, document_);
  EXPECT_TRUE(shown_gizmo(ui_, ui_.camera));
  for (const bool is_hidden : {false, true}) {
    ChangePiece change{"Clay"};
    change.is_locked = !is_hidden;
    change.is_visible = !is_hidden;
    document_.send(DoStep{PieceEdit{change}});
    settle();
    EXPECT_FALSE(shown_gizmo(ui_, ui_.camera));
  }
}

TEST_F(PieceGesturesTest, APressOnAnotherPieceNeitherSculptsNorTurnsAndTwoMakeItActive) {
  document_.send(AddBallPiece{});
  settle();
  ASSERT_EQ(ui_.clay.pieces->active_piece().look.name, "Ball");
  is_wall_other_ = true;
  const Camera::Pixel first = ui_.camera.pixel_of({});
  const Lens lens = ui_.camera.lens({});
  mouse_at(InputEvent::Kind::press, first);
  EXPECT_FALSE(gestures_.is_stroke_open());
  EXPECT_TRUE(ui_.pieces.refused_at);
  mouse_at(InputEvent::Kind::move, {first.x + 60.0, first.y});
  mouse_at(InputEvent::Kind::release, {first.x + 60.0, first.y});
  EXPECT_EQ(ui_.camera.lens({}), lens);
  EXPECT_FALSE(ui_.pieces.refused_at) << "said near the press only";
  // Somewhere else it is no second press.
  mouse_at(InputEvent::Kind::press, {first.x + 60.0, first.y});
  mouse_at(InputEvent::Kind::release, {first.x + 60.0, first.y});
  settle();
  EXPECT_EQ(ui_.clay.pieces->active_piece().look.name, "Ball");
  mouse_at(InputEvent::Kind::press, first);
  mouse_at(InputEvent::Kind::release, first);
  mouse_at(InputEvent::Kind::press, first);
  mouse_at(InputEvent::Kind::release, first);
  settle();
  EXPECT_EQ(ui_.clay.pieces->active_piece().look.name, "Clay");
  // The key does the same where the pointer is.
  ui_.pointer = ui_.camera.pixel_of({30.0, 0.0, -20.0 + 40.0 / 6.0});
  key('Q', false, {false, false, true});
  settle();
  EXPECT_EQ(ui_.clay.pieces->active_piece().look.name, "Clay") << "a panel lies over it";
  ui_.is_pointer_over_clay_view = true;
  key('Q', false, {false, false, true});
  settle();
  EXPECT_EQ(ui_.clay.pieces->active_piece().look.name, "Ball");
}

TEST_F(PieceGesturesTest, WhatIsPutOnATurnedPieceIsKeptInItsOwnFrame) {
  ChangePiece change{"Clay"};
  change.placement = Placement{{5.0, 0.0, 0.0}, normalized(Quat{1.0, 0.0, 0.0, 1.0})};
  document_.send(DoStep{PieceEdit{change}});
  settle();
  ui_.draws_path = true;
  const Camera::Pixel pixel{410.0, 300.0};
  mouse_at(InputEvent::Kind::press, pixel);
  ASSERT_EQ(ui_.drawn_path_mm.size(), 1U);
  const Ray ray = ui_.camera.ray_at(pixel);
  const Vec3 seen = placed(*change.placement, ui_.drawn_path_mm[0]);
  EXPECT_LT(length(cross(ray.direction, seen - ray.origin_mm)), 1e-3);
  mouse_at(InputEvent::Kind::release, pixel);
  ui_.places_drain = true;
  mouse_at(InputEvent::Kind::press, pixel);
  ASSERT_EQ(ui_.operation.drains.size(), 1U);
  const Vec3 drain = placed(*change.placement, ui_.operation.drains[0].point_mm);
  EXPECT_LT(length(drain - seen), 1e-3);
}

}  // namespace
}  // namespace argil::viewer
