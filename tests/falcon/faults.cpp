// SPDX-License-Identifier: GPL-3.0-or-later
// Every fault ends in zero force, a message with the remedy, and a state that `home` leaves.
#include <algorithm>
#include <cerrno>
#include <functional>
#include <limits>
#include <string>

#include "argil/haptics/servo/servo.h"

#include "falcon/driver.h"
#include "support/effort.h"

namespace argil::haptics {
namespace {

using test::Driver;
using test::FalconDsp;
using test::FalconFaults;
using test::SeenCommand;

/// Pushes with 3 N wherever the grip is.
class Pusher final : public ForceScene {
 public:
  SceneForce force_at(const HandleState&) const noexcept override { return {{0.0, 0.0, -3.0}}; }
};

struct Case {
  const char* name;
  FalconFault fault;
  std::function<void(Driver&)> happens;
  std::function<void(Driver&)> mends;
  double most_s;         ///< until the driver may know
  bool is_deaf = false;  ///< no word reaches it any more
};

void set(Driver& driver, const std::function<void(FalconFaults&)>& change) {
  driver.falcon.set_faults(change);
}

const std::vector<Case>& cases() {
  const auto nothing = [](Driver&) {};
  const auto heal = [](Driver& driver) { set(driver, [](FalconFaults& f) { f = {}; }); };
  constexpr double kTwoTicksS = 2e-3;
  static const std::vector<Case> all{
      {"unplugged", FalconFault::unplugged, [](Driver& d) { d.falcon.unplug(); },
       [](Driver& d) { d.falcon.plug(); }, kTwoTicksS, true},
      {"stall in", FalconFault::stalled,
       [](Driver& d) { set(d, [](FalconFaults& f) { f.in_error = -EPIPE; }); }, nothing,
       kTwoTicksS},
      {"stall out", FalconFault::stalled,
       [](Driver& d) { set(d, [](FalconFaults& f) { f.out_error = -EPIPE; }); }, nothing,
       kTwoTicksS},
      {"babble", FalconFault::babbled,
       [](Driver& d) { set(d, [](FalconFaults& f) { f.babbles = 1; }); }, nothing, kTwoTicksS},
      {"protocol error", FalconFault::usb_failed,
       [](Driver& d) { set(d, [](FalconFaults& f) { f.in_error = -EPROTO; }); }, heal, kTwoTicksS},
      {"silence", FalconFault::silent,
       [](Driver& d) { set(d, [](FalconFaults& f) { f.is_silent = true; }); }, heal,
       FalconSession::kSilenceS + 2.0 * FalconSession::kReplyS, true},
      {"not a number", FalconFault::force_not_finite,
       [](Driver& d) {
         d.port.write({0.0, std::numeric_limits<double>::quiet_NaN(), 0.0});
       },
       nothing, kTwoTicksS},
      {"infinite", FalconFault::force_not_finite,
       [](Driver& d) {
         d.port.write({std::numeric_limits<double>::infinity(), 0.0, 0.0});
       },
       nothing, kTwoTicksS}};
  return all;
}

/// The servo on the emulated device, pushing.
struct Pushing {
  explicit Pushing(const test::DspOptions& device = test::held_in_the_middle())
      : driver(device), servo(driver.port, scene, {}) {}
  void start() {
    test::make_active(driver);
    for (int n = 0; n < 800; ++n) tick();
    ASSERT_GT(length(last.force_n), 2.5);
    ASSERT_GT(length(driver.true_force_n()), 2.5);
  }
  void tick() {
    driver.time.wait_until(driver.now_s() + 1e-3);
    last = servo.tick(driver.now_s());
  }

