// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings.h"

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include "printer_list.h"
#include "support/scratch.h"

namespace argil::viewer {
namespace {

TEST(Settings, AreReadAsTheyWereWritten) {
  const test::ScratchFolder folder;
  const auto home = folder / "not there yet";
  EXPECT_EQ(read_settings(home), Settings());
  const Settings chosen{
      true, "my printer 2", "/a folder/nvent firmware.bin", {"Untitled-1 12", "Untitled-2 34"}};
  ASSERT_TRUE(write_changes(home, {}, chosen).ok());
  EXPECT_EQ(read_settings(home), chosen);
  ASSERT_TRUE(write_changes(home, chosen, {}).ok());
  EXPECT_EQ(read_settings(home), Settings());
}

TEST(Settings, AWindowWritesOnlyWhatWasChangedInIt) {
  const test::ScratchFolder folder;
  const Settings start{false, "resin", "/old.bin"};
  ASSERT_TRUE(write_changes(folder.path(), {}, start).ok());
  ASSERT_TRUE(write_changes(folder.path(), start, {true, "resin", "/old.bin"}).ok());
  ASSERT_TRUE(write_changes(folder.path(), start, {false, "", "/old.bin"}).ok());
  ASSERT_TRUE(write_changes(folder.path(), start, {false, "resin", "/new.bin"}).ok());
  EXPECT_EQ(read_settings(folder.path()), (Settings{true, "", "/new.bin"}));
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

TEST(PrinterList, TellsThoseOfOneNameApart) {
  const test::ScratchFolder folder;
  ASSERT_TRUE(read_printers(folder.path()).problems.empty());
  std::ofstream(folder / "printers" / "left.json") << R"({"argil_printer": 1, "name": "mine"})";
  std::ofstream(folder / "printers" / "right.json") << R"({"argil_printer": 1, "name": "mine"})";
  std::ofstream(folder / "printers" / "hash.json") << R"({"argil_printer": 1, "name": "a###b"})";
  std::vector<std::string> names;
  for (const io::Printer& printer : read_printers(folder.path()).printers) {
    names.push_back(printer.name);
  }
  EXPECT_EQ(std::count(names.begin(), names.end(), "mine (left)"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "mine (right)"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "a# # #b"), 1);
}

TEST(Settings, ANameWithoutAValueTakesNoneOfTheNextLine) {
  const test::ScratchFolder folder;
  test::fill(folder / "settings.txt", "printer\nfalcon_firmware \nnumber_views 1\n");
  EXPECT_EQ(read_settings(folder.path()), (Settings{true, "", ""}));
}

TEST(PrinterList, HasTheProfilesOfTheRepositoryAndThoseOfAPerson) {
  const test::ScratchFolder folder;
  const PrinterList first = read_printers(folder.path());
  EXPECT_TRUE(first.problems.empty());
  for (const char* const name : {"filament", "resin", "service"}) {
    const auto wanted = io::read_printer(std::string("printers/") + name + ".json");
    ASSERT_TRUE(wanted.ok());
    const auto found = std::find_if(first.printers.begin(), first.printers.end(),
                                    [&](const io::Printer& one) { return one.name == name; });
    ASSERT_NE(found, first.printers.end()) << name;
    EXPECT_EQ(found->bed_mm, wanted.value().bed_mm);
    EXPECT_EQ(found->min_wall_mm, wanted.value().min_wall_mm);
    EXPECT_EQ(found->needs_drains, wanted.value().needs_drains);
  }
  EXPECT_EQ(first.printers.size(), built_in_profiles().size());

  // What a person made of one stays; what is no profile is told, and takes nothing from the rest.
  std::ofstream(folder / "printers" / "resin.json")
      << R"({"argil_printer": 1, "name": "resin", "min_wall_mm": 0.9})";
  std::ofstream(folder / "printers" / "mine.json") << R"({"argil_printer": 1, "name": "mine"})";
  std::ofstream(folder / "printers" / "broken.json") << "{";
  const PrinterList second = read_printers(folder.path());
  EXPECT_EQ(second.printers.size(), first.printers.size() + 1);
  ASSERT_EQ(second.problems.size(), 1U);
  EXPECT_NE(second.problems[0].message.find("broken.json"), std::string::npos);
  for (const io::Printer& printer : second.printers) {
    if (printer.name == "resin") {
      EXPECT_EQ(printer.min_wall_mm, 0.9);
    }
  }
}

}  // namespace
}  // namespace argil::viewer
