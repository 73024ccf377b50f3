// SPDX-License-Identifier: GPL-3.0-or-later
// argil falcon, run as a user runs it, on an emulated device that umockdev shows to the program
// too.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/run_argil.h"
#include "falcon/driver.h"
#include "support/falcon_emulator/umockdev_handler.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

using haptics::test::homing_plan;
using haptics::test::synthetic_firmware;
using testing::HasSubstr;
using testing::Not;

/// What is started in its life sees the emulated device.
class Shown {
 public:
  explicit Shown(const DspOptions& options) : falcon(options, true), handler_(falcon.bus()) {
    ::setenv("LD_PRELOAD", "libumockdev-preload.so.0", 1);
  }
  ~Shown() { ::unsetenv("LD_PRELOAD"); }

  EmulatedFalcon falcon;

 private:
  UmockdevHandler handler_;
};

DspOptions in_a_hand_that_homes() {
  DspOptions options;
  options.plan = homing_plan();
  for (int n = 0; n < 200; ++n) {
    haptics::HandKey key = options.plan.back();
    key.time_s += 0.5;
    key.place_mm.z = n % 2 == 0 ? 55.0 : -15.0;
    options.plan.push_back(key);
  }
  return options;
}

// One program for each emulated device: umockdev 0.17 may leave a second one without an answer when
// the machine is busy.

TEST(FalconCommand, ListsWhatIsAttached) {
  const Shown shown(in_a_hand_that_homes());
  const auto good = run_argil({"falcon", "list", "--json"});
  ASSERT_EQ(good.status, 0) << good.err;
  ASSERT_EQ(good.json()["falcons"].size(), 1U);
  EXPECT_EQ(good.json()["falcons"][0]["serial"], "EMULATED1");
  EXPECT_EQ(good.json()["falcons"][0]["usable"], true);
}

TEST(FalconCommand, ListSaysWhyItCannotBeUsed) {
  Shown shown(in_a_hand_that_homes());
  shown.falcon.set_faults([](FalconFaults& faults) { faults.is_taken = true; });
  const auto taken = run_argil({"falcon", "list", "--json"});
  EXPECT_EQ(taken.json()["falcons"][0]["usable"], false);
  EXPECT_THAT(taken.json()["falcons"][0]["obstacle"], HasSubstr("another program"));
}

TEST(FalconCommand, ListsWhetherThereIsAFirmwareToSend) {
  const ScratchFolder folder;
  const auto bytes = synthetic_firmware();
  fill(folder / "good.bin", std::string(bytes.begin(), bytes.end()));
  fill(folder / "bad.bin", "not one");
  const Shown shown(in_a_hand_that_homes());
  const auto usable_with = [&](const char* name) {
    ::setenv("ARGIL_FALCON_FIRMWARE", (folder / name).c_str(), 1);
    const auto run = run_argil({"falcon", "list", "--json"});
    ::unsetenv("ARGIL_FALCON_FIRMWARE");
    return run.json()["firmware"]["usable"] == true;
  };
  EXPECT_TRUE(usable_with("good.bin"));
  EXPECT_FALSE(usable_with("bad.bin"));
  EXPECT_THAT(run_argil({"falcon", "list"}).out, HasSubstr("--firmware"));
}

TEST(FalconCommand, ProbeSendsTheFirmwareAndTellsHowFastItAnswers) {
  const ScratchFolder folder;
  const auto bytes = synthetic_firmware();
  fill(folder / "firmware.bin", std::string(bytes.begin(), bytes.end()));
  DspOptions options = in_a_hand_that_homes();
  options.is_loaded = false;
  const Shown shown(options);
  const auto sent = run_argil({"falcon", "probe", "--json", "--firmware", folder / "firmware.bin"});
  ASSERT_EQ(sent.status, 0) << sent.err;
  EXPECT_EQ(sent.json()["firmware"], "sent");
  EXPECT_GT(sent.json()["rate_hz"], 10.0);
}