  Driver driver;
  Pusher scene;
  Servo servo;
  ServoTick last;
};

TEST(FalconFaults, EachCutsTheForceWithinTwoTicksOfBeingKnown) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    Pushing run;
    run.start();
    const double begin_s = run.driver.now_s();
    one.happens(run.driver);
    while (run.driver.session.state() != FalconState::fault && run.driver.now_s() < 5.0) {
      run.driver.run_for(1e-4);
      if (one.fault != FalconFault::force_not_finite) run.servo.tick(run.driver.now_s());
    }
    EXPECT_EQ(run.driver.session.status().fault, one.fault);
    const double known_s = run.driver.now_s();
    EXPECT_LE(known_s - begin_s, one.most_s + 0.021) << "the last word to a deaf device waits";
    run.tick();
    run.tick();
    EXPECT_EQ(run.last.force_n, Vec3{});
    EXPECT_NE(run.last.faults & kDeviceLost, 0U);
    EXPECT_EQ(run.driver.session.status().word, (std::array<std::int16_t, 3>{}));
    // What the device heard last had no force; what can hear nothing drops it by itself.
    run.driver.run_for(0.05);
    EXPECT_EQ(run.driver.true_force_n(), Vec3{});
  }
}

/// A device that holds its last torque for long: only zero words take it away.
TEST(FalconFaults, EachSendsZeroWordsToADeviceThatHears) {
  for (const Case& one : cases()) {
    if (one.is_deaf) continue;
    SCOPED_TRACE(one.name);
    test::DspOptions device = test::held_in_the_middle();
    device.torque_hold_s = 10.0;
    Pushing run(device);
    run.start();
    ASSERT_FALSE(run.driver.commands().back().is_zero());
    one.happens(run.driver);
    const double begin_s = run.driver.now_s();
    while (run.driver.session.state() != FalconState::fault && run.driver.now_s() < begin_s + 1.0) {
      run.driver.run_for(1e-4);
    }
    run.driver.falcon.pass(1e-3);  // on the line
    EXPECT_EQ(run.driver.session.status().fault, one.fault);
    const SeenCommand last = run.driver.commands().back();
    EXPECT_TRUE(last.is_zero());
    EXPECT_LE(last.time_s - begin_s, 2e-3);
    EXPECT_EQ(run.driver.true_force_n(), Vec3{});
  }
}

/// The last zero words are on their way when reading fails: they arrive, and the end comes.
TEST(FalconFaults, AFailureWhileItClosesNeitherHangsNorKeepsTheForce) {
  for (int n = 0; n < 40; n += argil::test::effort(4, 1)) {
    SCOPED_TRACE(n);
    test::DspOptions device = test::held_in_the_middle();
    device.torque_hold_s = 10.0;
    Driver driver(device);
    test::make_active(driver);
    driver.push_for(0.6, {0.0, 0.0, -3.0});
    driver.run_for(25e-6 * n);
    driver.falcon.at(driver.now_s() + 20e-6,
                     [&] { set(driver, [](FalconFaults& faults) { faults.in_error = -EPROTO; }); });
    const double begin_s = driver.now_s();
    driver.session.close();
    EXPECT_LE(driver.now_s() - begin_s, 2e-3);
    driver.falcon.pass(1e-3);  // on the line
    EXPECT_TRUE(driver.commands().back().is_zero());
  }
}

/// Pushes until it is told to give NaN.
class Breaking final : public ForceScene {
 public:
  SceneForce force_at(const HandleState&) const noexcept override {
    return {{0.0, is_broken ? std::numeric_limits<double>::quiet_NaN() : 0.0, -7.9}};
  }
  bool is_broken = false;
};

/// What cuts the servo's force cuts all of it: within two ticks, at the least slew that is allowed,
/// and the force against the grip's weight as well.
TEST(FalconFaults, WhatCutsTheServosForceLeavesNone) {
  enum class Cut { halt, broken_scene, jumped_clock, stop };
  for (const Cut cut : {Cut::halt, Cut::broken_scene, Cut::jumped_clock, Cut::stop}) {
    SCOPED_TRACE(static_cast<int>(cut));
    FalconOptions options;
    options.calibration.gravity_n = {0.0, 1.5, 0.0};
    options.most_slew_n_per_s = 500.0;
    Driver driver(test::held_in_the_middle(), options);
    test::make_active(driver);
    Breaking scene;
    Servo servo(driver.port, scene, {});
    const auto tick = [&](double late_s = 0.0) {
      driver.time.wait_until(driver.now_s() + 1e-3);
      return servo.tick(driver.now_s() + late_s);
    };
    for (int n = 0; n < 1500; ++n) tick();
    ASSERT_GT(length(driver.true_force_n()), 7.0);
    if (cut == Cut::halt) servo.halt();
    scene.is_broken = cut == Cut::broken_scene;
    if (cut == Cut::stop) {
      servo.stop();
    } else {
      EXPECT_NE(tick(cut == Cut::jumped_clock ? 1.0 : 0.0).faults & kCutFaults, 0U);
    }
    driver.run_for(2e-3);
    EXPECT_EQ(driver.true_force_n(), Vec3{});
    if (cut == Cut::jumped_clock) continue;
    for (int n = 0; n < 500; ++n) {
      if (cut != Cut::stop) tick();
      driver.run_for(1e-3);
      ASSERT_EQ(driver.true_force_n(), Vec3{}) << n;
    }
  }
}

