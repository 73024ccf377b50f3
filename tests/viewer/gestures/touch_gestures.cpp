// SPDX-License-Identifier: GPL-3.0-or-later
// One finger is the pointer, several are the view.
#include <optional>

#include <gtest/gtest.h>

#include "viewer/support/gestures_test.h"
#include "viewer/support/projected.h"

namespace argil::viewer {
namespace {

class TouchGesturesTest : public GesturesTest {
 protected:
  void finger(InputEvent::Kind kind, unsigned number, const Camera::Pixel& at,
              double time_s = 0.0) {
    InputEvent event;
    event.kind = kind;
    event.finger = number;
    event.x = at.x;
    event.y = at.y;
    event.time_s = time_s;
    gestures_.on(event, false);
  }
  void down(unsigned number, const Camera::Pixel& at, double time_s = 0.0) {
    finger(InputEvent::Kind::finger_down, number, at, time_s);
  }
  void move(unsigned number, const Camera::Pixel& at) {
    finger(InputEvent::Kind::finger_move, number, at);
  }
  void up(unsigned number, double time_s = 0.0) {
    finger(InputEvent::Kind::finger_up, number, {}, time_s);
  }
};

TEST_F(TouchGesturesTest, OneFingerMovesNothing) {
  const Vec3 before = test::projected(ui_.camera, {});
  down(1, {10.0, 10.0});
  move(1, {50.0, 50.0});
  up(1);
  EXPECT_EQ(test::projected(ui_.camera, {}), before);
}

TEST_F(TouchGesturesTest, TwoFingersMoveTheViewByTheirMiddle) {
  down(1, {10.0, 20.0});
  down(2, {50.0, 20.0});
  move(1, {10.0, 40.0});  // no tap any more
  move(2, {50.0, 40.0});
  const Vec3 before = test::projected(ui_.camera, {});
  for (const double y : {44.0, 48.0}) {
    move(1, {10.0, y});
    move(2, {50.0, y});
  }
  const Vec3 moved = test::projected(ui_.camera, {}) - before;
  EXPECT_NEAR(moved.y, 8.0, 1.0) << "in pixels, down";
  EXPECT_NEAR(moved.x, 0.0, 1.0);
}

TEST_F(TouchGesturesTest, TwoFingersThatPartBringThePieceNearerWhereTheyAre) {
  down(1, {20.0, 32.0});
  down(2, {44.0, 32.0});
  move(1, {4.0, 32.0});
  const double before = ui_.camera.distance_mm();
  move(2, {60.0, 32.0});  // from 40 pixels apart to 56
  EXPECT_NEAR(before / ui_.camera.distance_mm(), 56.0 / 40.0, 0.01);
}

TEST_F(TouchGesturesTest, TheSecondFingerTakesBackWhatTheFirstHasJustBegun) {
  down(1, pointer_);
  mouse(InputEvent::Kind::press);
  ASSERT_TRUE(gestures_.is_stroke_open());
  down(2, {50.0, 50.0}, 0.1);
  EXPECT_FALSE(gestures_.is_stroke_open());
  // The pointer goes on with the first finger, and works nothing until all have left.
  mouse(InputEvent::Kind::release);
  mouse(InputEvent::Kind::press);
  EXPECT_FALSE(gestures_.is_stroke_open());
  up(2);
  mouse(InputEvent::Kind::press);
  EXPECT_FALSE(gestures_.is_stroke_open());
  up(1);
  mouse(InputEvent::Kind::press);
  EXPECT_TRUE(gestures_.is_stroke_open());
}

TEST_F(TouchGesturesTest, AnOutlineStaysWhereItWasDrawn) {
  const Vec3 before = test::projected(ui_.camera, {});
  down(1, {10.0, 20.0});
  down(2, {50.0, 20.0});
  ui_.outline.emplace();  // of a curve that is being clicked together
  move(1, {10.0, 50.0});
  move(2, {50.0, 50.0});
  EXPECT_EQ(test::projected(ui_.camera, {}), before);
}

TEST_F(TouchGesturesTest, ASecondFingerTakesBackAPointOfACurve) {
  ui_.brush.stroke_mode = StrokeMode::curve;
  down(1, pointer_);
  mouse(InputEvent::Kind::press);
  ASSERT_TRUE(ui_.guide);
  down(2, {50.0, 50.0}, 0.1);
  EXPECT_FALSE(ui_.guide);
}

/// Taps by themselves: what commands do is of others.
class TouchTaps : public testing::Test {
 protected:
  /// So many fingers come within the time, one moves so far, and all leave at its end.
  std::optional<Command> tap(unsigned fingers, double end_s, double way = 0.0,
                             bool is_taken = false) {
    InputEvent event;
    for (event.finger = 1; event.finger <= fingers; ++event.finger) {
      event.kind = InputEvent::Kind::finger_down;
      event.x = 100.0 * event.finger;
      touch_.on(event, is_taken);
    }
    event.kind = InputEvent::Kind::finger_move;
    event.finger = 1;
    event.x = 100.0 + way;
    touch_.on(event, is_taken);
    event.kind = InputEvent::Kind::finger_up;
    event.time_s = end_s;
    std::optional<Command> told;
    for (event.finger = 1; event.finger <= fingers; ++event.finger) {
      const TouchGestures::Answer answer = touch_.on(event, is_taken);
      if (answer.command) told = answer.command;
    }
    EXPECT_FALSE(touch_.has_view());
    return told;
  }

  UiState ui_;
  TouchGestures touch_{ui_};
};

TEST_F(TouchTaps, OfTwoTakesAStepBackAndOfThreeForward) {
  EXPECT_EQ(tap(2, 0.2), Command::undo);
  EXPECT_EQ(tap(3, 0.2), Command::redo);
  EXPECT_EQ(tap(1, 0.2), std::nullopt);
  EXPECT_EQ(tap(4, 0.2), std::nullopt);
}

TEST_F(TouchTaps, AreShortAndStayWhereTheyAre) {
  EXPECT_EQ(tap(2, 0.4), std::nullopt);
  EXPECT_EQ(tap(2, 0.2, 30.0), std::nullopt);
  EXPECT_EQ(tap(2, 0.2, 5.0), Command::undo);
}

TEST_F(TouchTaps, OnAPanelAreForThePanel) {
  EXPECT_EQ(tap(2, 0.2, 0.0, true), std::nullopt);
  EXPECT_EQ(tap(2, 0.2), Command::undo) << "the next are judged anew";
}

}  // namespace
}  // namespace argil::viewer
