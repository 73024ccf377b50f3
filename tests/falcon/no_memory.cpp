// SPDX-License-Identifier: GPL-3.0-or-later
// The device's thread without memory.
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <new>
#include <thread>

#include "argil/haptics/falcon/falcon_device.h"

#include "falcon/driver.h"

namespace {

std::atomic<bool> g_is_scarce = false;
const std::thread::id kMainThread = std::this_thread::get_id();

}  // namespace

// Whoever is not the test itself gets no memory while it is scarce. Not inlined, or GCC takes one
// half of the pair for a mismatch of the other. All of them, since a sanitizer has its own of those
// left out.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  const bool is_refused = g_is_scarce && std::this_thread::get_id() != kMainThread;
  return is_refused ? nullptr : std::malloc(size > 0 ? size : 1);
}
[[gnu::noinline]] void* operator new(std::size_t size) {
  void* memory = operator new(size, std::nothrow);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory, const std::nothrow_t&) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace argil::haptics {
namespace {

bool comes_to(FalconDevice& device, FalconState state, FalconFault fault) {
  for (int n = 0; n < 20'000; ++n) {
    if (device.look().state == state && device.look().fault == fault) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

TEST(FalconThread, WithoutMemoryItHasAFaultAndServesHomeAfterwards) {
  test::EmulatedFalcon falcon({}, true);
  auto opened = FalconDevice::open({});
  ASSERT_TRUE(opened.ok()) << opened.error().message;
  FalconDevice& device = *opened.value();
  ASSERT_TRUE(comes_to(device, FalconState::unhomed, FalconFault::none));
  falcon.unplug();  // also its emulator is idle then
  ASSERT_TRUE(comes_to(device, FalconState::fault, FalconFault::unplugged));
  g_is_scarce = true;
  device.home();
  EXPECT_TRUE(comes_to(device, FalconState::fault, FalconFault::internal));
  g_is_scarce = false;
  falcon.plug();
  device.home();
  EXPECT_TRUE(comes_to(device, FalconState::unhomed, FalconFault::none));
}

}  // namespace
}  // namespace argil::haptics
