// SPDX-License-Identifier: GPL-3.0-or-later
// The device with its own thread, and the rig on it, on the machine's time.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <thread>

#include "argil/haptics/falcon/falcon_device.h"
#include "argil/haptics/rig/rig.h"

#include "falcon/driver.h"
#include "support/effort.h"
#include "support/scratch.h"

namespace argil::haptics {
namespace {

using argil::test::ScratchFolder;
using test::EmulatedFalcon;
using test::FalconDsp;
using test::FalconFaults;

/// Looks until it is so; false when it is not within many seconds, whatever the machine does.
bool until(const std::function<bool()>& is_so) {
  for (int n = 0; n < 20'000; ++n) {
    if (is_so()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

/// Homes and is pushed into, again and again for a minute: the machine may be slow to look.
test::DspOptions worked_by_hand() {
  test::DspOptions options;
  options.is_homed = true;
  options.plan = test::homing_plan();
  for (int n = 0; n < 60; ++n) {
    HandKey key = options.plan.back();
    key.time_s += 0.5;
    key.place_mm.z = n % 2 == 0 ? 45.0 : 5.0;
    options.plan.push_back(key);
  }
  return options;
}

bool is_last_word_zero(EmulatedFalcon& falcon) {
  std::this_thread::sleep_for(std::chrono::milliseconds(5));  // it may be on the line
  return falcon.with([](FalconDsp& dsp, FalconFaults&, double) {
    return !dsp.commands().empty() && dsp.commands().back().is_zero();
  });
}

TEST(FalconThread, SendsItsFirmwareHomesAndGivesForces) {
  const ScratchFolder folder;
  const auto bytes = test::synthetic_firmware();
  argil::test::fill(folder / "firmware.bin", std::string(bytes.begin(), bytes.end()));
  test::DspOptions model = worked_by_hand();
  model.is_loaded = false;
  EmulatedFalcon falcon(model, true);
  FalconOptions options;
  options.firmware = folder / "firmware.bin";
  {
    auto opened = FalconDevice::open(options);
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    FalconDevice& device = *opened.value();
    ASSERT_TRUE(until([&] { return device.look().state == FalconState::active; }));
    EXPECT_GE(device.look().attempt, 1);
    ASSERT_TRUE(until([&] {
      device.write({0.0, 0.0, -2.0});
      return device.look().force_n.z < -1.9;
    }));
    EXPECT_TRUE(device.read(0.0).is_ready);
    EXPECT_GT(device.traits(1e-3).delay_s, 0.0);
  }
  EXPECT_TRUE(is_last_word_zero(falcon));
}

/// As 'argil falcon' does beside a viewer: it opens the same node and asks for its serial number.
TEST(FalconThread, IsNotDisturbedByWhoLooksWhatIsAttached) {
  EmulatedFalcon falcon(worked_by_hand(), true);
  auto opened = FalconDevice::open({});
  ASSERT_TRUE(opened.ok()) << opened.error().message;
  FalconDevice& device = *opened.value();
  ASSERT_TRUE(until([&] { return device.look().state == FalconState::active; }));
  const int attempt = device.look().attempt;
  for (int n = 0; n < 50; ++n) {
    const auto attached = attached_falcons();
    ASSERT_TRUE(attached.ok());
    ASSERT_EQ(attached.value().size(), 1U);
    EXPECT_EQ(attached.value()[0].serial, "EMULATED1");
    EXPECT_EQ(attached.value()[0].obstacle, FalconFault::busy);
  }
  EXPECT_EQ(device.look().fault, FalconFault::none);
  EXPECT_EQ(device.look().attempt, attempt);
}

/// Pushes, and can stop the servo's thread, as a scene does that waits for ever.
class StoppingScene final : public ForceScene {
 public:
  SceneForce force_at(const HandleState&) const noexcept override {
    while (is_to_stop_) {
      is_stopped_ = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    is_stopped_ = false;
    return {{0.0, 0.0, -3.0}};
  }
  void stop(bool is_to_stop) noexcept { is_to_stop_ = is_to_stop; }
  bool is_stopped() const noexcept { return is_stopped_; }

 private:
  std::atomic<bool> is_to_stop_ = false;
  mutable std::atomic<bool> is_stopped_ = false;
};

/// A Falcon, and when it was last given a force.
class NotingDevice final : public Device {
 public:
  NotingDevice(FalconDevice& falcon, LinkClock& clock) noexcept : falcon_(falcon), clock_(clock) {}
  DeviceReading read(double now_s) noexcept override { return falcon_.read(now_s); }
  void write(const Vec3& force_n) noexcept override {
    last_word_s_ = clock_.now_s();
    falcon_.write(force_n);
  }
  void cut() noexcept override { falcon_.cut(); }
  DeviceTraits traits(double period_s) const noexcept override { return falcon_.traits(period_s); }
  double last_word_s() const noexcept { return last_word_s_; }

 private:
  FalconDevice& falcon_;
  LinkClock& clock_;
  std::atomic<double> last_word_s_ = 0.0;
};

/// When the zero words began that are the last it heard.
double zero_since_s(EmulatedFalcon& falcon) {
  return falcon.with([](FalconDsp& dsp, FalconFaults&, double) {
    const std::vector<test::SeenCommand>& seen = dsp.commands();
    const auto last_push = std::find_if_not(
        seen.rbegin(), seen.rend(), [](const test::SeenCommand& one) { return one.is_zero(); });
    return last_push.base()->time_s;
  });
}

/// A servo's thread that pushes.
struct PushingThread {
  PushingThread(EmulatedFalcon& falcon, FalconDevice& opened)
      : emulated(falcon), device(opened), noting(opened, falcon.clock()) {}

  bool pushes() {
    return until([&] { return length(device.look().force_n) > 2.0; });
  }

  /// Of how it is, for one that does not push.
  std::string words() const {
    const auto seen = device.look();
    return "state " + std::to_string(static_cast<int>(seen.state)) + ", fault " +
           std::to_string(static_cast<int>(seen.fault)) + ", attempt " +
           std::to_string(seen.attempt) + ", force " + std::to_string(length(seen.force_n)) + " N";
  }

  /// From the last word of the servo, whose thread is stopped for a while, until the device hears
  /// that there is no force. Not above 0 where a slow machine took the force before.
  double let_go_after_s(bool loses_a_reply) {
    emulated.set_faults([&](FalconFaults& faults) { faults.lost_replies = loses_a_reply ? 1 : 0; });
    scene.stop(true);
    EXPECT_TRUE(until([&] { return scene.is_stopped(); }));
    EXPECT_TRUE(until([&] { return is_last_word_zero(emulated); }));
    const double let_go_s = zero_since_s(emulated) - noting.last_word_s();
    scene.stop(false);
    return let_go_s;
  }

  EmulatedFalcon& emulated;
  FalconDevice& device;
  NotingDevice noting;
  StoppingScene scene;
  Servo servo{noting, scene, {}};
  ServoThread thread{servo};
};

/// A busy machine is late itself, so of some trials the quickest counts: a watchdog that waits for
/// anything is late in all of them.
TEST(FalconThread, LetsGoWithinFiveMillisecondsWhenTheServosThreadIsStopped) {
  EmulatedFalcon falcon(worked_by_hand(), true);
  auto opened = FalconDevice::open({});
  ASSERT_TRUE(opened.ok()) << opened.error().message;
  PushingThread pushing(falcon, *opened.value());
  for (const bool loses_a_reply : {false, true}) {
    double quickest_s = HUGE_VAL;
    for (int n = 0; n < argil::test::effort(3, 20); ++n) {
      ASSERT_TRUE(pushing.pushes()) << pushing.words();
      const double let_go_s = pushing.let_go_after_s(loses_a_reply);
      if (let_go_s > 0.0) quickest_s = std::min(quickest_s, let_go_s);
    }
    EXPECT_LE(quickest_s, 5e-3) << (loses_a_reply ? "a reply was lost" : "");
  }
}

TEST(FalconThread, RefusesABadFirmwareBeforeItTouchesTheDevice) {
  const ScratchFolder folder;
  argil::test::fill(folder / "firmware.bin", "not one");
  EmulatedFalcon falcon({}, true);
  FalconOptions options;
  options.firmware = folder / "firmware.bin";
  const auto opened = FalconDevice::open(options);
  ASSERT_FALSE(opened.ok());
  EXPECT_EQ(opened.error().kind, ErrorKind::bad_input);
  EXPECT_TRUE(
      falcon.with([](FalconDsp& dsp, FalconFaults&, double) { return dsp.commands().empty(); }));
}

TEST(FalconThread, RefusesLimitsThatAreNone) {
  EmulatedFalcon falcon({}, true);
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  for (const double force : {-1.0, 8.1, kNoNumber}) {
    FalconOptions options;
    options.most_force_n = force;
    const auto opened = FalconDevice::open(options);
    ASSERT_FALSE(opened.ok()) << force;
    EXPECT_EQ(opened.error().kind, ErrorKind::bad_input);
  }
  for (const double slew : {0.0, 499.0, 1e6, kNoNumber}) {
    FalconOptions options;
    options.most_slew_n_per_s = slew;
    EXPECT_FALSE(FalconDevice::open(options).ok()) << slew;
  }
  EXPECT_TRUE(
      falcon.with([](FalconDsp& dsp, FalconFaults&, double) { return dsp.commands().empty(); }));
}

TEST(FalconThread, SaysAtOnceThatNoneIsThere) {
  EmulatedFalcon falcon({}, true);
  falcon.unplug();
  const auto opened = FalconDevice::open({});
  ASSERT_FALSE(opened.ok());
  EXPECT_EQ(opened.error().kind, ErrorKind::device);
  EXPECT_NE(opened.error().message.find("0403:cb48"), std::string::npos);
}

TEST(FalconThread, ComesBackAfterItWasUnplugged) {
  EmulatedFalcon falcon(worked_by_hand(), true);
  auto opened = FalconDevice::open({});
  ASSERT_TRUE(opened.ok()) << opened.error().message;
  FalconDevice& device = *opened.value();
  ASSERT_TRUE(until([&] { return device.look().state >= FalconState::unhomed; }));
  falcon.unplug();
  ASSERT_TRUE(until([&] { return device.look().state == FalconState::fault; }));
  EXPECT_EQ(device.look().fault, FalconFault::unplugged);
  EXPECT_FALSE(device.read(0.0).is_ready);
  falcon.plug();
  device.home();
  EXPECT_TRUE(until([&] { return device.look().state == FalconState::active; }));
}

RigOptions on_falcon(const char* scene) {
  RigOptions options;
  options.device = RigDevice::falcon;
  options.scene = scene;
  return options;
}

/// Looked at for a fifth of a second.
bool is_ever_pushed(HapticRig& rig) {
  bool is_pushed = false;
  for (int n = 0; n < 200; ++n) {
    is_pushed = is_pushed || rig.falcon()->force_n != Vec3{};
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return is_pushed;
}

TEST(FalconRig, FeelsASceneOnTheDevice) {
  EmulatedFalcon falcon(worked_by_hand(), true);
  HapticRig rig;
  EXPECT_EQ(rig.falcon(), nullptr);
  RigOptions options = on_falcon("spring");
  options.falcon.calibration.gravity_n = {0.0, 1.5, 0.0};
  const auto started = rig.start(options);
  ASSERT_TRUE(started.ok()) << started.error().message;
  ASSERT_NE(rig.falcon(), nullptr);
  EXPECT_TRUE(until([&] { return rig.falcon()->state == FalconState::active; }));
  EXPECT_TRUE(until([&] { return rig.look().tick.is_ready; }));
  EXPECT_TRUE(until([&] { return length(rig.look().tick.position_mm) > 1.0; }));
  ASSERT_TRUE(until([&] { return length(rig.falcon()->force_n) > 1.0; }));
  rig.halt();
  EXPECT_TRUE(until([&] { return rig.falcon()->force_n == Vec3{}; }));
  EXPECT_FALSE(is_ever_pushed(rig)) << "its weight is not held either";
  rig.resume();
  EXPECT_TRUE(until([&] { return length(rig.falcon()->force_n) > 1.0; }));
  ASSERT_TRUE(rig.stop().ok());
  EXPECT_EQ(rig.falcon(), nullptr);
  EXPECT_TRUE(is_last_word_zero(falcon));
}

TEST(FalconRig, TellsAFaultAndIsHomedAgain) {
  EmulatedFalcon falcon(worked_by_hand(), true);
  HapticRig rig;
  ASSERT_TRUE(rig.start(on_falcon("workspace")).ok());
  ASSERT_TRUE(until([&] { return rig.falcon()->state == FalconState::active; }));
  falcon.set_faults([](FalconFaults& faults) { faults.is_silent = true; });
  ASSERT_TRUE(until([&] { return rig.falcon()->fault == FalconFault::silent; }));
  EXPECT_TRUE(until([&] { return (rig.look().tick.faults & kDeviceLost) != 0; }));
  falcon.set_faults([](FalconFaults& faults) { faults.is_silent = false; });
  rig.home_falcon();
  EXPECT_TRUE(until([&] { return rig.falcon()->state == FalconState::active; }));
}

/// The wire adds to the delay, so less is steady than on the simulated device.
TEST(FalconRig, CouplesDirectlyOnlyWhatIsSteadyOverTheWire) {
  RigOptions options;
  options.coupling = CouplingKind::direct;
  const auto steady_skin_mm = [&](RigDevice device) {
    options.device = device;
    for (options.material.skin_mm = 1.0; !check_rig(options).ok();) options.material.skin_mm += 0.1;
    return options.material.skin_mm;
  };
  const double ratio = steady_skin_mm(RigDevice::falcon) / steady_skin_mm(RigDevice::sim);
  EXPECT_NEAR(ratio, (0.5 + 1.5) / (0.5 + 1.0), 0.05);
}

TEST(FalconRig, CouplesNoSceneDirectlyThatCycles) {
  RigOptions options = on_falcon("wall-rigid");
  for (const char* scene : {"wall-rigid", "sphere", "cylinder", "click"}) {
    options.scene = scene;
    options.coupling = CouplingKind::direct;
    ASSERT_FALSE(check_rig(options).ok()) << scene;
    EXPECT_NE(check_rig(options).error().message.find("couple indirectly"), std::string::npos);
    options.coupling = CouplingKind::indirect;
    EXPECT_TRUE(check_rig(options).ok()) << scene;
  }
  options.coupling = CouplingKind::direct;
  for (const char* scene : {"spring", "free", "wall-linear", "workspace"}) {
    options.scene = scene;
    EXPECT_TRUE(check_rig(options).ok()) << scene;
  }
}

TEST(FalconRig, RefusesAPeriodThatItsWatchdogTakesForAHang) {
  RigOptions options = on_falcon("workspace");
  options.period_s = kFalconMostPeriodS;
  EXPECT_TRUE(check_rig(options).ok());
  options.period_s = 2.5e-3;
  const auto refused = check_rig(options);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("period is 2.5 ms; must be at most 2 ms"),
            std::string::npos)
      << refused.error().message;
  options.device = RigDevice::sim;
  EXPECT_TRUE(check_rig(options).ok());
}

TEST(FalconRig, StartsOverAndGoesBackToTheSimulatedOne) {
  EmulatedFalcon falcon(worked_by_hand(), true);
  HapticRig rig;
  for (int n = 0; n < 3; ++n) {
    const auto started = rig.start(on_falcon("workspace"));
    ASSERT_TRUE(started.ok()) << started.error().message;
  }
  RigOptions sim;
  sim.scene = "workspace";
  ASSERT_TRUE(rig.start(sim).ok());
  EXPECT_EQ(rig.falcon(), nullptr);
  falcon.unplug();
  const auto started = rig.start(on_falcon("workspace"));
  ASSERT_FALSE(started.ok());
  EXPECT_EQ(started.error().kind, ErrorKind::device);
  EXPECT_FALSE(rig.is_running());
  falcon.plug();
  RigOptions wrong = on_falcon("workspace");
  wrong.falcon.most_force_n = 9.0;
  EXPECT_FALSE(rig.start(wrong).ok());
}

}  // namespace
}  // namespace argil::haptics
