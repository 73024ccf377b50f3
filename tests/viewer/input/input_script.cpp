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
  const auto pen = read("pen 0.5 eraser\npress left\npen 1\npress left\n").value();
  EXPECT_TRUE(std::get<PlayEvent>(pen.front().what).event.is_eraser);
  EXPECT_EQ(std::get<PlayEvent>(pen.front().what).event.pressure, 0.5);
  EXPECT_FALSE(std::get<PlayEvent>(pen.back().what).event.is_eraser);
  const auto fingers = read("finger 2 3 4\nfinger 2 5 6\nfinger 2 up\n").value();
  const auto& lifted = std::get<PlayEvent>(fingers.back().what).event;
  EXPECT_EQ(std::get<PlayEvent>(fingers[0].what).event.kind, InputEvent::Kind::finger_down);
  EXPECT_EQ(std::get<PlayEvent>(fingers[1].what).event.kind, InputEvent::Kind::finger_move);
  EXPECT_EQ(std::get<PlayEvent>(fingers[1].what).event.x, 5.0);
  EXPECT_EQ(lifted.kind, InputEvent::Kind::finger_up);
  EXPECT_EQ(lifted.finger, 2U);
  EXPECT_EQ(read("drag left 0 0 10 10 5 ctrl+shift\n").value().size(), 9U);
  const auto held = read("hold Ctrl+F9\nmove 3 4\nlet Ctrl+F9\n").value();
  ASSERT_EQ(held.size(), 3U);
  EXPECT_EQ(std::get<PlayEvent>(held.front().what).event.kind, InputEvent::Kind::key_down);
  EXPECT_TRUE(std::get<PlayEvent>(held.front().what).event.modifiers.ctrl);
  EXPECT_EQ(std::get<PlayEvent>(held.back().what).event.kind, InputEvent::Kind::key_up);
  for (const auto& [text, word] : {std::pair{"settle\nmoove 1 2\n", "moove"},
                                   {"settle\nmove 1 x\n", "'x'"},
                                   {"settle\npress up\n", "'up'"},
                                   {"settle\nkey Ctrl+Nothing\n", "Ctrl+Nothing"},
                                   {"settle\nhold Ctrl+\n", "'Ctrl+'"},
                                   {"settle\nlet\n", "is no key"},
                                   {"settle\nframes 0\n", "N is '0'; must be"},
                                   {"settle\nmove 1 2 3\n", "'3'"},
                                   {"settle\npen 0.5 tail\n", "tail"},
                                   {"settle\nfinger 1 up\n", "is not down"},
                                   {"settle\nfinger 11 3 4\n", "'11'"},
                                   {"settle\nclick\n", "LABEL"},
                                   {"settle\ndrag left 1 2 3\n", "must be a number"}}) {
    const auto steps = read(text);
    ASSERT_FALSE(steps.ok()) << text;
    EXPECT_NE(steps.error().message.find(":2: "), std::string::npos) << steps.error().message;
    EXPECT_NE(steps.error().message.find(word), std::string::npos) << steps.error().message;
  }
  EXPECT_FALSE(read_input_script(folder / "none.txt").ok());
}

TEST(InputScript, RefusesNumbersOutOfRangeWithValueAndRange) {
  const test::ScratchFolder folder;
  const auto read = [&](const std::string& line) {
    std::ofstream(folder / "s.txt") << "settle\n" << line << "\n";
    return read_input_script(folder / "s.txt");
  };
  const struct {
    std::string before;  ///< of the line
    std::string after;
    std::string name;
    std::string range;
    const char* least;
    const char* most;
    const char* beyond;
  } places[] = {
      {"move ", " 2", "X", "-100000 to 100000 pixels", "-100000", "1e5", "100000.5"},
      {"drag left 0 0 ", " 10", "X", "-100000 to 100000 pixels", "-100000", "1e5", "-100001"},
      {"drag left 0 0 1 ", " 5", "Y", "-100000 to 100000 pixels", "-100000", "1e5", "-100001"},
      {"drag left 0 0 1 1 ", "", "N", "1 to 10000", "1", "10000", "10001"},
      {"scroll ", "", "STEPS", "-100 to 100", "-100", "100", "101"},
      {"pen ", "", "PRESSURE", "0 to 1", "0", "1", "1.01"},
      {"puck 0 ", " 0 0 0 0 1", "Y", "-1 to 1", "-1", "1", "1.5"},
      {"puck 0 0 0 0 0 ", " 1", "RZ", "-1 to 1", "-1", "1", "-1.5"},
      {"puck 0 0 0 0 0 0 ", "", "S", "0 to 10 seconds", "0", "10", "-0.1"},
      {"finger ", " 3 4", "N", "1 to 10", "1", "10", "11"},
      {"finger 1 ", " 4", "X", "-100000 to 100000 pixels", "-100000", "1e5", "-100001"},
      {"frames ", "", "N", "1 to 10000", "1", "10000", "2.5"},
      {"resize ", " 480", "WIDTH", "320 to 8192 pixels", "320", "8192", "319"},
      {"resize 640 ", "", "HEIGHT", "240 to 8192 pixels", "240", "8192", "239"}};
  for (const auto& place : places) {
    for (const char* good : {place.least, place.most}) {
      const auto steps = read(place.before + good + place.after);
      EXPECT_TRUE(steps.ok()) << place.before << good << ": " << steps.error().message;
    }
    for (const char* bad : {place.beyond, "nan", "inf", "-inf", "1e308", "1e999", "1x"}) {
      const auto steps = read(place.before + bad + place.after);
      ASSERT_FALSE(steps.ok()) << place.before << bad;
      const std::string& message = steps.error().message;
      EXPECT_EQ(steps.error().kind, ErrorKind::bad_input);
      EXPECT_NE(message.find(":2: " + place.name + " is '" + bad + "'; must be a "),
                std::string::npos)
          << message;
      EXPECT_NE(message.find(place.range), std::string::npos) << message;
    }
  }
}

}  // namespace
}  // namespace argil::viewer
