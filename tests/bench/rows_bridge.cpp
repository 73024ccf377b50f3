// SPDX-License-Identifier: GPL-3.0-or-later
// From a STATE sent to the tick that felt its answer, over UDP in real time: median and 99th
// percentile. The simulator answers at once, so that what is measured is two wakes, the datagrams'
// way and the wait for the servo's next tick.
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <thread>
#include <utility>

#include "argil/haptics/bridge/bridge_run.h"
#include "argil/haptics/bridge/bridge_udp.h"
#include "argil/haptics/bridge/sealed_link.h"
#include "argil/haptics/simulation/sim_falcon.h"

#include "bench/row.h"

namespace argil::bench {
namespace {

using haptics::BridgeAddress;
using haptics::BridgeLink;
using haptics::BridgeSender;
using haptics::BridgeUdp;
using haptics::SealedLink;

double seconds() { return amount(0.2, 2.0); }

/// A simulator of that rate, which touches nothing, until it is told to end.
void simulate(BridgeLink& link, const BridgeAddress& bridge, double rate_hz,
              const std::atomic<bool>& ends) {
  std::uint64_t sequence = 0;
  link.send(encode(haptics::BridgeHello{{++sequence, 0, 0}, rate_hz}).span(), bridge);
  const auto frame = std::chrono::duration<double>(1.0 / rate_hz);
  const auto start = std::chrono::steady_clock::now();
  for (int n = 1; !ends; ++n) {
    std::this_thread::sleep_until(start + n * frame);
    haptics::BridgeProxy proxy;
    std::array<std::byte, haptics::kBridgeMostBytes> bytes;
    BridgeAddress from;
    while (const std::size_t size = link.receive(bytes, from)) {
      if (size == BridgeLink::kDropped) continue;
      const auto message = haptics::decode(std::span<const std::byte>(bytes).first(size));
      const auto* state = message ? std::get_if<haptics::BridgeState>(&*message) : nullptr;
      if (state == nullptr) continue;
      proxy.echo_sequence = state->header.sequence;
      proxy.echo_time_ns = state->header.time_ns;
    }
    if (proxy.echo_sequence == 0) continue;
    proxy.header.sequence = ++sequence;
    link.send(encode(proxy).span(), bridge);
  }
}

/// A session of some seconds with a simulator of `rate_hz`: that share of its latencies is no
/// longer.
double latency_s(BridgeUdp& here, BridgeUdp& there, double rate_hz, double share, RowResult& row) {
  const haptics::BridgeKey key = haptics::BridgeKey::random();
  SealedLink bridge(here, key, BridgeSender::bridge, here.port());
  SealedLink simulator(there, key, BridgeSender::simulator, there.port());
  haptics::BridgeSession session(bridge, {});
  haptics::BridgeScene scene(session, {});
  haptics::SimFalcon device({}, {}, haptics::HandPlan({haptics::HandKey{}}));
  haptics::Servo servo(device, scene, haptics::bridge_servo(1e-3));
  haptics::BridgeDriver driver(session, bridge, [](const haptics::BridgeRow&) {});
  std::atomic<bool> ends = false;
  std::thread frames([&] { simulate(simulator, here.address(), rate_hz, ends); });
  haptics::ServoThread servo_thread(servo, &driver);
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds()));
  servo_thread.stop();
  ends = true;
  frames.join();
  // Nothing was touched: what is felt has the same bits every time.
  row.add(std::bit_cast<std::uint64_t>(length(device.held_force_n())));
  return 1e-6 * session.latency().quantile_us(share);
}

void bridge_latency(benchmark::State& state, double share) {
  RowResult row(state);
  auto here = BridgeUdp::open(0);
  auto there = BridgeUdp::open(0);
  auto* const bridge = value_or_fail(state, here);
  auto* const simulator = value_or_fail(state, there);
  if (bridge == nullptr || simulator == nullptr) return;
  const auto rate_hz = static_cast<double>(state.range(0));
  while (state.KeepRunning()) {
    state.SetIterationTime(latency_s(**bridge, **simulator, rate_hz, share, row));
  }
  row.show(std::to_string(state.range(0)) + " Hz");
}

/// A wire that brings back what was sent, from the other side.
class Echo final : public BridgeLink {
 public:
  std::size_t receive(std::span<std::byte> into, BridgeAddress& from) noexcept override {
    from = {haptics::kLoopbackHost, 1};
    std::copy_n(sent_.begin(), size_, into.begin());
    return std::exchange(size_, 0);
  }
  void send(std::span<const std::byte> datagram, const BridgeAddress&) noexcept override {
    size_ = datagram.size();
    std::ranges::copy(datagram, sent_.begin());
  }
  bool wait(double) noexcept override { return size_ > 0; }

 private:
  std::array<std::byte, SealedLink::kMostBytes> sent_{};
  std::size_t size_ = 0;
};

/// What the key costs: the tag of a PROXY made and looked at.
void bridge_seal(benchmark::State& state) {
  RowResult row(state);
  Echo wire;
  const haptics::BridgeKey key = haptics::BridgeKey::random();
  SealedLink simulator(wire, key, BridgeSender::simulator, 1);
  SealedLink bridge(wire, key, BridgeSender::bridge, 2);
  haptics::BridgeProxy proxy;
  std::array<std::byte, haptics::kBridgeMostBytes> bytes;
  BridgeAddress from;
  std::uint64_t taken = 0;
  while (state.KeepRunning()) {
    ++proxy.header.sequence;
    simulator.send(encode(proxy).span(), {});
    taken += bridge.receive(bytes, from) == haptics::kBridgeProxyBytes ? 1U : 0U;
  }
  row.add(taken == static_cast<std::uint64_t>(state.iterations()) ? 1U : 0U);
  row.show("PROXY sent and taken");
}
BENCHMARK(bridge_seal);

void rates(benchmark::internal::Benchmark* row) {
  row->Arg(60)->Arg(200)->Arg(1000)->UseManualTime()->Iterations(1);
}
BENCHMARK_CAPTURE(bridge_latency, p50, 0.5)->Apply(rates);
BENCHMARK_CAPTURE(bridge_latency, p99, 0.99)->Apply(rates);

}  // namespace
}  // namespace argil::bench
