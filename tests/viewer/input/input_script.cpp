// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/input_script.h"

#include <fstream>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "support/scratch.h"

namespace argil::viewer {
namespace {

TEST(InputScript, NamesLineAndWordOfWhatItCannotRead) {
  const test::ScratchFolder folder;
  const auto read = [&](const std::string& text) {
    std::ofstream(folder / "s.txt") << text;
    return read_input_script(folder / "s.txt");
  };
  EXPECT_EQ(read("# nothing\n\nsettle\nmove 3 4 # there\n").value().size(), 2U);
  const auto moved = read("move 3 4\n").value();
  EXPECT_EQ(std::get<PlayEvent>(moved.front().what).event.x, 3.0);
  EXPECT_EQ(std::get<PlayEvent>(moved.front().what).event.y, 4.0);
  EXPECT_EQ(read("drag left 0 0 10 10 5 ctrl+shift\n").value().size(), 9U);
  for (const auto& [text, word] : {std::pair{"settle\nmoove 1 2\n", "moove"},
                                   {"settle\nmove 1 x\n", "'x'"},
                                   {"settle\npress up\n", "'up'"},
                                   {"settle\nkey Ctrl+Nothing\n", "Ctrl+Nothing"},
                                   {"settle\nframes 0\n", "N must be"},
                                   {"settle\nmove 1 2 3\n", "'3'"},
                                   {"settle\nclick\n", "LABEL"},
                                   {"settle\ndrag left 1 2 3\n", "must be a number"}}) {
    const auto steps = read(text);
    ASSERT_FALSE(steps.ok()) << text;
    EXPECT_NE(steps.error().message.find(":2: "), std::string::npos) << steps.error().message;
    EXPECT_NE(steps.error().message.find(word), std::string::npos) << steps.error().message;
  }
  EXPECT_FALSE(read_input_script(folder / "none.txt").ok());
}

}  // namespace
}  // namespace argil::viewer
