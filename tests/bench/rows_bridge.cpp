// SPDX-License-Identifier: GPL-3.0-or-later
// From a STATE sent to the tick that felt its answer, over UDP in real time: median and 99th
// percentile. The simulator answers at once, so that what is measured is two wakes, the datagrams'
// way and the wait for the servo's next tick.
#include <atomic>
#include <bit>
#include <chrono>
#include <thread>

#include "argil/haptics/bridge_run.h"
#include "argil/haptics/bridge_udp.h"
#include "argil/haptics/sim_falcon.h"

#include "bench/row.h"

namespace argil::bench {
namespace {

using haptics::BridgeUdp;

double seconds() { return amount(0.2, 2.0); }

/// A simulator of that rate, which touches nothing, until it is told to end.
void simulate(BridgeUdp& link, std::uint16_t bridge, double rate_hz,
              const std::atomic<bool>& ends) {
  std::uint64_t sequence = 0;
  link.send(encode(haptics::BridgeHello{{++sequence, 0, 0}, rate_hz}).span(), bridge);
  const auto frame = std::chrono::duration<double>(1.0 / rate_hz);
  const auto start = std::chrono::steady_clock::now();
  for (int n = 1; !ends; ++n) {
    std::this_thread::sleep_until(start + n * frame);
    haptics::BridgeProxy proxy;
    std::array<std::byte, haptics::kBridgeMostBytes> bytes;
    std::uint16_t from = 0;
    while (const std::size_t size = link.receive(bytes, from)) {
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
double latency_s(BridgeUdp& bridge, BridgeUdp& simulator, double rate_hz, double share,
                 RowResult& row) {
  haptics::BridgeSession session(bridge, {});
  haptics::BridgeScene scene(session, {});
  haptics::SimFalcon device({}, {}, haptics::HandPlan({haptics::HandKey{}}));
  haptics::Servo servo(device, scene, haptics::bridge_servo(1e-3));
  haptics::BridgeDriver driver(session, bridge, [](const haptics::BridgeRow&) {});
  std::atomic<bool> ends = false;
  std::thread frames([&] { simulate(simulator, bridge.port(), rate_hz, ends); });
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

void rates(benchmark::internal::Benchmark* row) {
  row->Arg(60)->Arg(200)->Arg(1000)->UseManualTime()->Iterations(1);
}
BENCHMARK_CAPTURE(bridge_latency, p50, 0.5)->Apply(rates);
BENCHMARK_CAPTURE(bridge_latency, p99, 0.99)->Apply(rates);

}  // namespace
}  // namespace argil::bench
