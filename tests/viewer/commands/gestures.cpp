// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/gestures.h"

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

TEST_F(GesturesTest, InStereoAPressSaysWhyNothingHappens) {
  ui_.show.is_stereo = true;
  mouse(InputEvent::Kind::press);
  EXPECT_FALSE(gestures_.is_stroke_open());
  ASSERT_EQ(ui_.notices.size(), 1U);
  EXPECT_NE(ui_.notices[0].text.find("Shift+Z"), std::string::npos);
  mouse(InputEvent::Kind::release);
  mouse(InputEvent::Kind::press, MouseButton::right);
  EXPECT_EQ(ui_.notices.size(), 1U) << "who turns it means that";
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
    Gestures gestures{ui, document_, [this] { return wall(); }};
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
