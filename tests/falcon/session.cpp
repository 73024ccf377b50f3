// SPDX-License-Identifier: GPL-3.0-or-later
// Homing and safety: what the driver lets through, and when.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "argil/haptics/servo/velocity_filter.h"

#include "falcon/driver.h"

namespace argil::haptics {
namespace {

using test::Driver;
using test::FalconDsp;
using test::FalconFaults;
using test::SeenCommand;

constexpr Vec3 kPush{1.0, 0.5, -2.0};
constexpr unsigned kHomingFlag = 1;
constexpr unsigned kGreen = 2;
constexpr unsigned kBlue = 4;
constexpr unsigned kRed = 8;

TEST(FalconSession, TellsHomingByItsLights) {
  Driver driver(test::held_in_the_middle());
  ASSERT_EQ(driver.start(), FalconFault::none);
  driver.run_for(3.0);
  unsigned before = 0;
  std::vector<unsigned> lights;
  for (const SeenCommand& seen : driver.commands()) {
    EXPECT_NE(seen.flags & kHomingFlag, 0U);
    if ((seen.flags & ~kHomingFlag) != before) lights.push_back(seen.flags & ~kHomingFlag);
    before = seen.flags & ~kHomingFlag;
  }
  EXPECT_EQ(lights, (std::vector<unsigned>{kRed, kBlue, kGreen}));
}

/// Of a grip that is pushed and pulled all the while.
TEST(FalconSession, GivesNoForceBeforeItIsHomedAndWasPulledOut) {
  Driver driver(test::held_in_the_middle());
  ASSERT_EQ(driver.start(), FalconFault::none);
  driver.push_for(3.0, kPush);
  ASSERT_EQ(driver.session.state(), FalconState::active);
  bool was_green = false;
  bool has_pushed = false;
  for (const SeenCommand& seen : driver.commands()) {
    was_green = was_green || (seen.flags & kGreen) != 0;
    if (!was_green) {
      ASSERT_TRUE(seen.is_zero()) << seen.time_s;
    }
    has_pushed = has_pushed || !seen.is_zero();
  }
  EXPECT_TRUE(has_pushed);
}

TEST(FalconSession, StaysUnhomedAndWithoutForceWhileNobodyPullsIt) {
  for (const bool is_homed : {false, true}) {
    test::DspOptions options;
    options.is_homed = is_homed;
    Driver driver(options);
    ASSERT_EQ(driver.start(), FalconFault::none);
    driver.push_for(2.0, kPush);
    EXPECT_EQ(driver.session.state(), FalconState::unhomed);
    EXPECT_EQ(driver.session.status().is_homed[0], is_homed);
    for (const SeenCommand& seen : driver.commands()) ASSERT_TRUE(seen.is_zero());
  }
}

TEST(FalconSession, KnowsWhereTheGripIs) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  const DeviceReading reading = driver.port.read(driver.now_s());
  EXPECT_TRUE(reading.is_ready);
  EXPECT_LT(length(reading.position_mm - driver.true_place_mm()), 0.06);
}

/// The counts jump when an arm passes its index; what the servo takes for velocity must not.
TEST(FalconSession, HomingMakesNoSpikeOfVelocity) {
  Driver driver(test::held_in_the_middle());
  ASSERT_EQ(driver.start(), FalconFault::none);
  VelocityFilter velocity(VelocityFilter::kUsualLagS);
  double fastest = 0.0;
  bool was_ready = false;
  int largest_jump = 0;
  for (std::array<std::int16_t, 3> last{}; driver.now_s() < 4.0;) {
    driver.run_for(1e-3);
    const DeviceReading reading = driver.port.read(driver.now_s());
    for (std::size_t leg = 0; leg < 3; ++leg) {
      const int tick = driver.session.status().tick[leg];
      largest_jump = std::max(largest_jump, std::abs(tick - last[leg]));
      last[leg] = static_cast<std::int16_t>(tick);
    }
    if (!reading.is_ready) {
      velocity.reset();
      continue;
    }
    was_ready = true;
    fastest = std::max(fastest, length(velocity.velocity(reading.position_mm, 1e-3)));
  }
  ASSERT_TRUE(was_ready);
  EXPECT_GT(largest_jump, 300);  // the test has what it is about
  EXPECT_LT(fastest, 400.0);     // the hand moves at 200 mm/s
}

TEST(FalconSession, GivesTheForceThatTheServoAsksFor) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  driver.push_for(1.0, kPush);
  EXPECT_LT(length(driver.true_force_n() - kPush), 0.004 * 1.0 + 0.02);
}