TEST(FalconCommand, ProbeAsksForTheFirmware) {
  DspOptions options;
  options.is_loaded = false;
  const Shown shown(options);
  const auto none = run_argil({"falcon", "probe", "--json"});
  EXPECT_EQ(none.status, 4);
  EXPECT_THAT(none.err, HasSubstr("--firmware"));
}

TEST(FalconCommand, ProbeSeesThatTheFirmwareRuns) {
  const Shown shown(in_a_hand_that_homes());
  const auto probed = run_argil({"falcon", "probe", "--json"});
  ASSERT_EQ(probed.status, 0) << probed.err;
  EXPECT_EQ(probed.json()["firmware"], "ran already");
}

TEST(FalconCommand, HomeGuidesUntilTheLightIsGreen) {
  const Shown shown(in_a_hand_that_homes());
  const auto homed = run_argil({"falcon", "home", "--json"});
  ASSERT_EQ(homed.status, 0) << homed.err;
  EXPECT_EQ(homed.json()["state"], "active");
  EXPECT_THAT(homed.err, HasSubstr("homed: the light is green"));
}

TEST(FalconCommand, MonitorsPositionForceAndRate) {
  const Shown shown(in_a_hand_that_homes());
  const auto watched =
      run_argil({"falcon", "monitor", "--json", "--seconds", "1", "--force", "0,0,-0.5"});
  ASSERT_EQ(watched.status, 0) << watched.err;
  EXPECT_GT(watched.json()["replies"], 10);
  EXPECT_THAT(watched.err, HasSubstr("force"));
}

/// A force that is not repeated in time would come in pulses of a share of it.
TEST(FalconCommand, MonitorPushesWithAllOfTheForce) {
  Shown shown(in_a_hand_that_homes());
  bool has_pushed = false;
  RunOptions until_pushed;
  until_pushed.interrupt_when = [&] {
    has_pushed = shown.falcon.with([](FalconDsp& dsp, FalconFaults&, double now_s) {
      return length(dsp.force_n(now_s)) > 0.45;
    });
    return has_pushed;
  };
  run_argil({"falcon", "monitor", "--quiet", "--force", "0,0,-0.5"}, until_pushed);
  EXPECT_TRUE(has_pushed);
}

TEST(FalconCommand, MonitorPushesWithNoMoreThanTwoNewtons) {
  const Shown shown(in_a_hand_that_homes());
  EXPECT_EQ(run_argil({"falcon", "monitor", "--force", "0,0,-3"}).status, 3);
}

bool is_pushed(EmulatedFalcon& falcon) {
  return falcon.with([](FalconDsp& dsp, FalconFaults&, double) {
    return !dsp.commands().empty() && !dsp.commands().back().is_zero();
  });
}

class FalconCommandSignal : public testing::TestWithParam<int> {};

TEST_P(FalconCommandSignal, EndsAPushWithZeroWords) {
  DspOptions options = in_a_hand_that_homes();
  options.torque_hold_s = 100.0;
  Shown shown(options);
  RunOptions interrupted;
  interrupted.signal = GetParam();
  interrupted.interrupt_when = [&] { return is_pushed(shown.falcon); };
  const auto run = run_argil({"falcon", "monitor", "--quiet", "--force", "0,0,-0.5"}, interrupted);
  EXPECT_EQ(run.signal, 0);
  EXPECT_EQ(run.status, GetParam() == SIGTERM ? 143 : 130) << run.err;
  EXPECT_FALSE(is_pushed(shown.falcon));
}
INSTANTIATE_TEST_SUITE_P(All, FalconCommandSignal,
                         testing::Values(SIGINT, SIGTERM, SIGHUP, SIGPIPE));

std::string calibration_with(const ScratchFolder& folder, const std::string& line) {
  const auto file = folder / "calibration.txt";
  fill(file, "argil_falcon_calibration = 1\nset = martin-hillier\n" + line + "\n");
  return file;
}

TEST(FalconCommand, MonitorCountsTheForceAgainstTheGripsWeight) {
  const ScratchFolder folder;
  const Shown shown(in_a_hand_that_homes());
  const std::string file = calibration_with(folder, "gravity_n = 0, 1.5, 0");
  const auto run =
      run_argil({"falcon", "monitor", "--calibration", file, "--force", "0,1,0", "--seconds", "1"});
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, HasSubstr("2.5 N"));
  const std::string heavy = calibration_with(folder, "gravity_n = 3, 3, 3");
  EXPECT_EQ(run_argil({"falcon", "monitor", "--calibration", heavy, "--seconds", "1"}).status, 3);
}

