// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/command_search.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "commands/command.h"
#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

SearchChoice search_for(const char* text) {
  SearchChoice choice;
  choice.text = text;
  return choice;
}

std::string best_found(const char* text) {
  const auto found = found_entries(search_for(text), KeyMap());
  return found.empty() ? "" : found.front().place + ": " + found.front().title;
}

TEST(CommandSearch, FindsByLettersInTheirOrder) {
  EXPECT_EQ(best_found("front"), "View: Front");
  EXPECT_EQ(best_found("FRNT"), "View: Front");
  EXPECT_EQ(best_found("dtb"), "Piece: Drop to bed");
  EXPECT_EQ(best_found("export"), "File: Export for printing...");
  EXPECT_EQ(best_found("thick"), "Measure: Thickness");
  EXPECT_EQ(best_found("smoo"), "Tool: Smooth");
  EXPECT_EQ(best_found("mask inv"), "Mask: Invert");
  EXPECT_EQ(best_found("invert mask"), "Mask: Invert");
  EXPECT_EQ(best_found("print"), "View: Print");
  EXPECT_EQ(best_found("qqq"), "");
}

TEST(CommandSearch, OffersEveryCommandAndEveryToolOnce) {
  const auto all = found_entries({}, KeyMap());
  EXPECT_EQ(all.size(), command_infos().size() - 1 + tool_infos().size()) << "all but the search";
  for (const CommandInfo& info : command_infos()) {
    const auto count = std::count_if(all.begin(), all.end(), [&](const SearchEntry& entry) {
      return entry.aim == KeyAim(info.command);
    });
    EXPECT_EQ(count, info.command == Command::search ? 0 : 1) << info.title;
  }
}

TEST(CommandSearch, AMatchOfWholeWordsBeatsScatteredLetters) {
  EXPECT_GT(match_of("cle", "Clear all"), match_of("cle", "Carve a hole"));
  EXPECT_GT(match_of("ra", "Rake"), match_of("ra", "Trim at"));
  EXPECT_EQ(match_of("az", "Amaze"), match_of("AZ", "aMaZe"));
  EXPECT_LT(match_of("abc", "acb"), 0);
  EXPECT_EQ(match_of("", "anything"), 0);
}

class SearchKeys : public GesturesTest {
 protected:
  void type(const std::string& text) {
    for (const char c : text) {
      InputEvent event;
      event.kind = InputEvent::Kind::text;
      event.character = static_cast<unsigned char>(c);
      gestures_.on(event, false);
    }
  }
  void open() { key('K', false, {false, true, false}); }
};

TEST_F(SearchKeys, EnterDoesWhatIsMarkedAndItComesFirstTheNextTime) {
  open();
  ASSERT_TRUE(ui_.search.is_open);
  type("wirefr");
  key(kKeyEnter);
  EXPECT_FALSE(ui_.search.is_open);
  EXPECT_TRUE(ui_.show.has_wires);
  open();
  EXPECT_EQ(ui_.search.text, "");
  ASSERT_FALSE(found_entries(ui_.search, ui_.keys).empty());
  EXPECT_EQ(found_entries(ui_.search, ui_.keys)[0].title, "Wireframe");
  // The mark goes round.
  key(kKeyUp);
  EXPECT_EQ(ui_.search.at, found_entries(ui_.search, ui_.keys).size() - 1);
  key(kKeyDown);
  key(kKeyDown);
  EXPECT_EQ(ui_.search.at, 1U);
  key(kKeyUp);
  key(kKeyEnter);
  EXPECT_FALSE(ui_.show.has_wires);
}

TEST_F(SearchKeys, LettersAreTypedAndChooseNoToolBehindIt) {
  const Action before = ui_.brush.action;
  open();
  key('S');
  type("s");
  key('X');
  type("x");
  EXPECT_EQ(ui_.brush.action, before);
  EXPECT_FALSE(ui_.brush.mirror.x);
  EXPECT_EQ(ui_.search.text, "sx");
  key(kKeyBackspace);
  EXPECT_EQ(ui_.search.text, "s");
  key(kKeyEscape);
  EXPECT_FALSE(ui_.search.is_open);
  key('X');
  EXPECT_TRUE(ui_.brush.mirror.x);
}

TEST_F(SearchKeys, AToolThatIsFoundWorksFromNowOn) {
  ui_.measures.tool = MeasureKind::angle;
  open();
  type("pinch");
  key(kKeyEnter);
  EXPECT_EQ(ui_.brush.action, Action::pinch);
  EXPECT_FALSE(ui_.measures.tool);
}

TEST_F(SearchKeys, WhatCannotBeDoneNowIsShownAndDoesNothing) {
  open();
  type("redo");
  const auto found = found_entries(ui_.search, ui_.keys);
  ASSERT_EQ(found.front().title, "Redo");
  EXPECT_FALSE(is_possible(found.front(), ui_));
  key(kKeyEnter);
  EXPECT_TRUE(ui_.search.is_open);
  EXPECT_TRUE(ui_.search.recent.empty());
}

TEST_F(SearchKeys, ItIsNotModalAndTheRedStopIsHeard) {
  ui_.haptics.device = DeviceChoice::sim;
  open();
  key(kKeySpace);
  EXPECT_TRUE(ui_.wants_emergency_stop);
  const double distance = ui_.camera.distance_mm();
  InputEvent scroll;
  scroll.kind = InputEvent::Kind::scroll;
  scroll.steps = 1.0;
  gestures_.on(scroll, false);
  EXPECT_NE(ui_.camera.distance_mm(), distance);
  EXPECT_TRUE(ui_.search.is_open);
}

TEST_F(SearchKeys, ALetterThatOpensItIsNotTypedIntoItAndCanBeTypedThen) {
  ui_.keys.choose(KeySet::zbrush);
  key('B');
  ASSERT_TRUE(ui_.search.is_open);
  type("b");  // as the window system tells it after the key
  EXPECT_EQ(ui_.search.text, "");
  key('B');
  type("b");
  EXPECT_TRUE(ui_.search.is_open);
  EXPECT_EQ(ui_.search.text, "b");
  EXPECT_EQ(found_entries(search_for("smooth"), ui_.keys).front().chord, "Shift+S");
  key(kKeyEscape);
  perform(Command::search, ui_, document_);  // by the menu
  type("w");
  EXPECT_EQ(ui_.search.text, "w");
}

}  // namespace
}  // namespace argil::viewer
