// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/key_choice.h"

#include <gtest/gtest.h>

#include "commands/command.h"
#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

class KeyChoiceTest : public GesturesTest {
 protected:
  KeyChoiceTest() { ui_.panels.has_keys = true; }
  static constexpr int kLeftCtrl = 341;
};

TEST_F(KeyChoiceTest, TheNextKeyIsGivenAndDoesNothingElse) {
  wait_for_key(Command::wires, ui_);
  key(kLeftCtrl, false, {false, true, false});
  EXPECT_TRUE(ui_.key_choice.waiting) << "a modifier alone is not the key";
  key('9', false, {false, true, false});
  EXPECT_FALSE(ui_.key_choice.waiting);
  EXPECT_EQ(ui_.keys.text_of(Command::wires), "Ctrl+9");
  EXPECT_FALSE(ui_.show.has_wires);
  key('9', false, {false, true, false});
  EXPECT_TRUE(ui_.show.has_wires);
}

TEST_F(KeyChoiceTest, AKeyOfSomethingElseIsAskedAbout) {
  wait_for_key(Command::wires, ui_);
  key('X');
  ASSERT_TRUE(ui_.key_choice.wanted);
  EXPECT_FALSE(ui_.brush.mirror.x);
  EXPECT_EQ(ui_.keys, KeyMap()) << "nothing is changed before the answer";
  answer_key_question(false, ui_);
  EXPECT_EQ(ui_.keys, KeyMap());
  wait_for_key(Command::wires, ui_);
  key('X');
  answer_key_question(true, ui_);
  EXPECT_EQ(ui_.keys.text_of(Command::wires), "X");
  EXPECT_EQ(ui_.keys.text_of(Command::symmetry_x), "");
}

TEST_F(KeyChoiceTest, EscLeavesItAndOtherReservedKeysAreRefusedInWords) {
  ui_.haptics.device = DeviceChoice::sim;
  wait_for_key(Command::wires, ui_);
  key(kKeySpace);
  EXPECT_NE(ui_.key_choice.refused, "");
  EXPECT_TRUE(ui_.wants_emergency_stop) << "the stop is heard at any time";
  key('V');
  EXPECT_FALSE(ui_.is_clutched);
  EXPECT_NE(ui_.key_choice.refused, "");
  key(kKeyEscape);
  EXPECT_FALSE(ui_.key_choice.waiting);
  EXPECT_EQ(ui_.keys, KeyMap());
  wait_for_key(Command::emergency_stop, ui_);
  EXPECT_FALSE(ui_.key_choice.waiting);
}

TEST_F(KeyChoiceTest, AClosedPanelTakesNoKeys) {
  wait_for_key(Command::wires, ui_);
  ui_.panels.has_keys = false;
  key('X');
  EXPECT_TRUE(ui_.brush.mirror.x);
}

TEST_F(KeyChoiceTest, TheListIsNarrowedByTitleMenuAndKey) {
  EXPECT_TRUE(is_meant_by("", Command::undo, ui_.keys));
  EXPECT_TRUE(is_meant_by("UND", Command::undo, ui_.keys));
  EXPECT_TRUE(is_meant_by("edit", Command::undo, ui_.keys));
  EXPECT_TRUE(is_meant_by("ctrl+z", Command::undo, ui_.keys));
  EXPECT_FALSE(is_meant_by("ctrl+y", Command::undo, ui_.keys));
}

}  // namespace
}  // namespace argil::viewer
