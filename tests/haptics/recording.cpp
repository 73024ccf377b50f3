// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/recording.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "argil/haptics/sim_falcon.h"

#include "loop_scenes.h"
#include "support/effort.h"

namespace argil::haptics {
namespace {

namespace fs = std::filesystem;
using scenes::PlainWall;

class RecordingTest : public testing::Test {
 protected:
  RecordingTest()
      : folder_(fs::temp_directory_path() / ("argil_rec_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~RecordingTest() override { fs::remove_all(folder_); }
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
  fs::path folder_;
};

TEST_F(RecordingTest, ReplaysToTheSameForcesBitForBit) {
  record(file("run.csv"), 5000);
  const auto recording = read_recording(file("run.csv"));
  ASSERT_TRUE(recording.ok()) << recording.error().message;
  EXPECT_EQ(recording.value().note, "press a wall");
  ReplayDevice device(recording.value(), traits());
  PlainWall wall(700.0);
  Servo servo(device, wall, {});
  replay(servo, recording.value());
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
  replay(servo, recording);
  EXPECT_EQ(device.different(), 0U) << device.first_different();
}

TEST_F(RecordingTest, TellsWhereAnotherSceneDiffers) {
  record(file("run.csv"), 2000);
  const auto recording = read_recording(file("run.csv"));
  ASSERT_TRUE(recording.ok());
  ReplayDevice device(recording.value(), traits());
  PlainWall wall(701.0);
  Servo servo(device, wall, {});
  replay(servo, recording.value());
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

}  // namespace
}  // namespace argil::haptics