TEST(FalconCommand, LabRefusesWhatOnlyTheSimulatedDeviceSurvives) {
  const Shown shown(in_a_hand_that_homes());
  const auto direct = run_argil({"lab", "sphere", "--device", "falcon", "--coupling", "direct",
                                 "--no-governor", "--seconds", "1"});
  EXPECT_EQ(direct.status, 3);
  EXPECT_THAT(direct.err, HasSubstr("couple indirectly"));
  const auto sim = run_argil({"lab", "spring", "--firmware", "firmware.bin"});
  EXPECT_EQ(sim.status, 3);
  EXPECT_THAT(sim.err, HasSubstr("--device falcon"));
}

TEST(FalconCommand, LabRefusesARateThatTheWatchdogTakesForAHang) {
  const Shown shown(in_a_hand_that_homes());
  const auto slow = run_argil({"lab", "spring", "--device", "falcon", "--rate", "499"});
  EXPECT_EQ(slow.status, 3);
  EXPECT_THAT(slow.err, HasSubstr("--rate is 499; must be at least 500"));
}

/// Once, at the start, whichever of its threads it is.
TEST(FalconCommand, LabSaysWhatItsThreadsWereRefused) {
  const Shown shown(in_a_hand_that_homes());
  const auto run = run_argil({"lab", "spring", "--device", "falcon", "--seconds", "1", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string priority = run.json()["priority"];
  const std::size_t note = run.err.find("argil: note: ");
  if (priority == "real-time") {
    EXPECT_EQ(note, std::string::npos) << run.err;
  } else {
    EXPECT_THAT(run.err, HasSubstr("argil: note: " + priority));
    EXPECT_EQ(run.err.find("argil: note: ", note + 1), std::string::npos) << run.err;
  }
}

TEST(FalconCommand, LabIsSilentWhenItIsTold) {
  const Shown shown(in_a_hand_that_homes());
  const auto run = run_argil({"lab", "spring", "--device", "falcon", "--seconds", "1", "--quiet"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "");
}

TEST(FalconCommand, LabThatIsToldToEndDoesSoWithZeroWords) {
  DspOptions device = in_a_hand_that_homes();
  device.torque_hold_s = 100.0;
  Shown shown(device);
  RunOptions options;
  options.signal = SIGTERM;
  options.interrupt_when = [&] { return is_pushed(shown.falcon); };
  const auto run =
      run_argil({"lab", "spring", "--device", "falcon", "--seconds", "600", "--quiet"}, options);
  EXPECT_EQ(run.status, 143) << run.err;
  EXPECT_FALSE(is_pushed(shown.falcon));
}

TEST(FalconCommand, LabEndsWithTheFaultThatMetIt) {
  Shown shown(in_a_hand_that_homes());
  RunOptions options;
  options.signal = 0;  // none
  options.interrupt_when = [&] {
    if (!is_pushed(shown.falcon)) return false;
    shown.falcon.set_faults([](FalconFaults& faults) { faults.is_silent = true; });
    return true;
  };
  const auto run =
      run_argil({"lab", "spring", "--device", "falcon", "--seconds", "600", "--quiet"}, options);
  EXPECT_EQ(run.status, 4);
  EXPECT_THAT(run.err, HasSubstr("no longer answers"));
}

/// Presses the button at the left end of the groove, goes to its right end and back, every 3 s.
DspOptions in_a_hand_that_does_the_groove() {
  DspOptions options;
  options.plan = homing_plan();
  const auto go = [&](double seconds, double x_mm, bool presses) {
    haptics::HandKey key = options.plan.back();
    key.time_s += seconds;
    key.place_mm = {x_mm, -12.5, 46.0};  // above all that could be felt
    key.is_active = presses;
    options.plan.push_back(key);
  };
  for (int n = 0; n < 40; ++n) {
    go(0.5, -35.0, false);
    go(0.3, -35.0, true);
    go(0.1, -35.0, false);
    go(1.4, -35.0, false);
    go(0.7, 35.0, false);
  }
  return options;
}

/// A person's study is not lost with the device: the trials that had ended are kept.
TEST(FalconCommand, TrialKeepsWhatHadEndedWhenTheDeviceFails) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder / "trials.csv";
  Shown shown(in_a_hand_that_does_the_groove());
  RunOptions options;
  options.signal = 0;  // none
  options.interrupt_when = [&] {
    if (!std::filesystem::exists(file)) return false;
    shown.falcon.set_faults([](FalconFaults& faults) { faults.is_silent = true; });
    return true;
  };
  const auto run = run_argil({"lab", "trial", "--task", "groove", "--device", "falcon", "--repeats",
                              "50", "-o", file.string()},
                             options);
  EXPECT_EQ(run.status, 4);
  EXPECT_THAT(run.err, HasSubstr("press the grip's button to begin"));
  EXPECT_THAT(run.err, HasSubstr("no longer answers"));
  EXPECT_THAT(run.err, HasSubstr("of the trials, is in"));
  const std::string table = content_of(file);
  EXPECT_THAT(table, HasSubstr(",person,"));
  EXPECT_GE(std::count(table.begin(), table.end(), '\n'), 2);
}

TEST(FalconCommand, HomeSaysThatNobodyMovesTheGrip) {
  DspOptions still;
  const Shown shown(still);
  const auto home = run_argil({"falcon", "home", "--json", "--seconds", "1"});
  EXPECT_EQ(home.status, 4);
  EXPECT_THAT(home.err, HasSubstr("power adapter"));
}

/// Both before the device is opened.
TEST(FalconCommand, RefusesABadFirmwareOrCalibration) {
  const ScratchFolder folder;
  fill(folder / "firmware.bin", "not one");
  const Shown shown(in_a_hand_that_homes());
  EXPECT_EQ(run_argil({"falcon", "probe", "--firmware", folder / "firmware.bin"}).status, 3);
  EXPECT_EQ(run_argil({"falcon", "probe", "--calibration", folder / "firmware.bin"}).status, 3);
  const auto wrong = run_argil({"falcon", "probe", "--calibration", "novint"});
  EXPECT_EQ(wrong.status, 3);
  EXPECT_THAT(wrong.err, HasSubstr("martin-hillier, libnifalcon"));
  const std::string far = calibration_with(folder, "pulled_out_mm = 60");
  const auto unreachable = run_argil({"falcon", "probe", "--calibration", far});
  EXPECT_EQ(unreachable.status, 3);
  EXPECT_THAT(unreachable.err, HasSubstr("pulled_out_mm"));
}

TEST(FalconCommand, FeelsASceneOfTheLab) {
  const ScratchFolder folder;
  const Shown shown(in_a_hand_that_homes());
  const auto run = run_argil({"lab", "spring", "--device", "falcon", "--seconds", "2", "--json",
                              "-o", folder / "run.csv"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_GT(run.json()["ticks"], 100);
  EXPECT_TRUE(std::filesystem::exists(folder / "run.csv"));
}

TEST(FalconCommand, SaysThatNoneIsAttached) {
  EmulatedFalcon falcon;
  falcon.unplug();
  ::setenv("LD_PRELOAD", "libumockdev-preload.so.0", 1);
  const auto listed = run_argil({"falcon", "list", "--json"});
  const auto told = run_argil({"falcon", "list"});
  const auto probed = run_argil({"falcon", "probe"});
  ::unsetenv("LD_PRELOAD");
  EXPECT_EQ(listed.status, 0);
  EXPECT_TRUE(listed.json()["falcons"].empty());
  EXPECT_THAT(told.out, HasSubstr("0403:cb48"));
  EXPECT_THAT(told.out, Not(HasSubstr("falcon list")));
  EXPECT_EQ(probed.status, 4);
  EXPECT_THAT(probed.err, HasSubstr("0403:cb48"));
}

}  // namespace
}  // namespace argil::test