TEST(FalconFaults, HomeLeavesEach) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    Pushing run;
    run.start();
    one.happens(run.driver);
    for (int n = 0; n < 200; ++n) {
      run.driver.run_for(1e-3);
      if (run.driver.session.state() == FalconState::fault) break;
      if (one.fault != FalconFault::force_not_finite) run.servo.tick(run.driver.now_s());
    }
    ASSERT_EQ(run.driver.session.state(), FalconState::fault);
    one.mends(run.driver);
    ASSERT_EQ(run.driver.session.home(), FalconFault::none);
    for (int n = 0; n < 100; ++n) run.tick();
    EXPECT_EQ(run.driver.session.state(), FalconState::unhomed) << "to be pulled out once more";
    EXPECT_EQ(run.last.force_n, Vec3{});
    EXPECT_EQ(run.driver.session.status().fault, FalconFault::none);
  }
}

TEST(FalconFaults, SilenceTakesTheForceLongBeforeItIsAFault) {
  Pushing run;
  run.start();
  set(run.driver, [](FalconFaults& faults) { faults.is_silent = true; });
  for (int n = 0; n < 18; ++n) run.tick();
  EXPECT_EQ(run.last.force_n, Vec3{});
  EXPECT_EQ(run.driver.session.status().word, (std::array<std::int16_t, 3>{}));
  EXPECT_EQ(run.driver.session.state(), FalconState::active);
}

/// Unplugged in every state, and plugged in again.
TEST(FalconFaults, UnpluggedInEveryStateItComesBack) {
  const auto comes_back = [](Driver& driver) {
    driver.run_for(0.01);
    EXPECT_EQ(driver.session.status().fault, FalconFault::unplugged);
    EXPECT_NE(driver.session.home(), FalconFault::none) << "nothing is there";
    driver.falcon.plug();
    EXPECT_EQ(driver.session.home(), FalconFault::none);
    EXPECT_EQ(driver.session.state(), FalconState::unhomed);
  };
  {
    Driver closed;
    closed.falcon.unplug();
    EXPECT_EQ(closed.start(), FalconFault::not_found);
    closed.falcon.plug();
    EXPECT_EQ(closed.session.home(), FalconFault::none);
  }
  {
    Driver unhomed;
    ASSERT_EQ(unhomed.start(), FalconFault::none);
    unhomed.falcon.unplug();
    comes_back(unhomed);
  }
  {
    Driver active(test::held_in_the_middle());
    test::make_active(active);
    active.falcon.unplug();
    comes_back(active);
    active.falcon.unplug();
    comes_back(active);
  }
}

TEST(FalconFaults, EveryMessageNamesARemedy) {
  const std::string remedies[] = {
      "check", "plug", "run 'argil falcon", "install", "end it", "name the file", "report", "pass"};
  for (int n = 1; n < kFalconFaults; ++n) {
    const Error error = falcon_error(static_cast<FalconFault>(n));
    const std::string after =
        error.message.substr(std::min(error.message.find(';'), error.message.size()));
    EXPECT_EQ(error.kind, ErrorKind::device);
    bool has_remedy = false;
    for (const std::string& remedy : remedies) {
      has_remedy = has_remedy || after.find(remedy) != std::string::npos;
    }
    EXPECT_TRUE(has_remedy) << error.message;
  }
}

}  // namespace
}  // namespace argil::haptics
