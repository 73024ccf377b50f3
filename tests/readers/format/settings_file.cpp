// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/settings_file.h"

#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/scratch.h"

namespace argil::io {
namespace {

using testing::HasSubstr;

class SettingsFile : public testing::Test {
 protected:
  Result<std::vector<SettingsEntry>> read(const std::string& text) {
    test::fill(folder_ / "s.json", text);
    return read_settings_file(folder_ / "s.json");
  }
  std::string refusal(const std::string& text) {
    const auto entries = read(text);
    return entries ? "accepted" : entries.error().message;
  }
  test::ScratchFolder folder_;
};

TEST_F(SettingsFile, KnowsTheLineOfEachEntry) {
  const auto entries = read(
      "{\n  \"a\": 1.5,\n  \"keys\": {\n\n    \"b\": \"Ctrl+Z\", \"c\": true\n"
      "  },\n\"d\"\n:\n\"\"}\n");
  ASSERT_TRUE(entries.ok()) << entries.error().message;
  const std::vector<SettingsEntry> expected{{"", "a", 1.5, 2},
                                            {"keys", "b", std::string("Ctrl+Z"), 5},
                                            {"keys", "c", true, 5},
                                            {"", "d", std::string(), 7}};
  EXPECT_EQ(entries.value(), expected);
}

TEST_F(SettingsFile, IsReadAsItWasWritten) {
  std::vector<SettingsEntry> entries{{"", "a \"b\"\n", std::string("ü\\ \t"), 0},
                                     {"one", "x", 0.1, 0},
                                     {"one", "y", -1e-300, 0},
                                     {"two", "x", false, 0},
                                     {"", "end", 3.0, 0}};
  const auto again = read(settings_text(entries));
  ASSERT_TRUE(again.ok()) << again.error().message << settings_text(entries);
  ASSERT_EQ(again.value().size(), entries.size());
  for (std::size_t n = 0; n < entries.size(); ++n) {
    EXPECT_GT(again.value()[n].line, 1);
    entries[n].line = again.value()[n].line;
    EXPECT_EQ(again.value()[n], entries[n]) << n;
  }
  EXPECT_EQ(read(settings_text({})).value().size(), 0U);
}

TEST_F(SettingsFile, IsRefusedWithTheLineAndTheRemedy) {
  for (const auto& [text, words] :
       {std::pair{"{\n\"a\": [1]}", ":2: a list is no value"},
        {"{\n\n\"a\": null}", ":3: null is no value"},
        {"{\"a\": {\"b\":\n {}}}", ":2: a section in a section"},
        {"{\"a\": 1,\n\"a\": 2}", ":2: \"a\" stands there twice"},
        {"{\"s\": {\"a\": 1,\n\"a\": 2}}", ":2: \"a\" stands there twice"},
        {"{\"s\": {\"a\": 1},\n\"s\": {\"b\": 2}}", ":2: \"s\" stands there twice"},
        {"{\"a\": 1\n\"b\": 2}", ":2: not JSON"},
        {"{\"a\": \"x\n\"}", ":1: not JSON"},
        {"{\n\"a\": 1e999}", ":2: a number is too large"},
        {"\n3", ":2: no object"},
        {"", ":1: not JSON"}}) {
    EXPECT_THAT(refusal(text), HasSubstr(words)) << text;
  }
  EXPECT_THAT(refusal("{\"a\": \"" + std::string(1'000'000, 'x') + "\"}"), HasSubstr("1000000"));
  EXPECT_FALSE(read_settings_file(folder_ / "none.json").ok());
}

TEST_F(SettingsFile, ThatWasCutOffIsNeverRead) {
  const std::string whole = settings_text(
      std::vector<SettingsEntry>{{"", "a", 1.0, 0}, {"keys", "b", std::string("Ctrl+Z"), 0}});
  ASSERT_TRUE(read(whole).ok());
  // The last byte is the end of the last line.
  for (std::size_t length = 0; length + 1 < whole.size(); ++length) {
    EXPECT_FALSE(read(whole.substr(0, length)).ok()) << length;
  }
}

}  // namespace
}  // namespace argil::io
