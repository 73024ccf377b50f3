// SPDX-License-Identifier: GPL-3.0-or-later
#include "keys/key_file.h"

#include <filesystem>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "commands/command.h"
#include "settings/unread_file.h"
#include "support/scratch.h"

namespace argil::viewer {
namespace {

using testing::HasSubstr;

class KeyFile : public testing::Test {
 protected:
  std::string refusal(const std::string& text) {
    test::fill(folder_ / "keys.json", text);
    const auto keys = read_keys(folder_.path());
    return keys ? "accepted" : keys.error().message;
  }
  test::ScratchFolder folder_;
};

TEST_F(KeyFile, IsReadAsItWasWritten) {
  const auto home = folder_ / "not there yet";
  EXPECT_EQ(read_keys(home).value(), KeyMap());
  KeyMap keys(KeySet::blender);
  keys.give(Command::wires, chord_of("Ctrl+Shift+Alt+F12"));
  keys.give(Command::undo, std::nullopt);
  for (const ToolInfo& info : tool_infos()) {
    if (std::string_view(info.name) == "elastic") keys.give(&info, chord_of("Shift+\\"));
  }
  keys.give(Command::redo, chord_of("F3"));
  ASSERT_TRUE(write_keys(home, keys).ok());
  const auto again = read_keys(home);
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ(again.value(), keys);
  EXPECT_EQ(again.value().own_count(), 4U);
}

TEST_F(KeyFile, IsRefusedWithLineNameAndRemedy) {
  const std::string start = "{\"argil_keys\": 1,\n";
  for (const auto& [text, words] :
       {std::pair{start + "\"commands\": {\n\"view_fornt\": \"Num1\"}}",
                  ":3: no command is called \"view_fornt\"; did you mean \"view_front\"?"},
        {start + "\"tools\": {\"smoth\": \"S\"}}", "did you mean \"smooth\"?"},
        {start + "\"commands\": {\"undo\": \"Ctrl+Foo\"}}", ":2: \"Ctrl+Foo\" is no key; write"},
        {start + "\"commands\": {\"undo\": \"F5\",\n\"redo\": \"f5\"}}",
         ":3: \"f5\" is the key of \"undo\" already"},
        {start + "\"commands\": {\"undo\": 5}}", "a key is a text in quotes"},
        {start + "\"commands\": {\"undo\": \"Space\"}}", "Space always stops the force"},
        {start + "\"commands\": {\"emergency_stop\": \"F5\"}}", "always Space; leave this out"},
        {start + "\"set\": \"maya\"}", ":2: there is no such set; write \"argil\""},
        {start + "\"color\": \"red\"}", "\"color\" is unknown"},
        {start + "\"menu\": {\"undo\": \"F5\"}}", "\"menu\" is no section"},
        {std::string("{\"argil_keys\": 2}"), "a newer one wrote the file"},
        {std::string("{\"set\": \"blender\"}"), "it begins with \"argil_keys\": 1"},
        {start + "\"set\" \"blender\"}", ":2: not JSON"}}) {
    EXPECT_THAT(refusal(text), HasSubstr(words)) << text;
  }
}

TEST_F(KeyFile, ThatCannotBeReadIsKeptBesideTheNewOne) {
  test::fill(folder_ / "keys.json", "{\"argil_keys\": 1, \"set\": \"maya\"}");
  ASSERT_TRUE(write_keys(folder_.path(), KeyMap(KeySet::zbrush)).ok());
  EXPECT_EQ(read_keys(folder_.path()).value(), KeyMap(KeySet::zbrush));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "keys.json.unread"));
  ASSERT_TRUE(write_keys(folder_.path(), KeyMap()).ok());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "keys.json.unread-2"));
  test::fill(folder_ / "keys.json", "{");
  ASSERT_TRUE(write_keys(folder_.path(), KeyMap()).ok());
  EXPECT_TRUE(std::filesystem::exists(folder_ / "keys.json.unread-2"));
}

TEST_F(KeyFile, ThatCannotBeMovedAsideStands) {
  const std::filesystem::path file = folder_ / std::string(250, 'k');  // and no longer name may be
  test::fill(file, "{");
  const auto moved = set_aside(file);
  ASSERT_FALSE(moved.ok());
  EXPECT_THAT(moved.error().message, HasSubstr("nothing was written over it"));
  EXPECT_TRUE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace argil::viewer
