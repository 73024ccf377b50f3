// SPDX-License-Identifier: GPL-3.0-or-later
// The real libusb and the emulated device: finding it, taking it, and bytes through it.
#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <thread>

#include <unistd.h>

#include "falcon/driver.h"
#include "falcon/falcon_boot.h"
#include "falcon/falcon_link.h"
#include "falcon/falcon_packet.h"

namespace argil::haptics {
namespace {

using test::Driver;
using test::EmulatedFalcon;
using test::FalconDsp;
using test::FalconFaults;

std::size_t open_files() {
  const std::filesystem::directory_iterator files("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

FalconFault opened(EmulatedFalcon& falcon, const std::string& serial = "") {
  auto link = FalconLink::open(serial, falcon.clock());
  return link ? FalconFault::none : link.error();
}

TEST(FalconLink, IsListedWithItsSerialNumber) {
  EmulatedFalcon falcon;
  const auto attached = attached_falcons();
  ASSERT_TRUE(attached.ok());
  ASSERT_EQ(attached.value().size(), 1U);
  const AttachedFalcon& one = attached.value()[0];
  EXPECT_EQ(one.bus, 1);
  EXPECT_EQ(one.address, 2);
  EXPECT_EQ(one.serial, "EMULATED1");
  EXPECT_EQ(one.obstacle, FalconFault::none);
}

/// As usbfs: a transfer that a link left behind must never reach the one that is opened after it.
TEST(FalconLink, IsGivenBackOnlyWhatItsOwnFileHandedIn) {
  EmulatedFalcon falcon;
  std::array<unsigned char, 8> setup{0x40, 0};  // a reset
  usbdevfs_urb urb{};
  urb.type = USBDEVFS_URB_TYPE_CONTROL;
  urb.buffer = setup.data();
  urb.buffer_length = static_cast<int>(setup.size());
  ASSERT_EQ(falcon.bus().submit(&urb, 1), 0);
  EXPECT_EQ(falcon.bus().reap(2), nullptr);
  EXPECT_EQ(falcon.bus().reap(1), &urb);
  ASSERT_EQ(falcon.bus().submit(&urb, 1), 0);
  falcon.bus().forget(1);
  EXPECT_EQ(falcon.bus().reap(1), nullptr);
}

/// Also what arrived while it was closing: asked for again, it would be written to freed memory.
TEST(FalconLink, LeavesNothingUnderWayWhenItEnds) {
  EmulatedFalcon falcon;
  auto link = FalconLink::open("", falcon.clock());
  ASSERT_TRUE(link.ok());
  EXPECT_EQ(falcon.bus().under_way(), 2U);
  falcon.pass(0.1);  // more packets than it has asked for
  link.value().reset();
  EXPECT_EQ(falcon.bus().under_way(), 0U);
}

TEST(FalconLink, IsNotThereWhenUnplugged) {
  EmulatedFalcon falcon;
  falcon.unplug();
  EXPECT_TRUE(attached_falcons().value().empty());
  EXPECT_EQ(opened(falcon), FalconFault::not_found);
  falcon.plug();
  EXPECT_EQ(opened(falcon), FalconFault::none);
}

TEST(FalconLink, ChoosesBySerialNumber) {
  EmulatedFalcon falcon;
  EXPECT_EQ(opened(falcon, "EMULATED1"), FalconFault::none);
  EXPECT_EQ(opened(falcon, "EMULATED2"), FalconFault::other_serial);
  falcon.set_faults([](FalconFaults& faults) { faults.is_taken = true; });
  EXPECT_EQ(opened(falcon, "EMULATED1"), FalconFault::busy);
  EXPECT_EQ(opened(falcon, "EMULATED2"), FalconFault::other_serial);
  falcon.unplug();
  EXPECT_EQ(opened(falcon, "EMULATED2"), FalconFault::not_found);
}

TEST(FalconLink, TakesItFromADriverOfTheKernelAndGivesItBack) {
  EmulatedFalcon falcon;
  falcon.set_faults([](FalconFaults& faults) { faults.has_driver = true; });
  {
    auto link = FalconLink::open("", falcon.clock());
    ASSERT_TRUE(link.ok());
    EXPECT_FALSE(falcon.bus().has_driver());
  }
  EXPECT_TRUE(falcon.bus().has_driver());
}

TEST(FalconLink, SaysThatAnotherProgramHasIt) {
  EmulatedFalcon falcon;
  falcon.set_faults([](FalconFaults& faults) { faults.is_taken = true; });
  EXPECT_EQ(opened(falcon), FalconFault::busy);
  EXPECT_EQ(attached_falcons().value()[0].obstacle, FalconFault::busy);
}

TEST(FalconLink, SaysThatTheUserMayNot) {
  EmulatedFalcon falcon;
  const std::filesystem::path node = argil::test::UsbTestbed::instance().node_path();
  const uid_t user = ::geteuid();
  // Root may open anything: another user looks, who sees all but the node.
  namespace fs = std::filesystem;
  const fs::path root = argil::test::UsbTestbed::instance().root();
  fs::permissions(root, fs::perms::all);
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_symlink()) fs::permissions(entry, fs::perms::all);
  }
  fs::permissions(node, fs::perms::none);
  constexpr uid_t kNobody = 65534;
  if (user == 0) {
    ASSERT_EQ(::seteuid(kNobody), 0);
  }
  const FalconFault fault = opened(falcon);
  ASSERT_EQ(::seteuid(user), 0);
  EXPECT_EQ(fault, FalconFault::no_permission);
  EXPECT_NE(std::string(falcon_fault_text(fault)).find("udev rule"), std::string::npos);
}

/// Open files, once there are as many for a fifth of a second: what shows the device works in
/// threads of its own, closes its sockets a moment later and makes what it needs at its first work.
std::size_t settled_files() {
  std::size_t files = open_files();
  for (int n = 0, same = 0; n < 1000 && same < 20; ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const std::size_t now = open_files();
    same = now == files ? same + 1 : 0;
    files = now;
  }
  return files;
}

TEST(FalconLink, OpensAThousandTimesAndLosesNoFile) {
  EmulatedFalcon falcon;
  for (int n = 0; n < 20; ++n) EXPECT_EQ(opened(falcon), FalconFault::none);
  const std::size_t before = settled_files();
  for (int n = 0; n < 1000; ++n) {
    auto link = FalconLink::open("", falcon.clock());
    ASSERT_TRUE(link.ok()) << n;
    ASSERT_EQ(enter_run_mode(*link.value(), false), FalconFault::none);
  }
  EXPECT_LE(settled_files(), before);
}

TEST(FalconLink, RefusedRequestsAreAStall) {
  EmulatedFalcon falcon;
  auto link = FalconLink::open("", falcon.clock());
  ASSERT_TRUE(link.ok());
  EXPECT_EQ(link.value()->control({77, 0}), FalconFault::stalled);
  EXPECT_EQ(link.value()->control(kFtdiRunBaud), FalconFault::stalled) << "it stays so";
}

std::vector<FalconReply> exchange(EmulatedFalcon& falcon, int packets) {
  std::vector<FalconReply> replies;
  auto opened_link = FalconLink::open("", falcon.clock());
  FalconLink& link = *opened_link.value();
  EXPECT_EQ(enter_run_mode(link, false), FalconFault::none);
  FalconReplyParser parser;
  for (int n = 0; n < packets; ++n) {
    FalconCommand command;
    command.is_homing = true;
    EXPECT_EQ(link.send(encode(command)), FalconFault::none);
    const double end_s = falcon.clock().now_s() + 1.0;
    const std::size_t wanted = replies.size() + 1;
    while ((replies.size() < wanted || link.is_sending()) && falcon.clock().now_s() < end_s) {
      EXPECT_EQ(link.wait_until(end_s), FalconFault::none);
      for (const std::uint8_t byte : link.received()) {
        if (const auto reply = parser.push(byte)) replies.push_back(*reply);
      }
      link.clear_received();
    }
    if (replies.size() != wanted) break;
  }
  EXPECT_EQ(parser.dropped_bytes(), 0U);
  return replies;
}

TEST(FalconLink, LosesNoneOfTenThousandPacketsHoweverTheyAreSplit) {
  argil::test::DspOptions options;
  options.plan = test::homing_plan();
  EmulatedFalcon falcon(options);
  falcon.set_faults([](FalconFaults& faults) { faults.splits_packets = true; });
  const std::vector<FalconReply> replies = exchange(falcon, 10'000);
  const auto commands =
      falcon.with([](FalconDsp& dsp, FalconFaults&, double) { return dsp.commands(); });
  ASSERT_EQ(replies.size(), 10'000U);
  ASSERT_EQ(commands.size(), 10'000U);
  for (std::size_t n = 0; n < replies.size(); ++n) {
    ASSERT_TRUE(
        std::equal(replies[n].tick.begin(), replies[n].tick.end(), commands[n].tick.begin()))
        << n;
  }
  EXPECT_NE(commands.back().tick, commands.front().tick) << "the grip moved";
}

}  // namespace
}  // namespace argil::haptics
