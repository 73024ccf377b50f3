// SPDX-License-Identifier: GPL-3.0-or-later
#include "gestures/pie_gestures.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "commands/command.h"
#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

/// Nothing here draws: events alone open the ring and choose.
class PieTest : public GesturesTest {
 protected:
  PieTest() {
    ui_.camera.resize(1200, 900);
    pointer_ = kMiddle;
    mouse(InputEvent::Kind::move);
    // Each place chooses a command that shows, so that the state tells which was chosen.
    ui_.favourites = {Favourite(Command::wires),      Favourite(Command::slice),
                      Favourite(Command::symmetry_y), Favourite(Command::stereo),
                      Favourite(Command::figures),    Favourite(Command::print),
                      Favourite(Command::pieces),     Favourite(Command::references)};
  }

  void at(double time_s) { now_s_ = time_s; }
  void send(InputEvent event) {
    event.time_s = now_s_;
    event.x = pointer_.x;
    event.y = pointer_.y;
    gestures_.on(event, false);
  }
  void down(int key = kKeyGrave, const Modifiers& held = {}, bool is_repeat = false) {
    InputEvent event;
    event.kind = InputEvent::Kind::key_down;
    event.key = key;
    event.modifiers = held;
    event.is_repeat = is_repeat;
    send(event);
  }
  void up(int key = kKeyGrave) {
    InputEvent event;
    event.kind = InputEvent::Kind::key_up;
    event.key = key;
    send(event);
  }
  void move_to(const Camera::Pixel& pixel) {
    pointer_ = pixel;
    InputEvent event;
    event.kind = InputEvent::Kind::move;
    send(event);
  }
  void press(MouseButton button, const Camera::Pixel& pixel) {
    move_to(pixel);
    InputEvent event;
    event.kind = InputEvent::Kind::press;
    event.button = button;
    send(event);
    event.kind = InputEvent::Kind::release;
    send(event);
  }
  /// So far in the direction of a place.
  static Camera::Pixel toward(const Camera::Pixel& from, double place, double pixels) {
    const double angle = place * std::numbers::pi / 4.0;
    return {from.x + pixels * std::sin(angle), from.y - pixels * std::cos(angle)};
  }
  /// Which places were chosen since the last question.
  std::string chosen() {
    std::string places;
    const auto note = [&](char place, bool is_on) {
      if (is_on) places.push_back(place);
    };
    note('0', ui_.show.has_wires);
    note('1', ui_.show.has_slice);
    note('2', ui_.brush.mirror.y);
    note('3', ui_.show.is_stereo);
    note('4', ui_.panels.has_info);
    note('5', ui_.panels.has_print);
    note('6', ui_.panels.has_pieces);
    note('7', ui_.panels.has_references);
    ui_.show = {};
    ui_.brush.mirror = {};
    ui_.panels = {};
    return places;
  }

  static constexpr Camera::Pixel kMiddle{600.0, 450.0};
  double now_s_ = 10.0;
};

TEST_F(PieTest, AFlickChoosesByItsDirectionWithoutADrawnRing) {
  for (int place = 0; place < 8; ++place) {
    for (const double aside : {-0.45, 0.0, 0.45}) {  // within an eighth of a turn
      for (const double pixels : {31.0, 90.0, 400.0}) {
        move_to(kMiddle);
        down();
        move_to(toward(kMiddle, place + aside, pixels));
        up();
        EXPECT_EQ(chosen(), std::to_string(place)) << aside << " " << pixels;
        EXPECT_FALSE(ui_.pie.is_open);
      }
    }
  }
}

TEST_F(PieTest, AShortPressLeavesItOpenForAClick) {
  down();
  down(kKeyGrave, {}, true);  // the keyboard repeats
  move_to(toward(kMiddle, 3.0, 12.0));
  up();
  ASSERT_TRUE(ui_.pie.is_open);
  EXPECT_EQ(chosen(), "");
  press(MouseButton::left, toward(kMiddle, 5.0, 80.0));
  EXPECT_EQ(chosen(), "5");
  EXPECT_FALSE(ui_.pie.is_open);
  EXPECT_FALSE(gestures_.is_stroke_open()) << "the click is the ring's alone";
}

