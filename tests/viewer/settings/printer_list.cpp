// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/printer_list.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/io/printer_file.h"

#include "support/scratch.h"

namespace argil::viewer {
namespace {

TEST(PrinterList, TellsThoseOfOneNameApart) {
  const test::ScratchFolder folder;
  ASSERT_TRUE(read_printers(folder.path()).problems.empty());
  std::ofstream(folder / "printers" / "left.json") << R"({"argil_printer": 1, "name": "mine"})";
  std::ofstream(folder / "printers" / "right.json") << R"({"argil_printer": 1, "name": "mine"})";
  std::ofstream(folder / "printers" / "hash.json") << R"({"argil_printer": 1, "name": "a###b"})";
  std::vector<std::string> names;
  for (const mesh::Printer& printer : read_printers(folder.path()).printers) {
    names.push_back(printer.name);
  }
  EXPECT_EQ(std::count(names.begin(), names.end(), "mine (left)"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "mine (right)"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "a# # #b"), 1);
}

TEST(PrinterList, HasTheProfilesOfTheRepositoryAndThoseOfAPerson) {
  const test::ScratchFolder folder;
  const PrinterList first = read_printers(folder.path());
  EXPECT_TRUE(first.problems.empty());
  for (const char* const name : {"filament", "resin", "service"}) {
    const auto wanted = io::read_printer(std::string("printers/") + name + ".json");
    ASSERT_TRUE(wanted.ok());
    const auto found = std::find_if(first.printers.begin(), first.printers.end(),
                                    [&](const mesh::Printer& one) { return one.name == name; });
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
  for (const mesh::Printer& printer : second.printers) {
    if (printer.name == "resin") {
      EXPECT_EQ(printer.min_wall_mm, 0.9);
    }
  }
}

}  // namespace
}  // namespace argil::viewer
