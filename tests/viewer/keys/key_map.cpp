// SPDX-License-Identifier: GPL-3.0-or-later
#include "keys/key_map.h"

#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "commands/command.h"
#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

constexpr KeySet kAllSets[] = {KeySet::argil, KeySet::blender, KeySet::zbrush};

const ToolInfo* tool_called(std::string_view name) {
  for (const ToolInfo& info : tool_infos()) {
    if (info.name == name) return &info;
  }
  return nullptr;
}

std::string shown_key(KeySet set, const KeyAim& aim) { return KeyMap(set).text_of(aim); }

TEST(KeySets, GiveNoKeyTwiceAndNameEachAsItIsShown) {
  for (const KeySet set : kAllSets) {
    std::map<std::string, std::string> owners;
    for (const CommandInfo& info : command_infos()) {
      const std::string shown = info.chords[static_cast<std::size_t>(set)];
      if (shown.empty()) continue;  // the menu and the search have it
      const auto chord = chord_of(shown);
      ASSERT_TRUE(chord) << info.title << " " << shown;
      EXPECT_EQ(text_of(*chord), shown);
      EXPECT_TRUE(is_fixed(info.command) || *why_reserved(*chord) == '\0') << shown;
      EXPECT_TRUE(owners.emplace(shown, info.title).second) << shown << ": " << owners[shown];
      EXPECT_EQ(KeyMap(set).aim_of(*chord), KeyAim(info.command)) << info.title;
    }
    for (const ToolInfo& info : tool_infos()) {
      const auto chord = built_in_chord(set, &info);
      if (!chord) continue;
      const std::string shown = text_of(*chord);
      EXPECT_STREQ(why_reserved(*chord), "") << shown;
      EXPECT_TRUE(owners.emplace(shown, info.title).second) << shown << ": " << owners[shown];
      EXPECT_EQ(KeyMap(set).aim_of(*chord), KeyAim(&info)) << info.title;
    }
  }
}

TEST(KeySets, HaveARowForEveryTool) {
  // Asserts where a tool has none. What Argil's own set gives a letter has a key in all of them.
  for (const ToolInfo& info : tool_infos()) {
    for (const KeySet set : kAllSets) {
      EXPECT_EQ(built_in_chord(set, &info).has_value(), info.key != kNoKey) << info.title;
    }
  }
}

TEST(KeySets, OfBlenderHasWhatItsSculptModeHas) {
  const auto key = [](const KeyAim& aim) { return shown_key(KeySet::blender, aim); };
  EXPECT_EQ(key(tool_called("inflate")), "X");  // its Draw
  EXPECT_EQ(key(tool_called("clay")), "C");
  EXPECT_EQ(key(tool_called("crease")), "Shift+C");
  EXPECT_EQ(key(tool_called("grab")), "G");
  EXPECT_EQ(key(tool_called("layer")), "L");
  EXPECT_EQ(key(tool_called("flatten")), "Shift+T");
  EXPECT_EQ(key(tool_called("snake_hook")), "K");
  EXPECT_EQ(key(tool_called("smooth")), "Shift+S");
  EXPECT_EQ(key(tool_called("pinch")), "P");
  EXPECT_EQ(key(tool_called("mask")), "M");
  EXPECT_EQ(key(Command::brush_size), "F");
  EXPECT_EQ(key(Command::brush_strength), "Shift+F");
  EXPECT_EQ(key(Command::mask_invert), "Ctrl+I");
  EXPECT_EQ(key(Command::mask_clear), "Alt+M");
  EXPECT_EQ(key(Command::search), "F3");
  EXPECT_EQ(key(Command::view_top), "Num7");
  EXPECT_EQ(key(Command::history), "Ctrl+Alt+Z");
}

TEST(KeySets, OfZBrushHasItsKeysForSizeIntensityFrameAndMasks) {
  const auto key = [](const KeyAim& aim) { return shown_key(KeySet::zbrush, aim); };
  EXPECT_EQ(key(Command::brush_size), "S");
  EXPECT_EQ(key(Command::brush_strength), "U");
  EXPECT_EQ(key(Command::symmetry_x), "X");
  EXPECT_EQ(key(Command::view_frame), "F");
  EXPECT_EQ(key(Command::wires), "Shift+F");
  EXPECT_EQ(key(Command::view_parallel), "P");
  EXPECT_EQ(key(Command::mask_invert), "Ctrl+I");
  EXPECT_EQ(key(Command::mask_fill), "Ctrl+A");
  EXPECT_EQ(key(Command::mask_clear), "Ctrl+Shift+A");
  EXPECT_EQ(key(Command::piece_gizmo), "W");
}

