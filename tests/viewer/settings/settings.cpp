// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/settings.h"

#include <fstream>

#include <gtest/gtest.h>

#include "support/scratch.h"

namespace argil::viewer {
namespace {

TEST(Settings, AreReadAsTheyWereWritten) {
  const test::ScratchFolder folder;
  const auto home = folder / "not there yet";
  EXPECT_EQ(read_settings(home), Settings());
  const Settings chosen{true,
                        "my printer 2",
                        "/a folder/nvent firmware.bin",
                        {"Untitled-1 12", "Untitled-2 34"},
                        150,
                        kFirmPressure,
                        Theme::light};
  ASSERT_TRUE(write_changes(home, {}, chosen).ok());
  EXPECT_EQ(read_settings(home), chosen);
  ASSERT_TRUE(write_changes(home, chosen, {}).ok());
  EXPECT_EQ(read_settings(home), Settings());
}

TEST(Settings, AWindowWritesOnlyWhatWasChangedInIt) {
  const test::ScratchFolder folder;
  const Settings start{false, "resin", "/old.bin", {}, 100, {}};
  ASSERT_TRUE(write_changes(folder.path(), {}, start).ok());
  ASSERT_TRUE(write_changes(folder.path(), start, {true, "resin", "/old.bin", {}, 100, {}}).ok());
  ASSERT_TRUE(write_changes(folder.path(), start, {false, "", "/old.bin", {}, 100, {}}).ok());
  ASSERT_TRUE(write_changes(folder.path(), start, {false, "resin", "/new.bin", {}, 100, {}}).ok());
  EXPECT_EQ(read_settings(folder.path()), (Settings{true, "", "/new.bin", {}, 100, {}}));
}

TEST(RecentFiles, AreThoseOfAllWindowsNewestFirst) {
  const test::ScratchFolder folder;
  std::vector<std::filesystem::path> one = read_recent(folder.path());
  std::vector<std::filesystem::path> other = one;
  EXPECT_TRUE(one.empty());
  ASSERT_TRUE(add_recent(folder.path(), "/a.vdb", one).ok());
  ASSERT_TRUE(add_recent(folder.path(), "/b.vdb", other).ok());
  ASSERT_TRUE(add_recent(folder.path(), "/a.vdb", one).ok());
  EXPECT_EQ(one, (std::vector<std::filesystem::path>{"/a.vdb", "/b.vdb"}));
  EXPECT_EQ(read_recent(folder.path()), one);
  for (int n = 0; n < 12; ++n) {
    ASSERT_TRUE(add_recent(folder.path(), folder / std::to_string(n), one).ok());
  }
  EXPECT_EQ(one.size(), 10U);
  EXPECT_EQ(read_recent(folder.path()), one);
}

TEST(Settings, ANameWithoutAValueTakesNoneOfTheNextLine) {
  const test::ScratchFolder folder;
  test::fill(folder / "settings.txt", "printer\nfalcon_firmware \nnumber_views 1\n");
  EXPECT_EQ(read_settings(folder.path()), (Settings{true, "", "", {}, 100, {}}));
}

TEST(Settings, ASizeOfPanelsThatNobodyCanChooseIsBroughtIntoRange) {
  const test::ScratchFolder folder;
  for (const auto& [text, percent] :
       {std::pair{"175", 175}, {"10", 75}, {"9000", 300}, {"many", 100}}) {
    test::fill(folder / "settings.txt", std::string("panel_percent ") + text + "\n");
    EXPECT_EQ(read_settings(folder.path()).panel_percent, percent) << text;
  }
}

}  // namespace
}  // namespace argil::viewer
