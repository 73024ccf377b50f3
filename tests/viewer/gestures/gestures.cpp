// SPDX-License-Identifier: GPL-3.0-or-later
#include "gestures/gestures.h"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "commands/command.h"
#include "viewer/support/gestures_test.h"
#include "viewer/support/projected.h"

namespace argil::viewer {
namespace {

TEST_F(GesturesTest, TheRedStopIsHeardDuringAStrokeAndWithAnyKeyHeld) {
  mouse(InputEvent::Kind::press);
  ASSERT_TRUE(gestures_.is_stroke_open());
  key(kKeySpace);
  EXPECT_TRUE(std::exchange(ui_.wants_emergency_stop, false));
  EXPECT_TRUE(gestures_.is_stroke_open());
  mouse(InputEvent::Kind::release);
  key(kKeySpace, false, {true, true, false});
  EXPECT_TRUE(std::exchange(ui_.wants_emergency_stop, false));
}

TEST_F(GesturesTest, TheRedStopOnlyStopsAndGoingOnIsAskedForByItself) {
  key(kKeySpace);
  EXPECT_TRUE(std::exchange(ui_.wants_emergency_stop, false));
  ui_.is_force_stopped = true;
  key(kKeySpace);
  EXPECT_TRUE(std::exchange(ui_.wants_emergency_stop, false));
  EXPECT_FALSE(ui_.wants_force);
  perform(Command::give_force, ui_, document_);
  EXPECT_TRUE(std::exchange(ui_.wants_force, false));
  ui_.is_force_stopped = false;
  perform(Command::give_force, ui_, document_);  // there is nothing to give again
  EXPECT_FALSE(ui_.wants_force);
}

TEST_F(GesturesTest, BehindADialogNothingReactsButTheRedStop) {
  ui_.panels.is_operations_open = true;
  ui_.camera.resize(64, 64);
  const double distance = ui_.camera.distance_mm();
  key('X');
  key('C');
  mouse(InputEvent::Kind::press);
  mouse(InputEvent::Kind::scroll);
  EXPECT_FALSE(ui_.brush.mirror.x);
  EXPECT_EQ(ui_.brush.action, Brush().action);
  EXPECT_FALSE(gestures_.is_stroke_open());
  EXPECT_EQ(ui_.camera.distance_mm(), distance);
  key(kKeySpace);
  EXPECT_TRUE(std::exchange(ui_.wants_emergency_stop, false));
  // A space in a file's name is none, unless there is a force to be stopped.
  InputEvent space;
  space.kind = InputEvent::Kind::key_down;
  space.key = kKeySpace;
  gestures_.on(space, true);
  EXPECT_FALSE(ui_.wants_emergency_stop);
  ui_.haptics.device = DeviceChoice::sim;
  gestures_.on(space, true);
  EXPECT_TRUE(ui_.wants_emergency_stop);
  ui_.haptics.device = DeviceChoice::mouse;
  // Also from a field that somebody types into.
  InputEvent escape;
  escape.kind = InputEvent::Kind::key_down;
  escape.key = kKeyEscape;
  gestures_.on(escape, true);
  EXPECT_EQ(open_dialog(ui_), Dialog::none);
  key('X');
  EXPECT_TRUE(ui_.brush.mirror.x);
}

/// Where an eye sees the wall, at a pixel of the window.
Vec3 seen_on_wall(const WindowPart& part, const Camera::Pixel& pixel) {
  const Ray ray = part.ray_at(pixel);
  const Vec3 back = part.camera.lens({}).back;
  return ray.origin_mm - part.camera.distance_mm() / dot(ray.direction, back) * ray.direction;
}

TEST_F(GesturesTest, InStereoAStrokeIsWhereTheEyeOfThatHalfSeesIt) {
  ui_.show.is_stereo = true;
  const auto eyes = parts_of(ui_.camera, true);
  ASSERT_EQ(eyes.size(), 2U);
  for (const WindowPart& eye : eyes) {
    const Camera::Pixel first{eye.left + 10.5, 20.5};
    const Camera::Pixel second{eye.left + 21.5, 33.5};
    mouse_at(InputEvent::Kind::press, first);
    ASSERT_TRUE(gestures_.tool_hit());
    EXPECT_LT(length(gestures_.tool_hit()->point_mm - seen_on_wall(eye, first)), 1e-3);
    mouse_at(InputEvent::Kind::move, second);
    ASSERT_TRUE(gestures_.tool_hit());
    EXPECT_LT(length(gestures_.tool_hit()->point_mm - seen_on_wall(eye, second)), 1e-3);
    mouse_at(InputEvent::Kind::release, second);
    EXPECT_FALSE(gestures_.is_stroke_open());
  }
  EXPECT_GT(length(seen_on_wall(eyes[0], {10.5, 20.5}) - seen_on_wall(eyes[1], {42.5, 20.5})), 0.1)
      << "the eyes see the same column elsewhere";
  EXPECT_TRUE(ui_.notices.empty());
}

TEST_F(GesturesTest, AStrokeLeavesTheClayWhereItGoesOverToTheOtherEye) {
  ui_.show.is_stereo = true;
  mouse_at(InputEvent::Kind::press, {20.0, 32.0});
  ASSERT_TRUE(gestures_.tool_hit());
  mouse_at(InputEvent::Kind::move, {44.0, 32.0});
  EXPECT_TRUE(gestures_.is_stroke_open());
  EXPECT_FALSE(gestures_.tool_hit()) << "the other half shows another picture";
  mouse_at(InputEvent::Kind::move, {24.0, 32.0});
  ASSERT_TRUE(gestures_.tool_hit());
  EXPECT_LT(length(gestures_.tool_hit()->point_mm -
                   seen_on_wall(parts_of(ui_.camera, true)[0], {24.0, 32.0})),
            1e-3);
}

TEST_F(GesturesTest, InStereoWhatIsGrabbedStaysInThePlaneOfItsEye) {
  ui_.show.is_stereo = true;
  ui_.brush.action = Action::grab;
  const WindowPart right = parts_of(ui_.camera, true)[1];
  mouse_at(InputEvent::Kind::press, {48.0, 32.0});
  ASSERT_TRUE(gestures_.tool_hit());
  const Vec3 grip = gestures_.tool_hit()->point_mm;
  // Also over the left half, as beyond the edge of a window.
  mouse_at(InputEvent::Kind::move, {20.0, 30.0});
  ASSERT_TRUE(gestures_.tool_hit());
  const Vec3 moved = gestures_.tool_hit()->point_mm - grip;
  const Lens lens = right.camera.lens({});
  const double pixel_mm = right.camera.pixel_mm_at(grip);
  EXPECT_NEAR(dot(moved, lens.back), 0.0, 1e-9);
  EXPECT_NEAR(dot(moved, lens.right), -28.0 * pixel_mm, 0.01 * pixel_mm);
  EXPECT_NEAR(dot(moved, lens.up), 2.0 * pixel_mm, 0.01 * pixel_mm);
}

TEST_F(GesturesTest, InStereoADrainIsPutWhereTheEyeOfThatHalfSeesIt) {
  ui_.show.is_stereo = true;
  ui_.places_drain = true;
  mouse_at(InputEvent::Kind::press, {50.5, 30.5});
  ASSERT_EQ(ui_.operation.drains.size(), 1U);
  const WindowPart right = parts_of(ui_.camera, true)[1];
  EXPECT_LT(length(ui_.operation.drains[0].point_mm - seen_on_wall(right, {50.5, 30.5})), 1e-3);
  EXPECT_FALSE(ui_.places_drain);
}

TEST_F(GesturesTest, EscapeEndsATurntableAndNothingElse) {
  perform(Command::turntable, ui_, document_);
  ASSERT_EQ(ui_.turntable_left, kTurntableFrames);
  ui_.panels.has_help = true;
  key(kKeyEscape);
  EXPECT_EQ(ui_.turntable_left, 0);
  EXPECT_TRUE(ui_.panels.has_help);
}

TEST_F(GesturesTest, AKeyThatIsHeldSwitchesOnce) {
  key(kKeySpace, true);
  EXPECT_FALSE(ui_.wants_emergency_stop);
  key('X');
  key('X', true);
  EXPECT_TRUE(ui_.brush.mirror.x);
  const double radius = ui_.brush.radius_mm;
  key(kKeyRightBracket);
  key(kKeyRightBracket, true);
  EXPECT_NEAR(ui_.brush.radius_mm, 1.21 * radius, 1e-9);
}

TEST_F(GesturesTest, AnotherButtonNeitherEndsAStrokeNorBeginsASecondDrag) {
  mouse(InputEvent::Kind::press);
  mouse(InputEvent::Kind::press, MouseButton::right);
  mouse(InputEvent::Kind::release, MouseButton::right);
  EXPECT_TRUE(gestures_.is_stroke_open());
  mouse(InputEvent::Kind::release);
  EXPECT_FALSE(gestures_.is_stroke_open());
  mouse(InputEvent::Kind::release);
  EXPECT_FALSE(gestures_.is_stroke_open());
}

TEST_F(GesturesTest, AKeyWhileTheHandOfADeviceWorksOnlyLetsGoOfTheTool) {
  ui_.is_hand_led = true;
  mouse(InputEvent::Kind::press);
  ASSERT_TRUE(gestures_.is_hand_pressing());
  const bool has_pieces = ui_.panels.has_pieces;
  key('P', false, {.ctrl = true});
  EXPECT_EQ(ui_.panels.has_pieces, has_pieces);
  key(kClutchKey);
  EXPECT_TRUE(ui_.is_clutched);
  mouse(InputEvent::Kind::release);
  key('P', false, {.ctrl = true});
  EXPECT_NE(ui_.panels.has_pieces, has_pieces);
}

TEST_F(GesturesTest, TheNumberRowIsTheNumpadWhereItWasChosen) {
  ui_.camera.look_from({1.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  key('1');
  EXPECT_NEAR(ui_.camera.lens({}).back.x, 1.0, 1e-9);
  ui_.settings.has_number_views = true;
  key('1');
  EXPECT_NEAR(ui_.camera.lens({}).back.y, -1.0, 1e-9);
  key('1', false, {false, true, false});
  EXPECT_NEAR(ui_.camera.lens({}).back.y, 1.0, 1e-9);
}

/// Along the wall, from one pixel to another.
void drag_path(Gestures& gestures, double from, double to) {
  InputEvent event;
  event.y = 32.0;
  event.x = from;
  event.kind = InputEvent::Kind::press;
  gestures.on(event, false);
  event.kind = InputEvent::Kind::move;
  for (event.x = from; event.x <= to; event.x += 1.0) gestures.on(event, false);
  event.kind = InputEvent::Kind::release;
  gestures.on(event, false);
}

TEST_F(GesturesTest, ADragDrawsAPathAndNoStrokeWhereOneIsAskedFor) {
  drag_path(gestures_, 10.0, 50.0);
  EXPECT_TRUE(ui_.haptics.guidance.path_mm.empty()) << "a stroke";
  ui_.draws_path = true;
  drag_path(gestures_, 10.0, 50.0);
  const std::vector<Vec3> path = ui_.haptics.guidance.path_mm;
  ASSERT_GT(path.size(), 5U);
  EXPECT_FALSE(gestures_.is_stroke_open());
  EXPECT_FALSE(ui_.draws_path) << "one drag";
  EXPECT_EQ(ui_.haptics.guidance.kind, haptics::GuidanceKind::direct) << "it is felt at once";
  const Vec3 first = test::projected(ui_.camera, path.front());
  const Vec3 last = test::projected(ui_.camera, path.back());
  EXPECT_NEAR(first.x, 10.0, 1.5);
  EXPECT_NEAR(last.x, 50.0, 1.5);
  EXPECT_NEAR(first.y, 32.0, 1.5);
  EXPECT_TRUE(haptics::check_guidance(ui_.haptics.guidance).ok());
}

/// To and fro for longer than guidance takes points: all of it is kept, at wider steps.
TEST_F(GesturesTest, ALongPathIsThinnedOutAndNotCutShort) {
  ui_.draws_path = true;
  InputEvent event;
  event.y = 32.0;
  event.x = 10.0;
  event.kind = InputEvent::Kind::press;
  gestures_.on(event, false);
  event.kind = InputEvent::Kind::move;
  for (int n = 0; n < 4000; ++n) {
    event.x = 10.0 + 20.0 * (n % 2);
    event.y = 16.0 + 32.0 * n / 4000.0;
    gestures_.on(event, false);
  }
  event.x = 50.0;
  gestures_.on(event, false);
  event.kind = InputEvent::Kind::release;
  gestures_.on(event, false);
  const std::vector<Vec3>& path = ui_.haptics.guidance.path_mm;
  EXPECT_EQ(path.size(), haptics::GuidanceOptions::kMostPoints);
  const Vec3 last = test::projected(ui_.camera, path.back());
  EXPECT_NEAR(last.x, 50.0, 1.5) << "to its end";
  EXPECT_NEAR(last.y, 48.0, 1.5);
}

TEST_F(GesturesTest, EscapeGivesAPathUpAndKeepsTheFormerOne) {
  ui_.draws_path = true;
  drag_path(gestures_, 10.0, 50.0);
  const std::vector<Vec3> former = ui_.haptics.guidance.path_mm;
  ui_.draws_path = true;
  mouse(InputEvent::Kind::press);
  EXPECT_FALSE(ui_.drawn_path_mm.empty());
  key(kKeyEscape);
  EXPECT_FALSE(ui_.draws_path);
  EXPECT_TRUE(ui_.drawn_path_mm.empty());
  mouse(InputEvent::Kind::release);
  EXPECT_EQ(ui_.haptics.guidance.path_mm, former);
}

InputEvent pushed(const Vec3& shift, const Vec3& turn) {
  InputEvent event;
  event.kind = InputEvent::Kind::puck;
  event.puck_shift = shift;
  event.puck_turn = turn;
  event.puck_s = 0.1;
  return event;
}

TEST_F(GesturesTest, ThePieceFollowsThePuckOfA3DMouse) {
  const Vec3 front = ui_.camera.target_mm() + Vec3{0.0, -10.0, 0.0};  // towards the camera
  const auto moved = [&](const Vec3& shift, const Vec3& turn) {
    UiState ui;
    ui.camera = ui_.camera;
    Gestures gestures{ui, document_, [this](const Camera::Pixel& at) { return wall(at); }};
    gestures.on(pushed(shift, turn), false);
    return test::projected(ui.camera, front) - test::projected(ui_.camera, front);
  };
  EXPECT_GT(moved({1.0, 0.0, 0.0}, {}).x, 1.0);
  EXPECT_LT(moved({0.0, 1.0, 0.0}, {}).y, -1.0) << "pixels go down";
  EXPECT_GT(moved({0.0, 0.0, 1.0}, {}).z, 1.0) << "pushed away";
  EXPECT_GT(moved({}, {0.0, 1.0, 0.0}).x, 0.1) << "its front goes to the right";
  EXPECT_GT(moved({}, {1.0, 0.0, 0.0}).y, 0.1) << "its front goes down";
}

TEST_F(GesturesTest, AStrokeStaysInThePictureThatItBeganIn) {
  mouse(InputEvent::Kind::press);
  ASSERT_TRUE(gestures_.is_stroke_open());
  const Vec3 before = test::projected(ui_.camera, {});
  gestures_.on(pushed({1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}), false);
  EXPECT_EQ(test::projected(ui_.camera, {}), before);
}

}  // namespace
}  // namespace argil::viewer