/// A line of docs/keys.md: title, the key in each set, and the name in files.
std::string documented(const KeyAim& aim) {
  std::string line = std::string("| ") + title_of(aim) + " |";
  for (const KeySet set : kAllSets) {
    const std::string key = shown_key(set, aim);
    const std::string fence = key.find('`') == std::string::npos ? "`" : "`` ";
    const std::string other(fence.rbegin(), fence.rend());
    if (key.empty()) line.append(" –");
    if (!key.empty()) line.append(" ").append(fence).append(key).append(other);
    line.append(" |");
  }
  return line.append(" ").append(name_of(aim)).append(" |\n");
}

TEST(KeySets, AreListedInTheDocumentation) {
  std::ifstream in("docs/keys.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  for (const KeyAim& aim : all_key_aims()) {
    EXPECT_NE(page.find("\n" + documented(aim)), std::string::npos) << documented(aim);
  }
}

TEST(KeyMap, AKeyThatIsGivenDoesNothingElse) {
  KeyMap keys;
  const auto z = chord_of("Ctrl+Z");
  keys.give(Command::wires, z);
  EXPECT_EQ(keys.aim_of(*z), KeyAim(Command::wires));
  EXPECT_EQ(keys.text_of(Command::undo), "");
  EXPECT_FALSE(keys.aim_of(*chord_of("W")));
  // On to another one, and away: what it was of at first has it again.
  keys.give(tool_called("smooth"), z);
  EXPECT_EQ(keys.text_of(Command::wires), "");
  EXPECT_TRUE(keys.is_own(Command::wires));
  keys.give(tool_called("smooth"), std::nullopt);
  EXPECT_EQ(keys.aim_of(*z), KeyAim(Command::undo));
  keys.reset(Command::wires);
  EXPECT_EQ(keys.text_of(Command::wires), "W");
  EXPECT_EQ(keys.own_count(), 1U);
  keys.reset();
  EXPECT_EQ(keys, KeyMap());
}

TEST(KeyMap, WhatIsAsTheSetHasItIsNoChoice) {
  KeyMap keys;
  keys.give(Command::undo, chord_of("F5"));
  keys.give(Command::undo, chord_of("Ctrl+Z"));
  EXPECT_EQ(keys, KeyMap());
}

TEST(KeyMap, OwnKeysStayWithAnotherSetAndComeBeforeItsKeys) {
  KeyMap keys;
  keys.give(Command::wires, chord_of("F3"));  // the search of the other set
  keys.choose(KeySet::blender);
  EXPECT_EQ(keys.text_of(Command::wires), "F3");
  EXPECT_EQ(keys.text_of(Command::search), "");
  EXPECT_EQ(keys.text_of(Command::panels), "T");
  keys.reset();
  EXPECT_EQ(keys.text_of(Command::search), "F3");
  EXPECT_EQ(keys.text_of(Command::wires), "Shift+Z");
}

TEST(KeyMap, TheEmergencyStopKeepsSpaceWhateverIsChosen) {
  for (const KeySet set : kAllSets) {
    KeyMap keys(set);
    keys.give(Command::emergency_stop, chord_of("F5"));
    EXPECT_EQ(keys.text_of(Command::emergency_stop), "Space");
    keys.give(Command::emergency_stop, std::nullopt);
    EXPECT_EQ(keys.text_of(Command::emergency_stop), "Space");
  }
  for (const char* name : {"Space", "Ctrl+Space", "Esc", "Shift+Esc", "V"}) {
    EXPECT_STRNE(why_reserved(*chord_of(name)), "") << name;
  }
  EXPECT_STREQ(why_reserved(*chord_of("Shift+V")), "");
}

TEST_F(GesturesTest, KeysDoWhatTheChosenSetSays) {
  key('X');
  EXPECT_TRUE(ui_.brush.mirror.x);
  ui_.keys.choose(KeySet::blender);
  ui_.brush.action = Action::smooth;
  key('X');
  EXPECT_TRUE(ui_.brush.mirror.x);
  EXPECT_EQ(ui_.brush.action, Action::inflate);
  key('C', false, {true, false, false});
  EXPECT_EQ(ui_.brush.action, Action::crease);
}

TEST_F(GesturesTest, ADigitThatWasGivenToSomethingIsNoKeyOfTheNumpad) {
  ui_.settings.has_number_views = true;
  ui_.keys.give(Command::wires, chord_of("1"));
  key('1');
  EXPECT_TRUE(ui_.show.has_wires);
  const bool was_parallel = ui_.camera.is_parallel();
  key('5');
  EXPECT_NE(ui_.camera.is_parallel(), was_parallel);
}

}  // namespace
}  // namespace argil::viewer
