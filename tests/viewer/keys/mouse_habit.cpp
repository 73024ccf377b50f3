// SPDX-License-Identifier: GPL-3.0-or-later
#include "keys/mouse_habit.h"

#include <gtest/gtest.h>

#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

using What = PressMeaning::What;

constexpr Modifiers kBare{};
constexpr Modifiers kShift{true, false, false};
constexpr Modifiers kCtrl{false, true, false};
constexpr Modifiers kAlt{false, false, true};
constexpr Modifiers kCtrlAlt{false, true, true};
constexpr Modifiers kCtrlShift{true, true, false};

TEST(MouseHabit, OfArgilTurnsByRightAndMovesByMiddle) {
  const auto what = [](MouseButton button, const Modifiers& held) {
    return meaning_of(KeySet::argil, button, held).what;
  };
  EXPECT_EQ(what(MouseButton::right, kBare), What::turn);
  EXPECT_EQ(what(MouseButton::right, kShift), What::move);
  EXPECT_EQ(what(MouseButton::middle, kBare), What::move);
  EXPECT_EQ(what(MouseButton::left, kAlt), What::turn);
  EXPECT_EQ(what(MouseButton::left, {true, false, true}), What::move);
  EXPECT_EQ(what(MouseButton::left, kCtrl), What::work);
}

TEST(MouseHabit, OfBlenderTurnsByMiddleAndMovesByShiftAndMiddle) {
  const auto what = [](MouseButton button, const Modifiers& held) {
    return meaning_of(KeySet::blender, button, held).what;
  };
  EXPECT_EQ(what(MouseButton::middle, kBare), What::turn);
  EXPECT_EQ(what(MouseButton::middle, kShift), What::move);
  EXPECT_EQ(what(MouseButton::right, kBare), What::turn);
  EXPECT_EQ(meaning_of(KeySet::blender, MouseButton::left, kCtrl).held, kCtrl);
  EXPECT_EQ(meaning_of(KeySet::blender, MouseButton::left, kShift).held, kShift);
}

TEST(MouseHabit, OfZBrushDoesTheOppositeByAltAndMasksByCtrl) {
  const auto left = [](const Modifiers& held) {
    return meaning_of(KeySet::zbrush, MouseButton::left, held);
  };
  EXPECT_EQ(left(kBare).held, kBare);
  EXPECT_EQ(left(kBare).beside, What::turn);
  EXPECT_EQ(left(kAlt).what, What::work);
  EXPECT_EQ(left(kAlt).held, kCtrl);
  EXPECT_EQ(left(kAlt).beside, What::move);
  EXPECT_TRUE(left(kCtrl).is_mask);
  EXPECT_EQ(left(kCtrl).held, kBare);
  EXPECT_TRUE(left(kCtrlAlt).is_mask);
  EXPECT_EQ(left(kCtrlAlt).held, kCtrl);
  EXPECT_FALSE(left(kCtrlShift).is_mask);
  EXPECT_EQ(left(kCtrlShift).held, kCtrlShift);
  EXPECT_EQ(left(kShift).held, kShift);
  EXPECT_EQ(meaning_of(KeySet::zbrush, MouseButton::right, kBare).what, What::turn);
  EXPECT_EQ(meaning_of(KeySet::zbrush, MouseButton::right, kAlt).what, What::move);
}

/// A press of a button with modifiers, and what stands where the camera stood.
class MouseHabitTest : public GesturesTest {
 protected:
  void press_and_drag(const Modifiers& held, MouseButton button = MouseButton::left) {
    InputEvent event;
    event.kind = InputEvent::Kind::move;
    event.button = button;
    event.modifiers = held;
    event.is_eraser = is_eraser_;
    event.x = event.y = 32.0;
    gestures_.on(event, false);
    event.kind = InputEvent::Kind::press;
    gestures_.on(event, false);
    event.kind = InputEvent::Kind::move;
    event.x = 40.0;
    gestures_.on(event, false);
  }

  bool is_eraser_ = false;
};

TEST_F(MouseHabitTest, AltAndLeftWorkInZBrushsSetAndTurnInTheOthers) {
  const Vec3 before = ui_.camera.lens({}).eye_mm;
  ui_.keys.choose(KeySet::zbrush);
  press_and_drag(kAlt);
  EXPECT_TRUE(gestures_.is_stroke_open());
  EXPECT_EQ(ui_.camera.lens({}).eye_mm, before);
  mouse(InputEvent::Kind::release);
  ui_.keys.choose(KeySet::argil);
  press_and_drag(kAlt);
  EXPECT_FALSE(gestures_.is_stroke_open());
  EXPECT_NE(ui_.camera.lens({}).eye_mm, before);
}

TEST_F(MouseHabitTest, ThePensOtherEndDoesTheOpposite) {
  // Seen by an outline: it keeps whether it is inverse.
  ui_.brush.action = Action::mask;
  ui_.outlines.mask = DragForm::lasso;
  for (const KeySet set : {KeySet::argil, KeySet::zbrush}) {
    ui_.keys.choose(set);
    for (const bool is_eraser : {false, true}) {
      is_eraser_ = is_eraser;
      press_and_drag(kBare);
      ASSERT_TRUE(ui_.outline);
      EXPECT_EQ(ui_.outline->is_inverse, is_eraser);
      mouse(InputEvent::Kind::release);
    }
    // With what does the opposite already, it does what is usual.
    is_eraser_ = true;
    press_and_drag(set == KeySet::argil ? kCtrl : kAlt);
    ASSERT_TRUE(ui_.outline);
    EXPECT_FALSE(ui_.outline->is_inverse);
    mouse(InputEvent::Kind::release);
  }
}

TEST_F(MouseHabitTest, MiddleTurnsInBlendersSet) {
  const Vec3 target = ui_.camera.target_mm();
  const Vec3 eye = ui_.camera.lens({}).eye_mm;
  ui_.keys.choose(KeySet::blender);
  press_and_drag(kBare, MouseButton::middle);
  EXPECT_EQ(ui_.camera.target_mm(), target);
  EXPECT_NE(ui_.camera.lens({}).eye_mm, eye);
  mouse(InputEvent::Kind::release, MouseButton::middle);
  press_and_drag(kShift, MouseButton::middle);
  EXPECT_NE(ui_.camera.target_mm(), target);
}

TEST_F(MouseHabitTest, CtrlAndLeftMaskInZBrushsSetWhateverTheTool) {
  ui_.keys.choose(KeySet::zbrush);
  ui_.brush.action = Action::trim;
  ui_.outlines.trim = DragForm::lasso;
  press_and_drag(kCtrl);
  EXPECT_TRUE(gestures_.is_stroke_open());
  EXPECT_FALSE(ui_.outline);
  mouse(InputEvent::Kind::release);
  press_and_drag(kBare);
  EXPECT_TRUE(ui_.outline);
}

}  // namespace
}  // namespace argil::viewer
