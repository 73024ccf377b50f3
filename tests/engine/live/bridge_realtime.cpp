// SPDX-License-Identifier: GPL-3.0-or-later
// The bridge on the servo's thread: what it does besides the link makes no heap call, takes no lock
// and makes no system call. Here because the counters replace malloc for a whole program.
#include <algorithm>
#include <thread>

#include <gtest/gtest.h>

#include "argil/haptics/analysis/hold_test.h"
#include "argil/haptics/bridge/bridge_run.h"
#include "argil/haptics/simulation/sim_falcon.h"

#include "support/realtime_counters.h"

namespace argil {
namespace {

/// A floor at y = 0 that answers every state, without a queue; every tenth datagram is malformed.
class PlainFloor final : public haptics::BridgeLink {
 public:
  std::size_t receive(std::span<std::byte> into, haptics::BridgeAddress& from) noexcept override {
    if (!has_answer_) return 0;
    has_answer_ = false;
    from = {0, 1};
    std::copy_n(answer_.bytes.begin(), answer_.size, into.begin());
    return ++sent_ % 10 == 0 ? answer_.size - 1 : answer_.size;
  }
  void send(std::span<const std::byte> datagram, const haptics::BridgeAddress&) noexcept override {
    const auto message = haptics::decode(datagram);
    const auto* state = message ? std::get_if<haptics::BridgeState>(&*message) : nullptr;
    if (state == nullptr) return;
    haptics::BridgeProxy proxy;
    proxy.header.sequence = ++sequence_;
    proxy.header.flags = haptics::kBridgePlane;
    proxy.echo_sequence = state->header.sequence;
    proxy.echo_time_ns = state->header.time_ns;
    answer_ = haptics::encode(proxy);
    has_answer_ = true;
  }
  bool wait(double) noexcept override { return has_answer_; }

 private:
  haptics::BridgeDatagram answer_ = haptics::encode(haptics::BridgeHello{});
  bool has_answer_ = true;
  int sent_ = 0;
  std::uint64_t sequence_ = 0;
};

TEST(BridgeRealtime, TicksWithoutHeapLockOrSystemCall) {
  test::RealtimeCounts counts;
  bool is_counting = false;
  double most_n = 0.0;
  haptics::BridgeCounts said;
  std::thread([&] {
    PlainFloor link;
    haptics::BridgeSession session(link, {});
    haptics::GuidanceOptions guidance;
    guidance.kind = haptics::GuidanceKind::hybrid;
    guidance.path_mm = {{-10.0, 0.0, 0.0}, {10.0, 0.0, 0.0}};
    haptics::BridgeScene scene(session, guidance);
    haptics::SimFalcon device({}, haptics::hand_model(haptics::Hand::arm),
                              haptics::HandPlan(haptics::press_plan({}, {0.0, -1.0, 0.0}, 3.0)));
    haptics::Servo servo(device, scene, haptics::bridge_servo(1e-3));
    haptics::BridgeDriver driver(session, link, [&](const haptics::BridgeRow& row) {
      most_n = std::max(most_n, length(row.tick.force_n));
    });
    is_counting = test::start_counting_this_thread();
    if (!is_counting) return;
    for (int n = 1; n < 20'000; ++n) driver.after_tick(servo.tick(1e-3 * n));
    servo.stop();
    counts = test::counts_of_this_thread();
    said = session.counts();
  }).join();
  if (!is_counting) GTEST_SKIP() << "the kernel has no seccomp filters";
  EXPECT_GT(most_n, 2.0);
  EXPECT_GT(said.malformed, 1000U);
  EXPECT_EQ(counts.heap, 0);
  EXPECT_EQ(counts.locks, 0);
  EXPECT_EQ(counts.system_calls, 0);
}

}  // namespace
}  // namespace argil
