// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/favourites.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "commands/brush_preset.h"
#include "commands/command.h"
#include "commands/favourite_choice.h"
#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

using testing::HasSubstr;

const ToolInfo* tool_of_name(std::string_view name) {
  for (const ToolInfo& info : tool_infos()) {
    if (info.name == name) return &info;
  }
  return nullptr;
}

class FavouriteFile : public testing::Test {
 protected:
  std::string refusal(const std::string& text) {
    test::fill(folder_ / "favourites.json", text);
    const auto read = read_favourites(folder_.path());
    return read ? "accepted" : read.error().message;
  }
  test::ScratchFolder folder_;
};

TEST_F(FavouriteFile, HasTheUsualOnesWhereThereIsNone) {
  const auto read = read_favourites(folder_ / "not there yet");
  ASSERT_TRUE(read);
  EXPECT_EQ(read.value(), usual_favourites());
  // None is there twice, and each can be one; the brush comes with the program.
  for (std::size_t n = 0; n < kFavouritePlaces; ++n) {
    ASSERT_TRUE(read.value()[n]);
    EXPECT_STREQ(why_no_favourite(*read.value()[n]), "");
    for (std::size_t m = 0; m < n; ++m) EXPECT_NE(read.value()[m], read.value()[n]);
    const auto* brush = std::get_if<std::string>(&*read.value()[n]);
    if (brush == nullptr) continue;
    bool is_there = false;
    for (const BrushPreset& preset : built_in_presets()) {
      is_there = is_there || preset.name == *brush;
    }
    EXPECT_TRUE(is_there) << *brush;
  }
}

TEST_F(FavouriteFile, IsReadAsItWasWrittenWithItsEmptyPlaces) {
  const auto home = folder_ / "not there yet";
  Favourites favourites{};
  favourites[1] = Favourite(tool_of_name("stamp"));
  favourites[4] = Favourite(Command::emergency_stop);
  favourites[6] = Favourite(std::string("Of \"mine\", with Ünïcode and  blanks"));
  ASSERT_TRUE(write_favourites(home, favourites));
  auto again = read_favourites(home);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again.value(), favourites);
  // Who has taken all of them out has none, and not the usual ones.
  ASSERT_TRUE(write_favourites(home, {}));
  EXPECT_EQ(read_favourites(home).value(), Favourites{});
}

TEST_F(FavouriteFile, IsRefusedWithLineNameAndRemedy) {
  const std::string start = "{\"argil_favourites\": 1,\n";
  for (const auto& [text, words] :
       {std::pair{start + "\"north\": \"tool smooth\"}",
                  ":2: \"north\" is no place of the ring; these are \"up\", \"up_right\""},
        {start + "\"up\": \"tool smoth\"}", ":2: no tool is called \"smoth\""},
        {start + "\"up\": \"tool undo\"}", "no tool is called \"undo\""},
        {start + "\"up\": \"command smooth\"}", "no command is called \"smooth\""},
        {start + "\"up\": \"preset smooth\"}", "\"preset\" is nothing that a place can hold"},
        {start + "\"up\": \"smooth\"}", "must be a text as \"tool smooth\""},
        {start + "\"up\": \"brush \"}", "must be a text as"},
        {start + "\"up\": 3}", "must be a text as"},
        {start + "\"up\": \"command favourites\"}", "the ring cannot open itself"},
        {start + "\"places\": {\"up\": \"tool smooth\"}}", "favourites have no sections"},
        {start + "\"up\": \"tool smooth\",\n\"up\": \"tool add\"}",
         ":3: \"up\" stands there twice"},
        {std::string("{\"argil_favourites\": 2}"), "a newer one wrote the file"},
        {std::string("{\"up\": \"tool smooth\"}"), "begins with \"argil_favourites\": 1"},
        {std::string("[]"), "a list is no value"},
        {std::string(), "not JSON"},
        {start + "\"up\" \"tool smooth\"}", ":2: not JSON"}}) {
    EXPECT_THAT(refusal(text), HasSubstr(words)) << text;
  }
  EXPECT_EQ(refusal(start + "\"up\": \"brush that is nowhere\"}"), "accepted");
}

TEST_F(FavouriteFile, ThatCannotBeReadIsKeptBesideTheNewOne) {
  const std::string odd = "{\"argil_favourites\": 1, \"north\": \"tool smooth\"}";
  test::fill(folder_ / "favourites.json", odd);
  ASSERT_TRUE(write_favourites(folder_.path(), usual_favourites()));
  EXPECT_EQ(read_favourites(folder_.path()).value(), usual_favourites());
  EXPECT_EQ(test::content_of(folder_ / "favourites.json.unread"), odd);
  ASSERT_TRUE(write_favourites(folder_.path(), {}));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "favourites.json.unread-2"));
}