TEST(FalconSession, GivesAllOfItAtTheLongestPeriodThatIsAllowed) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  driver.push_for(1.0, kPush, kFalconMostPeriodS);
  EXPECT_LT(length(driver.true_force_n() - kPush), 0.004 * 1.0 + 0.02);
}

TEST(FalconSession, LimitsSizeAndKeepsTheDirection) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  driver.push_for(0.8, {0.0, 0.0, -30.0});
  const Vec3 force = driver.true_force_n();
  EXPECT_NEAR(length(force), 8.0, 0.05);
  EXPECT_NEAR(force.z, -8.0, 0.05);
}

TEST(FalconSession, ForceGrowsNoFasterThanItsSlew) {
  FalconOptions options;
  options.most_slew_n_per_s = 100.0;
  Driver driver(test::held_in_the_middle(), options);
  test::make_active(driver);
  driver.push_for(0.6, {});
  Vec3 last = driver.session.status().force_n;
  for (int n = 0; n < 100; ++n) {
    driver.push_for(1e-3, kPush);
    const Vec3 now = driver.session.status().force_n;
    EXPECT_LE(length(now - last), 100.0 * 3e-3);
    last = now;
  }
  EXPECT_GT(length(last), 1.0);
}

TEST(FalconSession, AServoThatHangsIsForgottenInFiveMilliseconds) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  driver.push_for(1.0, kPush);
  ASSERT_GT(length(driver.session.status().force_n), 2.0);
  driver.run_for(0.005);
  EXPECT_EQ(driver.session.status().force_n, Vec3{});
  EXPECT_EQ(driver.true_force_n(), Vec3{}) << "of the motors too";
  driver.run_for(0.1);
  EXPECT_EQ(driver.session.status().force_n, Vec3{});
  driver.push_for(1.0, kPush);
  EXPECT_GT(length(driver.session.status().force_n), 2.0) << "and it comes back";
}

/// What libusb may wait for too long on the machine's time is left for it.
constexpr double kMostLetGoS = 4e-3;

/// From the servo's last word until the device hears that there is no force.
double let_go_after_s(Driver& driver, double last_word_s) {
  driver.run_for(0.05);
  const std::vector<SeenCommand> seen = driver.commands();
  const auto last_push = std::find_if_not(seen.rbegin(), seen.rend(),
                                          [](const SeenCommand& one) { return one.is_zero(); });
  return last_push.base()->time_s - last_word_s;
}

TEST(FalconSession, AServoThatHangsIsForgottenWhateverIsUnderWay) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  for (int n = 0; n < 10; ++n) {
    SCOPED_TRACE(n);
    driver.push_for(1.0, kPush);
    driver.run_for(1e-4 * n);  // of the exchange
    ASSERT_GT(length(driver.session.status().force_n), 2.0);
    driver.port.write(kPush);
    EXPECT_LE(let_go_after_s(driver, driver.now_s()), kMostLetGoS);
  }
  EXPECT_EQ(driver.session.status().lost_replies, 0U) << "who sends before a reply counts both";
}

