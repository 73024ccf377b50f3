// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/preset_choice.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "commands/command.h"
#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

class PresetChoiceTest : public GesturesTest {
 protected:
  PresetChoiceTest() {
    ui_.presets = built_in_presets();
    ui_.panels.has_presets = true;
  }
  static constexpr Modifiers kCtrl{false, true, false};
};

TEST_F(PresetChoiceTest, ABrushIsSavedUnderItsNameAndChosenByItsKey) {
  ui_.brush.action = Action::pinch;
  ui_.brush.strength = 0.31;
  ui_.preset_choice.name = "Mine";
  save_preset(ui_);
  ASSERT_NE(preset_named("Mine", ui_), nullptr);
  EXPECT_EQ(ui_.preset_choice.chosen, "Mine");
  EXPECT_EQ(ui_.preset_choice.to_write.front(), "Mine");
  ui_.preset_choice.waits_for_key = true;
  key('1', false, kCtrl);
  EXPECT_FALSE(ui_.preset_choice.waits_for_key);
  EXPECT_EQ(preset_key_text(*preset_named("Mine", ui_), ui_), "Ctrl+1");
  ui_.brush = Brush();
  ui_.measures.tool = MeasureKind::angle;
  key('1', false, kCtrl);
  EXPECT_EQ(ui_.brush.action, Action::pinch);
  EXPECT_EQ(ui_.brush.strength, 0.31);
  EXPECT_FALSE(ui_.measures.tool);
}

TEST_F(PresetChoiceTest, ItsDigitComesBeforeTheNumpadsThatItStandsFor) {
  ui_.settings.has_number_views = true;
  ui_.presets[0].key = chord_of("Ctrl+1");
  key('1', false, kCtrl);  // else the view from behind
  EXPECT_EQ(ui_.preset_choice.chosen, ui_.presets[0].name);
}

TEST_F(PresetChoiceTest, APressOnThePictureEndsTheWaitingForAKey) {
  ui_.preset_choice.waits_for_key = true;
  ui_.key_choice.waiting = Command::wires;
  mouse(InputEvent::Kind::press);
  EXPECT_FALSE(ui_.preset_choice.waits_for_key);
  EXPECT_FALSE(ui_.key_choice.waiting);
}

TEST_F(PresetChoiceTest, ASavedBrushTakesThePlaceOfItsNameAndKeepsItsKey) {
  ui_.presets[0].key = chord_of("Ctrl+1");
  const std::string name = ui_.presets[0].name;
  const std::size_t count = ui_.presets.size();
  ui_.preset_choice.name = name;
  ui_.brush.strength = 0.42;
  save_preset(ui_);
  EXPECT_EQ(ui_.presets.size(), count);
  EXPECT_EQ(preset_named(name, ui_)->brush.strength, 0.42);
  EXPECT_EQ(preset_named(name, ui_)->key, chord_of("Ctrl+1"));
  EXPECT_FALSE(preset_named(name, ui_)->is_built_in);
  // Without its own file the built-in one is there again.
  remove_preset(name, ui_);
  EXPECT_TRUE(preset_named(name, ui_)->is_built_in);
  EXPECT_EQ(ui_.preset_choice.to_remove.front(), name);
  EXPECT_TRUE(ui_.preset_choice.to_write.empty());
  remove_preset(name, ui_);
  EXPECT_NE(preset_named(name, ui_), nullptr) << "a built-in one stays";
}

TEST_F(PresetChoiceTest, AKeyThatDoesSomethingElseIsRefusedWithItsName) {
  ui_.preset_choice.chosen = ui_.presets[1].name;
  ui_.preset_choice.waits_for_key = true;
  key('Z', false, kCtrl);
  EXPECT_NE(ui_.preset_choice.refused.find("\"Undo\""), std::string::npos);
  EXPECT_FALSE(ui_.presets[1].key);
  key('2', false, kCtrl);
  EXPECT_EQ(ui_.presets[1].key, chord_of("Ctrl+2"));
  // Another one takes it over; Backspace is to be without.
  ui_.preset_choice.chosen = ui_.presets[2].name;
  ui_.preset_choice.waits_for_key = true;
  key('2', false, kCtrl);
  EXPECT_FALSE(ui_.presets[1].key);
  EXPECT_EQ(ui_.presets[2].key, chord_of("Ctrl+2"));
  ui_.preset_choice.waits_for_key = true;
  key(kKeyBackspace);
  EXPECT_FALSE(ui_.presets[2].key);
}

TEST_F(PresetChoiceTest, AKeyThatWasGivenToACommandIsNoLongerThePresets) {
  ui_.presets[1].key = chord_of("Ctrl+2");
  EXPECT_EQ(preset_key_text(ui_.presets[1], ui_), "Ctrl+2");
  ui_.keys.give(Command::wires, chord_of("Ctrl+2"));
  EXPECT_EQ(preset_key_text(ui_.presets[1], ui_), "");
  key('2', false, kCtrl);
  EXPECT_TRUE(ui_.show.has_wires);
}

TEST_F(PresetChoiceTest, ANameThatCannotBeIsRefusedInWords) {
  const std::size_t count = ui_.presets.size();
  ui_.preset_choice.name = "a/b";
  save_preset(ui_);
  EXPECT_EQ(ui_.presets.size(), count);
  EXPECT_NE(ui_.preset_choice.refused, "");
  EXPECT_TRUE(ui_.preset_choice.to_write.empty());
}

}  // namespace
}  // namespace argil::viewer