class FavouriteChoiceTest : public GesturesTest {
 protected:
  FavouriteChoiceTest() {
    ui_.favourites = {};
    ui_.presets = built_in_presets();
  }
};

TEST_F(FavouriteChoiceTest, TakesTheFirstFreePlaceAndLeavesIt) {
  ui_.favourites[0] = Favourite(Command::undo);
  const Favourite smooth = tool_of_name("smooth");
  toggle_favourite(smooth, ui_);
  EXPECT_EQ(place_of(smooth, ui_), 1U);
  EXPECT_THAT(ui_.notices.back().text, HasSubstr("up right"));
  ui_.favourites[0].reset();
  toggle_favourite(std::string("Polish"), ui_);
  EXPECT_EQ(place_of(std::string("Polish"), ui_), 0U);
  EXPECT_EQ(place_of(smooth, ui_), 1U) << "a hand remembers the direction";
  toggle_favourite(smooth, ui_);
  EXPECT_FALSE(place_of(smooth, ui_));
}

TEST_F(FavouriteChoiceTest, SaysThatTheRingIsFullOrCannotOpenItself) {
  toggle_favourite(Command::favourites, ui_);
  EXPECT_EQ(ui_.favourites, Favourites{});
  EXPECT_EQ(ui_.notices.back().kind, Notice::Kind::warning);
  ui_.favourites = usual_favourites();
  ui_.notices.clear();
  toggle_favourite(Command::undo, ui_);
  EXPECT_EQ(ui_.favourites, usual_favourites());
  ASSERT_EQ(ui_.notices.size(), 1U);
  EXPECT_THAT(ui_.notices.back().text, HasSubstr("is full; remove one"));
  EXPECT_TRUE(ui_.panels.has_favourites) << "where that is done";
}

TEST_F(FavouriteChoiceTest, DoesWhatThePlaceHolds) {
  ui_.favourites[0] = Favourite(tool_of_name("pinch"));
  ui_.favourites[1] = Favourite(std::string("Rivets"));
  ui_.favourites[2] = Favourite(Command::wires);
  ui_.favourites[3] = Favourite(Command::measure_angle);
  do_favourite(0, ui_, document_);
  EXPECT_EQ(ui_.brush.action, Action::pinch);
  do_favourite(1, ui_, document_);
  EXPECT_EQ(ui_.brush.action, Action::add);
  EXPECT_EQ(ui_.brush.spacing, 2.0);
  do_favourite(2, ui_, document_);
  EXPECT_TRUE(ui_.show.has_wires);
  do_favourite(3, ui_, document_);
  do_favourite(3, ui_, document_);
  EXPECT_EQ(ui_.measures.tool, MeasureKind::angle) << "named again it is wanted all the same";
  do_favourite(7, ui_, document_);  // nothing there
  EXPECT_TRUE(ui_.notices.empty());
}

TEST_F(FavouriteChoiceTest, ABrushThatIsGoneIsSaidAndWorksAgainWhereItIsBack) {
  ui_.favourites[0] = Favourite(std::string("Mine"));
  const Action before = ui_.brush.action;
  EXPECT_FALSE(can_do(ui_.favourites[0], ui_));
  do_favourite(0, ui_, document_);
  EXPECT_EQ(ui_.brush.action, before);
  ASSERT_EQ(ui_.notices.size(), 1U);
  EXPECT_EQ(ui_.notices[0].kind, Notice::Kind::warning);
  EXPECT_THAT(ui_.notices[0].text, HasSubstr("the brush 'Mine' is gone"));
  EXPECT_TRUE(ui_.favourites[0]) << "it may be back";
  BrushPreset mine;
  mine.name = "Mine";
  mine.brush.action = Action::crease;
  ui_.presets.push_back(mine);
  do_favourite(0, ui_, document_);
  EXPECT_EQ(ui_.brush.action, Action::crease);
}

TEST_F(FavouriteChoiceTest, TheSearchMakesWhatIsMarkedAFavouriteByCtrlEnter) {
  perform(Command::search, ui_, document_);
  for (const char letter : std::string("wirefr")) {
    InputEvent typed;
    typed.kind = InputEvent::Kind::text;
    typed.character = static_cast<unsigned char>(letter);
    gestures_.on(typed, false);
  }
  key(kKeyEnter, false, {false, true, false});
  EXPECT_EQ(place_of(Command::wires, ui_), 0U);
  EXPECT_TRUE(ui_.search.is_open);
  EXPECT_FALSE(ui_.show.has_wires);
  key(kKeyEnter, true, {false, true, false});  // held, it does not flicker
  EXPECT_EQ(place_of(Command::wires, ui_), 0U);
  key(kKeyEnter, false, {false, true, false});
  EXPECT_FALSE(place_of(Command::wires, ui_));
}

}  // namespace
}  // namespace argil::viewer