/// That a reply is lost is known after 15 ms only, and the motors hold what they were told.
TEST(FalconSession, AServoThatHangsIsForgottenThoughAReplyIsLost) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  for (int ms = 0; ms < 15; ++ms) {
    SCOPED_TRACE(ms);
    driver.push_for(1.0, kPush);
    ASSERT_GT(length(driver.session.status().force_n), 2.0);
    driver.falcon.set_faults([](FalconFaults& faults) { faults.lost_replies = 1; });
    driver.push_for(1e-3 * ms, kPush);
    driver.port.write(kPush);
    const double let_go_s = let_go_after_s(driver, driver.now_s());
    EXPECT_GT(let_go_s, 0.0) << "it still pushed";
    EXPECT_LE(let_go_s, kMostLetGoS);
    EXPECT_EQ(driver.session.status().lost_replies, static_cast<std::uint64_t>(ms) + 1);
  }
}

/// Before it forgets what may yet come, which takes milliseconds.
TEST(FalconSession, ALostReplyTakesTheForceAsSoonAsItIsKnown) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  driver.push_for(1.0, kPush);
  const std::size_t lost = driver.commands().size();
  driver.falcon.set_faults([](FalconFaults& faults) { faults.lost_replies = 1; });
  driver.push_for(FalconSession::kReplyS + 5e-3, kPush);
  const std::vector<SeenCommand> seen = driver.commands();
  ASSERT_GT(seen.size(), lost + 1);
  EXPECT_FALSE(seen[lost].is_zero());
  EXPECT_TRUE(seen[lost + 1].is_zero());
  EXPECT_NEAR(seen[lost + 1].time_s - seen[lost].time_s, FalconSession::kReplyS, 5e-4);
}

/// A tick that is late by little more than its period makes no thud: the force is weakened, and
/// back within some more, never by a step.
TEST(FalconSession, AServoThatSlipsIsWeakenedForAMoment) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  driver.push_for(1.0, kPush);
  const double before = length(driver.session.status().force_n);
  driver.run_for(0.0025);
  const double weakened = length(driver.session.status().force_n);
  EXPECT_LT(weakened, before);
  double last = weakened;
  for (int ms = 0; ms < 30; ++ms) {
    driver.push_for(1e-3, kPush);
    const double now = length(driver.session.status().force_n);
    EXPECT_GE(now, last - 1e-9);
    EXPECT_LE(now, last + 2.0) << "no faster than the gate";
    last = now;
  }
  EXPECT_NEAR(last, before, 1e-6);
}

TEST(FalconSession, HoldsTheGripAgainstItsWeightWhileTheServoRuns) {
  FalconOptions options;
  options.calibration.gravity_n = {0.0, 1.5, 0.0};
  Driver driver(test::held_in_the_middle(), options);
  test::make_active(driver);
  driver.run_for(0.1);
  EXPECT_EQ(driver.session.status().word, (std::array<std::int16_t, 3>{}));
  driver.push_for(1.0, {});
  EXPECT_NEAR(driver.true_force_n().y, 1.5, 0.01);
  driver.port.cut();
  driver.run_for(2e-3);
  EXPECT_EQ(driver.true_force_n(), Vec3{});
}

TEST(FalconSession, LosingTheHomingTakesTheForceAndAsksToPullOutAgain) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  driver.push_for(1.0, kPush);
  driver.falcon.with([](FalconDsp& dsp, FalconFaults&, double) { dsp.forget_homing(); });
  driver.push_for(2e-3 + 1e-3, kPush);
  EXPECT_EQ(driver.session.state(), FalconState::unhomed);
  EXPECT_FALSE(driver.session.status().is_pulled_out);
  EXPECT_FALSE(driver.port.read(driver.now_s()).is_ready);
  EXPECT_EQ(driver.session.status().word, (std::array<std::int16_t, 3>{}));
}

/// A damaged byte may still be a letter: the position that it gives is not believed.
TEST(FalconSession, AJumpThatNoHandMakesTakesTheForceForAWhile) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  for (const int ticks : {4096, -4096, 200, -200}) {
    SCOPED_TRACE(ticks);
    driver.push_for(1.0, kPush);
    driver.falcon.set_faults([&](FalconFaults& faults) {
      faults.jumped_replies = 1;
      faults.jump_ticks = ticks;
    });
    driver.push_for(4e-3, kPush);
    EXPECT_EQ(driver.session.status().word, (std::array<std::int16_t, 3>{}));
    EXPECT_FALSE(driver.port.read(driver.now_s()).is_ready);
    EXPECT_EQ(driver.session.state(), FalconState::active);
    driver.push_for(1.0, kPush);
    EXPECT_GT(length(driver.session.status().force_n), 2.0);
  }
}

