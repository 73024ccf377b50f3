// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "argil/engine/tool.h"

namespace argil {
namespace {

std::string text_of(const char* file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The table makes all else (action/action_table.cpp); pages are written by hand.
TEST(ActionTable, EveryActionIsInTheDocumentsThatListThem) {
  const std::string actions = text_of("docs/actions.md");
  const std::string files = text_of("docs/files.md");
  ASSERT_FALSE(actions.empty() || files.empty());
  const std::size_t negative = files.find("also take negative ones");
  ASSERT_NE(negative, std::string::npos);
  const std::size_t line = files.rfind('\n', negative) + 1;
  const std::string takes_negative = files.substr(line, negative - line);
  for (const ActionInfo& info : kActionInfos) {
    const std::string name = info.name;
    EXPECT_TRUE(holds(actions, "**" + name + "**")) << name;
    EXPECT_TRUE(holds(files, "`\"" + name + "\"`")) << name;
    EXPECT_EQ(holds(takes_negative, "`" + name + "`"), info.is_signed) << name;
  }
}

TEST(ActionTable, TellsWhatAnActionTakes) {
  for (const ActionInfo& info : kActionInfos) {
    Tool tool;
    tool.action = info.action;
    EXPECT_TRUE(validate_tool(tool).ok()) << info.name;
    tool.shape = Shape::box;
    EXPECT_EQ(validate_tool(tool).ok(), info.kind == ActionKind::stamped) << info.name;
    tool.shape = Shape::ball;
    tool.strength = -1.0;
    EXPECT_EQ(validate_tool(tool).ok(), info.is_signed) << info.name;
  }
}

}  // namespace
}  // namespace argil
