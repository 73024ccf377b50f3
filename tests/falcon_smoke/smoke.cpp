// SPDX-License-Identifier: GPL-3.0-or-later
// The driver on an emulated device whose calls umockdev hands over: nothing of ours stands between
// the driver, libusb and the C library.
#include <chrono>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

#include "falcon/driver.h"
#include "support/falcon_emulator/umockdev_handler.h"
#include "support/scratch.h"

namespace argil::haptics {
namespace {

bool until(const std::function<bool()>& is_so) {
  for (int n = 0; n < 20'000; ++n) {
    if (is_so()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

TEST(FalconSmoke, StartsExchangesAndNoticesThatItIsUnplugged) {
  const argil::test::ScratchFolder folder;
  const auto bytes = test::synthetic_firmware();
  argil::test::fill(folder / "firmware.bin", std::string(bytes.begin(), bytes.end()));
  test::EmulatedFalcon falcon(test::powered_up(), true);
  const argil::test::UmockdevHandler handler(falcon.bus());
  FalconOptions options;
  options.firmware = folder / "firmware.bin";
  auto opened = FalconDevice::open(options);
  ASSERT_TRUE(opened.ok()) << opened.error().message;
  FalconDevice& device = *opened.value();
  ASSERT_TRUE(until([&] { return device.look().state == FalconState::unhomed; }));
  EXPECT_GE(device.look().attempt, 1);
  EXPECT_TRUE(until([&] { return device.look().replies > 200; }));
  EXPECT_EQ(device.look().dropped_bytes, 0U);
  falcon.unplug();
  EXPECT_TRUE(until([&] { return device.look().state == FalconState::fault; }));
}

}  // namespace
}  // namespace argil::haptics