/// The hand goes 30 mm while the Falcon's own thread does not run.
TEST(FalconSession, AThreadThatWasHeldUpTakesTheForceAndMakesNoSpikeOfVelocity) {
  test::DspOptions device = test::held_in_the_middle();
  for (const auto& [time_s, x_mm] : {std::pair{4.0, 0.0}, {4.06, 30.0}}) {
    HandKey key = device.plan.back();
    key.time_s = time_s;
    key.place_mm.x = x_mm;
    device.plan.push_back(key);
  }
  Driver driver(device);
  test::make_active(driver);
  driver.push_for(1.0, kPush);
  const Vec3 before_mm = driver.port.read(driver.now_s()).position_mm;
  driver.falcon.pass(0.07);
  driver.push_for(1e-3, kPush);
  const DeviceReading after = driver.port.read(driver.now_s());
  ASSERT_GT(length(after.position_mm - before_mm), 5.0);
  EXPECT_FALSE(after.is_ready);
  EXPECT_EQ(driver.session.status().word, (std::array<std::int16_t, 3>{}));
  driver.push_for(FalconSession::kSettleS + 5e-3, kPush);
  EXPECT_TRUE(driver.port.read(driver.now_s()).is_ready) << "it comes back";
}

/// The gate counts no more time than an exchange takes.
TEST(FalconSession, AThreadThatWasHeldUpForLessMakesNoStepOfForce) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  driver.push_for(1.0, {});
  driver.falcon.pass(0.014);
  driver.port.write({0.0, 0.0, -8.0});
  const auto before = driver.commands().size();
  while (driver.commands().size() == before) driver.run_for(1e-4);
  EXPECT_LE(length(driver.session.status().force_n), 2000.0 * 3e-3 + 1e-9);
}

/// Each reply that is taken belongs to the packet before it: who comes late is left out.
TEST(FalconSession, ALateReplyIsNotTakenForThatToTheNextPacket) {
  for (int n = 147; n < 156; ++n) {
    const double late_s = n * 1e-4;
    SCOPED_TRACE(late_s);
    Driver driver;
    ASSERT_EQ(driver.start(), FalconFault::none);
    driver.run_for(0.1);
    driver.falcon.set_faults([&](FalconFaults& faults) {
      faults.late_replies = 1;
      faults.late_s = late_s;
    });
    driver.run_for(0.1);
    const auto replies = driver.session.status().replies;
    while (driver.session.status().replies == replies) driver.run_for(25e-6);
    EXPECT_EQ(driver.session.status().lost_replies, 1U);
    EXPECT_EQ(driver.commands().size() - driver.session.status().replies, 1U);
  }
}

TEST(FalconSession, AfterAnExceptionItHasNoForceAndHomeLeavesThat) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  driver.push_for(1.0, kPush);
  driver.session.give_up();
  driver.falcon.pass(1e-3);  // on the line
  EXPECT_TRUE(driver.commands().back().is_zero());
  EXPECT_EQ(driver.session.status().fault, FalconFault::internal);
  EXPECT_EQ(driver.session.home(), FalconFault::none);
}

TEST(FalconSession, AReplyThatIsShortOrLostCostsTheForceForAMoment) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  driver.push_for(1.0, kPush);
  for (const bool is_short : {true, false}) {
    driver.falcon.set_faults(
        [&](FalconFaults& faults) { (is_short ? faults.short_replies : faults.lost_replies) = 1; });
    driver.push_for(FalconSession::kReplyS + 4e-3, kPush);
    EXPECT_FALSE(driver.port.read(driver.now_s()).is_ready);
    EXPECT_EQ(driver.session.status().word, (std::array<std::int16_t, 3>{}));
    driver.push_for(1.0, kPush);
    EXPECT_EQ(driver.session.state(), FalconState::active);
    EXPECT_GT(length(driver.session.status().force_n), 2.0);
  }
  EXPECT_EQ(driver.session.status().lost_replies, 2U);
  EXPECT_EQ(driver.session.status().dropped_bytes, 14U);
}

