// SPDX-License-Identifier: GPL-3.0-or-later
// Starting the firmware, through the real libusb, with everything that goes wrong on the way.
#include <functional>

#include "falcon/driver.h"

namespace argil::haptics {
namespace {

using test::Driver;
using test::FalconDsp;
using test::FalconFaults;

std::vector<std::uint8_t> uploaded(Driver& driver) {
  return driver.falcon.with([](FalconDsp& dsp, FalconFaults&, double) { return dsp.uploaded(); });
}
int uploads(Driver& driver) {
  return driver.falcon.with([](FalconDsp& dsp, FalconFaults&, double) { return dsp.uploads(); });
}

/// Starts a device that was powered up, with these faults; how many attempts it took.
int attempts_with(const std::function<void(FalconFaults&)>& faults) {
  Driver driver(test::powered_up(), {}, test::firmware());
  driver.falcon.set_faults(faults);
  EXPECT_EQ(driver.start(), FalconFault::none);
  EXPECT_EQ(driver.session.state(), FalconState::unhomed);
  EXPECT_EQ(uploaded(driver), test::synthetic_firmware());
  return driver.session.status().attempt;
}

FalconFault failure_with(const std::function<void(FalconFaults&)>& faults,
                         std::optional<FalconFirmware> image) {
  Driver driver(test::powered_up(), {}, std::move(image));
  driver.falcon.set_faults(faults);
  const FalconFault fault = driver.start();
  EXPECT_EQ(driver.session.state(), FalconState::fault);
  EXPECT_EQ(driver.session.status().fault, fault);
  return fault;
}

TEST(FalconBoot, SendsTheFirmwareByteForByteInASecondOrTwo) {
  Driver driver(test::powered_up(), {}, test::firmware());
  const double begin_s = driver.now_s();
  ASSERT_EQ(driver.start(), FalconFault::none);
  EXPECT_EQ(driver.session.status().attempt, 1);
  EXPECT_EQ(driver.session.status().uploaded, 1.0);
  EXPECT_EQ(uploaded(driver), test::synthetic_firmware());
  EXPECT_LT(driver.now_s() - begin_s, 2.0);
}

/// The requests in the order that is known to work (docs/theory.md, "Falcon", wire).
TEST(FalconBoot, SetsTheChipUpInTheOrderOfTheProtocol) {
  using argil::test::VendorRequest;
  const std::vector<VendorRequest> run{{0, 1}, {0, 2}, {9, 1}, {3, 0x0002}, {0, 1}, {0, 2}};
  const std::vector<VendorRequest> boot{{0, 1},      {0, 2}, {9, 16},     {3, 0x4138},
                                        {4, 8},      {2, 0}, {1, 0x0200}, {1, 0x0100},
                                        {1, 0x0101}, {0, 1}, {1, 0x0100}, {3, 0x0015}};
  {
    Driver loaded;
    ASSERT_EQ(loaded.start(), FalconFault::none);
    EXPECT_EQ(loaded.falcon.bus().requests(), run);
  }
  Driver powered(test::powered_up(), {}, test::firmware());
  ASSERT_EQ(powered.start(), FalconFault::none);
  std::vector<VendorRequest> all;
  for (const auto* part : {&run, &boot, &run}) {
    for (const VendorRequest& one : *part) all.push_back(one);
  }
  EXPECT_EQ(powered.falcon.bus().requests(), all);
}

TEST(FalconBoot, SeesThatTheFirmwareRunsAlready) {
  Driver driver({}, {}, test::firmware());
  ASSERT_EQ(driver.start(), FalconFault::none);
  EXPECT_EQ(driver.session.status().attempt, 0);
  EXPECT_EQ(uploads(driver), 0);
}

TEST(FalconBoot, OneLostReplyDoesNotMakeItSendTheFirmwareAgain) {
  Driver driver({}, {}, test::firmware());
  driver.falcon.set_faults([](FalconFaults& faults) { faults.lost_replies = 5; });
  ASSERT_EQ(driver.start(), FalconFault::none);
  EXPECT_EQ(uploads(driver), 0);
}

TEST(FalconBoot, WaitsUntilATransferHasEndedWhoseAnswerCameBefore) {
  EXPECT_EQ(attempts_with([](FalconFaults& faults) { faults.out_late_s = 3e-3; }), 1);
}

TEST(FalconBoot, SendsItOnceForEachPowerUp) {
  Driver driver(test::powered_up(), {}, test::firmware());
  ASSERT_EQ(driver.start(), FalconFault::none);
  driver.session.close();
  ASSERT_EQ(driver.start(), FalconFault::none);
  EXPECT_EQ(uploads(driver), 1);
}

TEST(FalconBoot, AcceptsAZeroBeforeTheGreetingAndAsksAgain) {
  EXPECT_EQ(attempts_with([](FalconFaults& f) { f.has_zero_before_greeting = true; }), 1);
  EXPECT_EQ(attempts_with([](FalconFaults& f) { f.ignored_greetings = 3; }), 1);
}

TEST(FalconBoot, TriesAgainAfterADamagedEcho) {
  EXPECT_EQ(attempts_with([](FalconFaults& f) { f.corrupted_uploads = 1; }), 2);
  EXPECT_EQ(attempts_with([](FalconFaults& f) { f.lossy_uploads = 2; }), 3);
  EXPECT_EQ(attempts_with([](FalconFaults& f) { f.prefixed_uploads = 1; }), 2);
  EXPECT_EQ(attempts_with([](FalconFaults& f) {
              f.corrupted_uploads = f.lossy_uploads = f.prefixed_uploads = 2;
              f.ignored_greetings = 4;
            }),
            7);
  EXPECT_EQ(attempts_with([](FalconFaults& f) { f.splits_packets = true; }), 1);
}

TEST(FalconBoot, GivesUpAfterTenAttemptsAndSaysWhatToDo) {
  EXPECT_EQ(failure_with([](FalconFaults& f) { f.corrupted_uploads = 99; }, test::firmware()),
            FalconFault::bad_echo);
  EXPECT_EQ(failure_with([](FalconFaults& f) { f.lossy_uploads = 99; }, test::firmware()),
            FalconFault::bad_echo);
  EXPECT_EQ(failure_with([](FalconFaults& f) { f.ignored_greetings = 9999; }, test::firmware()),
            FalconFault::no_greeting);
  EXPECT_EQ(failure_with([](FalconFaults& f) { f.never_starts = true; }, test::firmware()),
            FalconFault::not_started);
  EXPECT_EQ(failure_with([](FalconFaults& f) { f.control_error = -EPIPE; }, test::firmware()),
            FalconFault::stalled);
  EXPECT_EQ(failure_with([](FalconFaults&) {}, std::nullopt), FalconFault::no_firmware);
}

TEST(FalconBoot, UnpluggedAtAnyTimeItSaysSo) {
  for (const double at_s : {0.01, 0.3, 0.55, 0.7, 1.0, 1.3}) {
    Driver driver(test::powered_up(), {}, test::firmware());
    bool is_gone = false;
    driver.falcon.at(at_s, [&] {
      driver.falcon.unplug();
      is_gone = true;
    });
    const FalconFault fault = driver.start();
    ASSERT_TRUE(is_gone) << at_s;
    EXPECT_EQ(fault, FalconFault::unplugged) << at_s;
    driver.falcon.plug();
    EXPECT_EQ(driver.session.home(), FalconFault::none) << at_s;
    EXPECT_EQ(driver.session.state(), FalconState::unhomed) << at_s;
  }
}

TEST(FalconBoot, EndsSoonWhenItIsToldTo) {
  Driver driver(test::powered_up(), {}, test::firmware());
  driver.falcon.at(0.7, [&] { driver.session.stop(); });
  driver.start();
  EXPECT_LT(driver.now_s(), 0.8);
  driver.session.close();
  EXPECT_EQ(driver.session.state(), FalconState::closed);
}

}  // namespace
}  // namespace argil::haptics
