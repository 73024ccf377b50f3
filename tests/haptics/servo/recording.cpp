// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/recording.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <thread>

#include <gtest/gtest.h>

#include "argil/haptics/simulation/sim_falcon.h"

#include "haptics/servo/loop_scenes.h"
#include "support/effort.h"
#include "support/scratch.h"

namespace argil::haptics {
namespace {

namespace fs = std::filesystem;
using scenes::PlainWall;

class RecordingTest : public testing::Test {
 protected:
  fs::path file(const char* name) const { return folder_ / name; }

  /// Records a hand that presses a wall, with a fault in the middle.
  void record(const fs::path& to, int ticks) const {
    auto recorder = Recorder::start(to, "press a wall");
    ASSERT_TRUE(recorder.ok()) << recorder.error().message;
    SimFalcon device({}, hand_model(Hand::light),
                     HandPlan(press_plan({0.0, -6.0, 0.0}, scenes::kDown, 2.0)));
    PlainWall wall(700.0);
    Servo servo(device, wall, {}, &recorder.value()->ring());
    for (int n = 0; n < ticks; ++n) {
      device.set_plugged(n < 700 || n > 720);
      servo.tick(1.234567e-3 * n);
      // as fast as the writer: in use the ticks come a millisecond apart
      if (n % 4096 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    ASSERT_TRUE(recorder.value()->finish().ok());
    ASSERT_EQ(recorder.value()->dropped(), 0U);
    ASSERT_EQ(recorder.value()->written(), static_cast<std::uint64_t>(ticks));
  }

  static DeviceTraits traits() {
    return SimFalcon({}, {}, HandPlan({HandKey{}})).traits(ServoOptions{}.period_s);
  }

 private:
  argil::test::ScratchFolder folder_;
};

TEST_F(RecordingTest, ReplaysToTheSameForcesBitForBit) {
  record(file("run.csv"), 5000);
  const auto recording = read_recording(file("run.csv"));
  ASSERT_TRUE(recording.ok()) << recording.error().message;
  EXPECT_EQ(recording.value().note, "press a wall");
  ReplayDevice device(recording.value(), traits());
  PlainWall wall(700.0);
  Servo servo(device, wall, {});
  ASSERT_TRUE(replay(servo, recording.value()).ok());
  EXPECT_EQ(device.different(), 0U) << device.first_different();
  double felt = 0.0;
  for (const ServoTick& tick : recording.value().ticks) felt = std::max(felt, tick.force_n.y);
  EXPECT_GT(felt, 1.5);  // and it was not nothing that was compared
}

TEST_F(RecordingTest, IsHaltedInAReplayWhereItWas) {
  Recording recording;
  recording.note = "halted in the middle";
  SimFalcon hand({}, hand_model(Hand::light),
                 HandPlan(press_plan({0.0, -6.0, 0.0}, scenes::kDown, 2.0)));
  PlainWall wall(700.0);
  Servo recorded(hand, wall, {});
  for (int n = 0; n < 3000; ++n) {
    if (n == 1500) recorded.halt();
    if (n == 1600) recorded.resume();
    recording.ticks.push_back(recorded.tick(1e-3 * n));
  }
  ReplayDevice device(recording, traits());
  Servo servo(device, wall, {});
  ASSERT_TRUE(replay(servo, recording).ok());
  EXPECT_EQ(device.different(), 0U) << device.first_different();
}

TEST_F(RecordingTest, StopsAReplayWhenAskedOrWhereTheCallerFails) {
  record(file("run.csv"), 1000);
  const auto recording = read_recording(file("run.csv"));
  ASSERT_TRUE(recording.ok());
  PlainWall wall(700.0);
  ReplayDevice device(recording.value(), traits());
  Servo servo(device, wall, {});
  double seen = 0.0;
  std::uint64_t ticks = 0;
  const auto count = [&](const ServoTick& tick) {
    ticks = tick.number;
    return Result<void>();
  };
  const auto stopped =
      replay(servo, recording.value(), count, [&](std::string_view, double fraction) {
        seen = fraction;
        return fraction < 0.5;
      });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted);
  EXPECT_DOUBLE_EQ(seen, 0.512);
  EXPECT_EQ(ticks, 511U);

  ReplayDevice again(recording.value(), traits());
  Servo other(again, wall, {});
  const auto failed = replay(other, recording.value(), [](const ServoTick& tick) -> Result<void> {
    if (tick.number < 10) return {};
    return Error{ErrorKind::memory, "no window"};
  });
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().message, "no window");
}

TEST_F(RecordingTest, WritesTheSameFileAtOnceAndNoneWhenAskedToStop) {
  record(file("run.csv"), 1000);
  const auto recording = read_recording(file("run.csv"));
  ASSERT_TRUE(recording.ok());
  ASSERT_TRUE(write_recording(file("copy.csv"), recording.value()).ok());
  EXPECT_EQ(argil::test::content_of(file("copy.csv")), argil::test::content_of(file("run.csv")));

  int asked = 0;
  const auto stopped = write_recording(file("copy.csv"), {"of another", recording.value().ticks},
                                       [&](std::string_view, double) { return ++asked < 3; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted);
  EXPECT_EQ(asked, 3);
  EXPECT_FALSE(fs::exists(file("copy.csv.part")));
  EXPECT_EQ(argil::test::content_of(file("copy.csv")), argil::test::content_of(file("run.csv")))
      << "what was there stays";
}

/// The writer cannot keep up with ticks that come as fast as they can be pushed.
TEST_F(RecordingTest, IsNotKeptWithGaps) {
  auto recorder = Recorder::start(file("run.csv"), "x");
  ASSERT_TRUE(recorder.ok());
  ServoTick tick;
  while (recorder.value()->dropped() == 0) {
    ++tick.number;
    recorder.value()->ring().push(tick);
  }
  const auto refused = recorder.value()->finish();
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::disk);
  EXPECT_NE(refused.error().message.find("lost 1 ticks"), std::string::npos)
      << refused.error().message;
  EXPECT_FALSE(fs::exists(file("run.csv")));
  EXPECT_FALSE(fs::exists(file("run.csv.part")));
}

TEST_F(RecordingTest, TellsWhereAnotherSceneDiffers) {
  record(file("run.csv"), 2000);
  const auto recording = read_recording(file("run.csv"));
  ASSERT_TRUE(recording.ok());
  ReplayDevice device(recording.value(), traits());
  PlainWall wall(701.0);
  Servo servo(device, wall, {});
  ASSERT_TRUE(replay(servo, recording.value()).ok());
  EXPECT_GT(device.different(), 100U);
  EXPECT_GE(device.first_different(), 1U);
}

TEST_F(RecordingTest, IsRefusedWhereverItIsCutOff) {
  record(file("run.csv"), argil::test::effort(5, 20));
  std::ifstream in(file("run.csv"), std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t head = text.find('\n', text.find('\n') + 1) + 1;
  for (std::size_t length = 0; length < text.size(); ++length) {
    fs::remove(file("cut.csv"));  // ext4 waits for the disk where a file is written over
    std::ofstream(file("cut.csv"), std::ios::binary) << text.substr(0, length);
    const auto cut = read_recording(file("cut.csv"));
    // whole lines are a shorter recording, and nothing else is one
    EXPECT_EQ(cut.ok(), length >= head && text[length - 1] == '\n') << length;
    if (!cut.ok()) {
      EXPECT_EQ(cut.error().kind, ErrorKind::bad_input);
    }
  }
}

TEST_F(RecordingTest, KeepsHowOldWindowsWereAndReadsThoseWithoutIt) {
  Recording recording;
  recording.note = "ages";
  for (std::uint64_t n = 1; n <= 3; ++n) {
    ServoTick tick;
    tick.number = n;
    tick.window = {n, n, 0.001 * static_cast<double>(n)};
    recording.ticks.push_back(tick);
  }
  ASSERT_TRUE(write_recording(file("new.csv"), recording).ok());
  const auto kept = read_recording(file("new.csv"));
  ASSERT_TRUE(kept.ok()) << kept.error().message;
  EXPECT_EQ(kept.value().ticks[2].window.age_s, 0.003);

  std::ifstream in(file("new.csv"));
  std::ofstream old(file("old.csv"));
  for (std::string line; std::getline(in, line);) {
    const bool is_note = line.rfind("# ", 0) == 0;
    old << (is_note ? line : line.substr(0, line.rfind(','))) << '\n';
  }
  old.close();
  const auto before = read_recording(file("old.csv"));
  ASSERT_TRUE(before.ok()) << before.error().message;
  ASSERT_EQ(before.value().ticks.size(), 3U);
  EXPECT_EQ(before.value().ticks[2].window.answers, 3U);
  EXPECT_LT(before.value().ticks[2].window.age_s, 0.0);

  std::ifstream whole(file("new.csv"));
  std::string text((std::istreambuf_iterator<char>(whole)), std::istreambuf_iterator<char>());
  text.replace(text.rfind(",0.003"), 6, ",nan");
  std::ofstream(file("bad.csv")) << text;
  EXPECT_FALSE(read_recording(file("bad.csv")).ok());
}

TEST_F(RecordingTest, NamesAMissingTick) {
  record(file("run.csv"), 20);
  std::ifstream in(file("run.csv"));
  std::ofstream out(file("gap.csv"));
  std::string line;
  for (int n = 1; std::getline(in, line); ++n) {
    if (n != 9) out << line << "\n";
  }
  out.close();
  const auto gap = read_recording(file("gap.csv"));
  ASSERT_FALSE(gap.ok());
  EXPECT_NE(gap.error().message.find("line 9: tick 7 is missing"), std::string::npos)
      << gap.error().message;
}

TEST_F(RecordingTest, RefusesPlacesAndTimesThatNoServoCanHave) {
  record(file("run.csv"), 3);
  std::ifstream in(file("run.csv"), std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
  constexpr int kTime = 1;  // columns
  constexpr int kX = 3;
  constexpr int kWantedX = 13;
  const auto read_with = [&](int column, const std::string& value) {
    std::size_t begin = last;
    for (int n = 0; n < column; ++n) begin = text.find(',', begin) + 1;
    std::string changed = text;
    changed.replace(begin, text.find(',', begin) - begin, value);
    std::ofstream(file("changed.csv"), std::ios::binary) << changed;
    return read_recording(file("changed.csv"));
  };
  for (const char* value : {"nan", "inf", "-inf", "1e308", "1000001"}) {
    const auto refused = read_with(kX, value);
    ASSERT_FALSE(refused.ok()) << value;
    EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
    EXPECT_NE(refused.error().message.find("line 5"), std::string::npos) << refused.error().message;
  }
  for (const char* value : {"nan", "inf", "1e308"}) EXPECT_FALSE(read_with(kTime, value).ok());
  EXPECT_TRUE(read_with(kX, "1e6").ok());
  EXPECT_TRUE(read_with(kWantedX, "nan").ok()) << "a scene may have failed";
}

TEST_F(RecordingTest, SaysWhatIsWrongWithAFile) {
  std::ofstream(file("not.csv")) << "hello\n";
  const auto not_one = read_recording(file("not.csv"));
  ASSERT_FALSE(not_one.ok());
  EXPECT_EQ(not_one.error().kind, ErrorKind::bad_input);
  EXPECT_EQ(read_recording(file("none.csv")).error().kind, ErrorKind::disk);
  EXPECT_EQ(Recorder::start(file("no/such/folder.csv"), "x").error().kind, ErrorKind::disk);
  EXPECT_EQ(Recorder::start(file("x.csv"), "two\nlines").error().kind, ErrorKind::bad_input);
}

TEST_F(RecordingTest, IsThereOnlyWhenItIsWhole) {
  auto recorder = Recorder::start(file("run.csv"), "x");
  ASSERT_TRUE(recorder.ok());
  EXPECT_FALSE(fs::exists(file("run.csv")));
  ASSERT_TRUE(recorder.value()->finish().ok());
  EXPECT_TRUE(fs::exists(file("run.csv")));
  EXPECT_FALSE(fs::exists(file("run.csv.part")));
}

/// A run that the disk does not take.
TEST_F(RecordingTest, LeavesNothingWhereItCannotBeWritten) {
  fs::create_directory(file("taken.csv"));  // a file takes no folder's place
  fs::create_directory(file("taken.csv") / "something");
  Recording recording;
  recording.note = "x";
  const auto refused = write_recording(file("taken.csv"), recording);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::disk);
  EXPECT_FALSE(fs::exists(file("taken.csv.part")));
  auto recorder = Recorder::start(file("taken.csv"), "x");
  ASSERT_TRUE(recorder.ok());
  EXPECT_FALSE(recorder.value()->finish().ok());
  EXPECT_FALSE(fs::exists(file("taken.csv.part")));
}

TEST_F(RecordingTest, FollowsNoLinkThatWasPlantedInItsPlace) {
  std::ofstream(file("mine.txt")) << "mine";
  fs::create_symlink(file("mine.txt"), file("run.csv.part"));
  ASSERT_TRUE(write_recording(file("run.csv"), {"x", {}}).ok());
  EXPECT_FALSE(fs::is_symlink(file("run.csv")));
  EXPECT_EQ(read_recording(file("run.csv")).value().note, "x");
  std::string text;
  std::ifstream(file("mine.txt")) >> text;
  EXPECT_EQ(text, "mine");
}

}  // namespace
}  // namespace argil::haptics