TEST(FalconSession, TellsThatTheSerialLineMadeAnError) {
  Driver driver;
  ASSERT_EQ(driver.start(), FalconFault::none);
  EXPECT_FALSE(driver.session.status().has_line_error);
  driver.falcon.set_faults([](FalconFaults& faults) { faults.has_line_error = true; });
  driver.run_for(0.01);
  EXPECT_TRUE(driver.session.status().has_line_error);
}

TEST(FalconSession, ZeroWordsAreTheFirstAndTheLast) {
  Driver driver(test::held_in_the_middle());
  test::make_active(driver);
  driver.push_for(1.0, kPush);
  ASSERT_FALSE(driver.commands().back().is_zero());
  driver.session.close();
  driver.falcon.pass(1e-3);  // on the line
  EXPECT_TRUE(driver.commands().front().is_zero());
  EXPECT_TRUE(driver.commands().back().is_zero());
  EXPECT_FALSE(driver.port.read(driver.now_s()).is_ready);
}

TEST(FalconSession, ZeroWordsAreTheLastWhenAnExceptionEndsIt) {
  test::EmulatedFalcon falcon(test::held_in_the_middle());
  FalconMailbox mailbox;
  FalconPort port(mailbox, falcon.clock(), 0.4589, 3.0, 8.0);
  try {
    FalconSession session({}, std::nullopt, falcon.clock(), mailbox);
    ASSERT_EQ(session.open(), FalconFault::none);
    ASSERT_EQ(session.connect(), FalconFault::none);
    while (falcon.clock().now_s() < 4.0) {
      port.write(kPush);
      session.run_until(falcon.clock().now_s() + 1e-3);
    }
    ASSERT_GT(length(session.status().force_n), 2.0);
    throw std::runtime_error("anything");
  } catch (const std::runtime_error&) {
  }
  falcon.pass(1e-3);  // on the line
  const auto commands =
      falcon.with([](FalconDsp& dsp, FalconFaults&, double) { return dsp.commands(); });
  EXPECT_TRUE(commands.back().is_zero());
  EXPECT_FALSE(std::prev(commands.end(), 3)->is_zero());
}

TEST(FalconSession, ExchangesAThousandTimesASecondByTheLatencyTimer) {
  for (const bool flushes : {false, true}) {
    FalconOptions options;
    options.flushes_at_packet_end = flushes;
    Driver driver(test::held_in_the_middle(), options);
    ASSERT_EQ(driver.start(), FalconFault::none);
    const auto before = driver.session.status().replies;
    driver.run_for(1.0);
    const auto rate = static_cast<double>(driver.session.status().replies - before);
    // By the timer one in each millisecond; with each reply sent at once the line alone counts.
    EXPECT_NEAR(rate, flushes ? 2900.0 : 1000.0, flushes ? 150.0 : 20.0);
    EXPECT_NEAR(driver.session.status().round_trip_s, 1.0 / rate, 0.2 / rate);
  }
}

TEST(FalconSession, TheLargeButtonOfItsGripIsTheOneThatWorksTheClay) {
  for (const bool is_pressed : {false, true}) {
    test::DspOptions options = test::held_in_the_middle();
    options.plan.back().is_active = is_pressed;
    test::Driver driver(options);
    test::make_active(driver);
    EXPECT_EQ(driver.session.status().buttons, is_pressed ? 4U : 0U);
    EXPECT_EQ(driver.port.read(driver.now_s()).buttons, is_pressed ? 1U : 0U);
  }
}

}  // namespace
}  // namespace argil::haptics