TEST_F(PieTest, TheMiddleIsNothing) {
  down();
  up();
  press(MouseButton::left, toward(kMiddle, 1.0, 29.0));
  EXPECT_FALSE(ui_.pie.is_open);
  // Out and back again with the key held: whoever comes back has thought better of it.
  move_to(kMiddle);
  down();
  move_to(toward(kMiddle, 1.0, 80.0));
  move_to(kMiddle);
  up();
  EXPECT_FALSE(ui_.pie.is_open);
  EXPECT_EQ(chosen(), "");
}

/// All keys are let go then, though nobody let them go.
TEST_F(PieTest, AnotherWindowThatTakesTheKeyboardChoosesNothing) {
  InputEvent away;
  away.kind = InputEvent::Kind::away;
  down();
  move_to(toward(kMiddle, 2.0, 80.0));
  send(away);
  up();
  EXPECT_EQ(chosen(), "");
  EXPECT_FALSE(ui_.pie.is_open);
  // One that is open for a click waits for it.
  move_to(kMiddle);
  down();
  up();
  send(away);
  press(MouseButton::left, toward(kMiddle, 5.0, 80.0));
  EXPECT_EQ(chosen(), "5");
}

TEST_F(PieTest, EscapeTheRightButtonAndItsOwnKeyCloseIt) {
  for (int way = 0; way < 3; ++way) {
    move_to(kMiddle);
    down();
    up();
    ASSERT_TRUE(ui_.pie.is_open);
    if (way == 0) down(kKeyEscape);
    if (way == 1) press(MouseButton::right, toward(kMiddle, 2.0, 80.0));
    if (way == 2) down();
    EXPECT_FALSE(ui_.pie.is_open) << way;
    up();
    EXPECT_FALSE(ui_.pie.is_open) << way;
    EXPECT_EQ(chosen(), "") << way;
  }
  // While it is held, too: letting go of the key chooses nothing then.
  move_to(kMiddle);
  down();
  move_to(toward(kMiddle, 2.0, 80.0));
  down(kKeyEscape);
  up();
  EXPECT_EQ(chosen(), "");
}

TEST_F(PieTest, IsNotModal) {
  down();
  up();
  const double distance = ui_.camera.distance_mm();
  InputEvent scroll;
  scroll.kind = InputEvent::Kind::scroll;
  scroll.steps = 1.0;
  send(scroll);
  EXPECT_NE(ui_.camera.distance_mm(), distance);
  EXPECT_TRUE(ui_.pie.is_open);
  down('P');  // another tool: whoever goes on no longer means the ring
  EXPECT_EQ(ui_.brush.action, Action::pinch);
  EXPECT_FALSE(ui_.pie.is_open);
  down();
  up();
  ui_.haptics.device = DeviceChoice::sim;
  down(kKeySpace);
  EXPECT_TRUE(ui_.wants_emergency_stop);
}

TEST_F(PieTest, AClickFarBesideItIsTheClays) {
  down();
  up();
  InputEvent event;
  event.kind = InputEvent::Kind::press;
  move_to(toward(kMiddle, 2.0, 180.0));
  send(event);
  EXPECT_FALSE(ui_.pie.is_open);
  EXPECT_TRUE(gestures_.is_stroke_open());
  EXPECT_EQ(chosen(), "");
}

TEST_F(PieTest, DuringAStrokeItsKeyIsAMistake) {
  InputEvent event;
  event.kind = InputEvent::Kind::press;
  send(event);
  ASSERT_TRUE(gestures_.is_stroke_open());
  down();
  move_to(toward(kMiddle, 2.0, 80.0));
  up();
  EXPECT_FALSE(ui_.pie.is_open);
  EXPECT_TRUE(gestures_.is_stroke_open());
  EXPECT_EQ(chosen(), "");
}

TEST_F(PieTest, ADialogTakesItsPlace) {
  down();
  up();
  ui_.panels.is_new_open = true;
  press(MouseButton::left, toward(kMiddle, 2.0, 80.0));
  EXPECT_FALSE(ui_.pie.is_open);
  EXPECT_FALSE(ui_.brush.mirror.y);
  down();
  EXPECT_FALSE(ui_.pie.is_open);
}

TEST_F(PieTest, StaysWhollyInTheWindowAtAllEdgesAndScales) {
  for (const double scale : {0.75, 1.0, 2.0, 3.0}) {
    ui_.panel_scale = scale;
    const double reach = kPieReach * scale;
    for (const double x : {0.0, 3.0, 600.0, 1199.0}) {
      for (const double y : {0.0, 450.0, 899.0}) {
        ui_.pie = {};
        ui_.pointer = {x, y};
        perform(Command::favourites, ui_, document_);
        const Camera::Pixel middle = middle_of_pie(ui_);
        EXPECT_GE(middle.x, reach);
        EXPECT_LE(middle.x, 1200.0 - reach);
        EXPECT_GE(middle.y, reach);
        EXPECT_LE(middle.y, 900.0 - reach);
        const bool fits = x >= reach + 4.0 * scale && x <= 1200.0 - reach - 4.0 * scale &&
                          y >= reach + 4.0 * scale && y <= 900.0 - reach - 4.0 * scale;
        EXPECT_EQ(std::hypot(middle.x - x, middle.y - y) == 0.0, fits) << x << " " << y;
      }
    }
  }
  ui_.camera.resize(320, 240);  // smaller than the ring at this scale
  EXPECT_EQ(middle_of_pie(ui_).x, 160.0);
  EXPECT_EQ(middle_of_pie(ui_).y, 120.0);
}

TEST_F(PieTest, TheMiddleGrowsWithTheScale) {
  const Camera::Pixel to = toward(kMiddle, 2.0, 50.0);
  EXPECT_EQ(pie_place(kMiddle, to, 1.0), 2U);
  EXPECT_EQ(pie_place(kMiddle, to, 2.0), std::nullopt);
}

/// At the left edge the ring stands to the right of the pointer. A flick is blind; who looks first
/// means what he sees.
TEST_F(PieTest, AtAnEdgeAFlickIsOfItsDirectionAndALaterWayOfTheRing) {
  const Camera::Pixel edge{2.0, 450.0};
  const auto go = [&](double seconds) {
    at(10.0);
    move_to(edge);
    down();
    at(10.0 + seconds);
    move_to({62.0, 450.0});
    up();
  };
  go(0.1);
  EXPECT_EQ(chosen(), "2") << "to the right";
  go(0.5);
  EXPECT_EQ(chosen(), "6") << "the entry at the left of the ring, whose middle is at 134";
  // What letting go chooses is what the last move has marked, however long the hand rests there.
  at(10.0);
  move_to(edge);
  down();
  at(10.1);
  move_to({62.0, 450.0});
  ASSERT_EQ(ui_.pie.marked, 2U);
  at(12.0);
  up();
  EXPECT_EQ(chosen(), "2");
}

TEST_F(PieTest, AnotherKeyThatIsGivenWorksWithWhatIsHeldWithIt) {
  ui_.keys.give(Command::favourites, chord_of("Ctrl+F9"));
  down();
  EXPECT_FALSE(ui_.pie.is_open);
  up();
  const int f9 = chord_of("F9")->key;
  down(f9, {false, true, false});
  ASSERT_TRUE(ui_.pie.is_open);
  down(f9, {}, true);  // Ctrl was let go of first: the repeated key is not another one
  move_to(toward(kMiddle, 4.0, 80.0));
  up(f9);
  EXPECT_EQ(chosen(), "4");
}

TEST_F(PieTest, EveryChoiceOfKeysHasOneForIt) {
  for (const KeySet set : {KeySet::argil, KeySet::blender, KeySet::zbrush}) {
    EXPECT_FALSE(KeyMap(set).text_of(Command::favourites).empty());
  }
  EXPECT_EQ(KeyMap(KeySet::blender).text_of(Command::favourites), "Q") << "its Quick Favorites";
}

TEST_F(PieTest, ByMenuAndSearchItIsOpenForAClick) {
  perform(Command::favourites, ui_, document_);
  ASSERT_TRUE(ui_.pie.is_open);
  up(0);  // of a key without a number
  EXPECT_TRUE(ui_.pie.is_open);
  press(MouseButton::left, toward(kMiddle, 7.0, 100.0));
  EXPECT_EQ(chosen(), "7");
}

}  // namespace
}  // namespace argil::viewer
