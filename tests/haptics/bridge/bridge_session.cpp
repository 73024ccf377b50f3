// SPDX-License-Identifier: GPL-3.0-or-later
// The session, the fail-safe and what is refused, in virtual time.
#include "argil/haptics/bridge/bridge_session.h"

#include <deque>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "haptics/bridge/bridge_runs.h"

namespace argil::haptics {
namespace {

using scenes::BridgeRan;
using scenes::BridgeRun;

/// A wire whose other end is the test.
class Wire final : public BridgeLink {
 public:
  std::size_t receive(std::span<std::byte> into, BridgeAddress& from_address) noexcept override {
    if (in.empty()) return 0;
    const auto [datagram, from] = in.front();
    in.pop_front();
    from_address = {0, from};
    std::copy_n(datagram.bytes.begin(), datagram.size, into.begin());
    return datagram.size;
  }
  void send(std::span<const std::byte> datagram, const BridgeAddress& to) noexcept override {
    out.emplace_back(*decode(datagram), to.port);
  }
  bool wait(double) noexcept override { return !in.empty(); }

  void say(const BridgeMessage& message, std::uint16_t from = 7) {
    in.emplace_back(encode(message), from);
  }
  template <class Message>
  const Message* last() const {
    return out.empty() ? nullptr : std::get_if<Message>(&out.back().first);
  }

  std::deque<std::pair<BridgeDatagram, std::uint16_t>> in;
  std::vector<std::pair<BridgeMessage, std::uint16_t>> out;
};

BridgeProxy proxy_of(std::uint64_t sequence, std::uint32_t flags = kBridgeContact) {
  BridgeProxy proxy;
  proxy.header.sequence = sequence;
  proxy.header.flags = flags;
  return proxy;
}

BridgeHello hello(double rate_hz = 60.0) { return {{1, 0, 0}, rate_hz}; }

TEST(BridgeSession, WelcomesWithItsTerms) {
  Wire wire;
  BridgeTerms terms;
  terms.scale = 2.5;
  BridgeSession session(wire, terms);
  wire.say(hello());
  session.receive(0.0);
  const auto* welcome = wire.last<BridgeWelcome>();
  ASSERT_NE(welcome, nullptr);
  EXPECT_EQ(welcome->rate_hz, 1000.0);
  EXPECT_EQ(welcome->stiffness_n_per_m, 1500.0);
  EXPECT_EQ(welcome->scale, 2.5);
  EXPECT_EQ(welcome->law, 2U);
  EXPECT_EQ(session.rate_hz(), 60.0);
}

TEST(BridgeSession, TheNewestWins) {
  Wire wire;
  BridgeSession session(wire, {});
  wire.say(hello());
  for (const std::uint64_t sequence : {5U, 9U, 7U, 9U}) wire.say(proxy_of(sequence));
  session.receive(0.0);
  ASSERT_NE(session.newest(), nullptr);
  EXPECT_EQ(session.newest()->header.sequence, 9U);
  EXPECT_EQ(session.counts().proxies, 2U);
  EXPECT_EQ(session.counts().old, 2U);
}

TEST(BridgeSession, CountsAndDropsWhatIsMalformedOrNotForIt) {
  Wire wire;
  BridgeSession session(wire, {});
  wire.say(hello());
  BridgeProxy answer_to_nothing = proxy_of(2);
  answer_to_nothing.echo_sequence = 1000;
  wire.say(answer_to_nothing);
  BridgeProxy from_the_future = proxy_of(3);
  from_the_future.echo_time_ns = 1'000'000'000'000;
  wire.say(from_the_future);
  wire.say(BridgeState{});
  wire.in.emplace_back(BridgeDatagram{}, 7);
  wire.in.back().first.size = 33;
  session.receive(0.0);
  EXPECT_EQ(session.counts().malformed, 4U);
  EXPECT_EQ(session.newest(), nullptr);
}

TEST(BridgeSession, AFloodCostsABoundedTick) {
  Wire wire;
  BridgeSession session(wire, {});
  for (int n = 0; n < 1000; ++n) wire.say(BridgeState{});
  session.receive(0.0);
  EXPECT_EQ(wire.in.size(), 1000U - BridgeSession::kMostReceived);
}

TEST(BridgeSession, HasOneSimulatorUntilThatIsFeltNoMore) {
  Wire wire;
  BridgeSession session(wire, {});
  wire.say(hello());
  wire.say(proxy_of(2));
  wire.say(hello(), 8);
  wire.say(proxy_of(3), 8);
  session.receive(0.0);
  ASSERT_NE(wire.last<BridgeBye>(), nullptr);
  EXPECT_EQ(wire.last<BridgeBye>()->reason, BridgeReason::busy);
  EXPECT_EQ(wire.out.back().second, 8);
  EXPECT_EQ(session.counts().strangers, 2U);
  EXPECT_EQ(session.newest()->header.sequence, 2U);
  wire.say(hello(), 8);
  session.receive(0.301);
  EXPECT_NE(wire.last<BridgeWelcome>(), nullptr);
  EXPECT_EQ(session.newest(), nullptr);
  EXPECT_EQ(session.counts().sessions, 2U);
}

TEST(BridgeSession, RefusesARateThatItsStiffnessBreaks) {
  Wire wire;
  BridgeTerms terms;
  terms.law = BridgeLaw::direct;  // 1500 N/m: 250 Hz for 3 N s/m
  BridgeSession session(wire, terms);
  wire.say(hello(249.0));
  session.receive(0.0);
  ASSERT_NE(wire.last<BridgeBye>(), nullptr);
  EXPECT_EQ(wire.last<BridgeBye>()->reason, BridgeReason::too_stiff);
  EXPECT_FALSE(session.has_simulator());
  EXPECT_EQ(session.refused_rate_hz(), 249.0);
  wire.say(hello(251.0));
  session.receive(0.0);
  EXPECT_TRUE(session.has_simulator());
  terms.is_forced = true;
  BridgeSession forced(wire, terms);
  wire.say(hello(30.0));
  forced.receive(0.0);
  EXPECT_TRUE(forced.has_simulator());
}

/// As a simulator that is that much later.
TEST(BridgeSession, RefusesARateThatTheFiltersLagBreaks) {
  Wire wire;
  BridgeTerms terms;
  terms.law = BridgeLaw::direct;  // 1500 N/m and 3 N s/m: 4 ms, of which the filter takes 2
  terms.filter_lag_s = 1e-3;
  BridgeSession session(wire, terms);
  wire.say(hello(499.0));
  session.receive(0.0);
  EXPECT_FALSE(session.has_simulator());
  wire.say(hello(501.0));
  session.receive(0.0);
  EXPECT_TRUE(session.has_simulator());
}

TEST(BridgeSession, TellsWhereTheHandleIsFelt) {
  Wire wire;
  BridgeSession session(wire, {});
  wire.say(hello());
  session.receive(0.0);
  ServoTick tick;
  tick.position_mm = {1.0, 2.0, 3.0};
  tick.felt_mm = {1.5, 2.5, 3.5};
  session.send_state(tick);
  ASSERT_NE(wire.last<BridgeState>(), nullptr);
  EXPECT_EQ(wire.last<BridgeState>()->position_mm, tick.felt_mm);
}

TEST(BridgeWatch, HoldsFadesAndComesBack) {
  BridgeWatch watch({});
  EXPECT_EQ(watch.tick(0.0), 0.0) << "never heard";
  double now = 0.0;
  const auto after = [&](double seconds, bool hears) {
    for (const double end = now + seconds; now < end - 1e-9;) {
      now += 0.001;
      if (hears) watch.hear(now);
      watch.tick(now);
    }
    return watch.gain();
  };
  EXPECT_NEAR(after(0.1, true), 0.5, 0.01);
  EXPECT_EQ(after(0.2, true), 1.0);
  EXPECT_EQ(after(0.099, false), 1.0);
  EXPECT_NEAR(after(0.101, false), 0.5, 0.01);
  EXPECT_EQ(after(0.1, false), 0.0);
  EXPECT_FALSE(watch.is_alive(now));
  EXPECT_NEAR(after(0.05, true), 0.25, 0.01);
  watch.cut();
  EXPECT_EQ(watch.tick(now), 0.0);
}

/// A press on the floor whose simulator is meddled with.
BridgeRun pressed(std::function<void(double, BridgeWorld&)> after) {
  BridgeRun run;
  run.plan = scenes::pressing();
  run.seconds = 5.0;
  run.after = std::move(after);
  return run;
}

double force_at(const BridgeRan& ran, double time_s) {
  return length(ran.rows.at(static_cast<std::size_t>(std::lround(time_s * 1000.0))).tick.force_n);
}

bool at(double time_s, double when_s) { return std::abs(time_s - when_s) < 1e-6; }

TEST(BridgeFailSafe, RampsToNothingWhenTheSimulatorIsKilledAndBackWhenItReturns) {
  for (const BridgeLaw law : {BridgeLaw::plane, BridgeLaw::indirect}) {
    BridgeRun run = pressed([](double time_s, BridgeWorld& world) {
      if (at(time_s, 2.0)) world.set_dead(true);
      if (at(time_s, 3.0)) world.set_dead(false);
    });
    run.terms.law = law;
    const BridgeRan ran = scenes::run_bridge(run);
    EXPECT_GT(force_at(ran, 2.0), 2.5);
    EXPECT_GT(force_at(ran, 2.08), 2.5) << "held";
    EXPECT_GT(force_at(ran, 2.2), 0.5) << "fading";
    EXPECT_EQ(force_at(ran, 2.3), 0.0);
    EXPECT_EQ(force_at(ran, 2.9), 0.0);
    for (std::size_t n = 1; n < ran.rows.size(); ++n) {
      const double step = length(ran.rows[n].tick.force_n - ran.rows[n - 1].tick.force_n);
      ASSERT_LE(step, 2.0 + 1e-9) << "the gate's slew, at " << ran.rows[n].tick.time_s;
    }
    EXPECT_EQ(ran.counts.sessions, 2U);
    EXPECT_NEAR(force_at(ran, 4.99), 3.0, 0.5) << bridge_law_name(law);
    EXPECT_EQ(ran.rows.back().share, 1.0);
  }
}

TEST(BridgeFailSafe, StopIsNothingAtOnce) {
  const BridgeRan ran = scenes::run_bridge(pressed([](double time_s, BridgeWorld& world) {
    if (at(time_s, 2.0)) world.stop(true);
    if (at(time_s, 3.0)) world.stop(false);
  }));
  EXPECT_GT(force_at(ran, 2.0), 2.5);
  // Within a frame of 60 Hz and a tick, from 2.5 N and more to nothing in one tick.
  EXPECT_EQ(force_at(ran, 2.018), 0.0);
  EXPECT_EQ(force_at(ran, 2.99), 0.0);
  EXPECT_NEAR(force_at(ran, 4.99), 3.0, 0.5);
}

TEST(BridgeFailSafe, ByeIsNothingAtOnce) {
  const BridgeRan ran = scenes::run_bridge(pressed([](double time_s, BridgeWorld& world) {
    if (at(time_s, 2.0)) world.say_bye();
  }));
  EXPECT_GT(force_at(ran, 2.0), 2.5);
  EXPECT_EQ(force_at(ran, 2.001), 0.0);
  EXPECT_EQ(force_at(ran, 4.9), 0.0);
  EXPECT_NE(ran.rows.at(2001).tick.faults & kSimulatorStop, 0U);
}

TEST(BridgeFailSafe, NothingIsFeltBeforeASimulatorSpeaks) {
  BridgeRun run = pressed([](double, BridgeWorld& world) { world.set_dead(true); });
  const BridgeRan ran = scenes::run_bridge(run);
  for (const BridgeRow& row : ran.rows) ASSERT_EQ(row.tick.force_n, Vec3{});
}

/// A simulator that answers by a plane, or by a force, of far more than a hand may feel.
class Overdone {
 public:
  explicit Overdone(BridgeLaw law) : session_(wire_, terms_of(law)), scene_(session_, {}) {
    wire_.say(hello(1000.0));
    tick(false);
  }

  /// A tick: the force before the safety gate.
  double tick(bool answers, double late_s = 0.0) {
    handle_.time_s = 1e-3 * ++ticks_;
    if (answers) {
      BridgeProxy proxy = proxy_of(++sequence_, kBridgeContact | kBridgePlane);
      proxy.echo_time_ns = static_cast<std::uint64_t>(1e9 * (handle_.time_s - late_s));
      proxy.plane_normal = {0.0, 1.0, 0.0};
      proxy.plane_point_mm = {0.0, 1000.0, 0.0};  // 1500 N at 1500 N/m
      proxy.position_mm = {0.0, 1000.0, 0.0};
      proxy.direct_force_n = {0.0, 1e9, 0.0};
      wire_.say(proxy);
    }
    scene_.begin_tick(handle_);
    return length(scene_.force_at(handle_).force_n);
  }
  double share() const { return session_.share(); }

 private:
  static BridgeTerms terms_of(BridgeLaw law) {
    BridgeTerms terms;
    terms.law = law;
    return terms;
  }
  Wire wire_;
  BridgeSession session_;
  BridgeScene scene_;
  HandleState handle_;
  int ticks_ = 0;
  std::uint64_t sequence_ = 1;
};

constexpr double kGateN = 8.0;

/// Of 1 m of depth, or a billion newtons, a ramp is still a ramp.
TEST(BridgeFailSafe, RampsWhatTheGateWouldCutAnyway) {
  for (const BridgeLaw law : {BridgeLaw::plane, BridgeLaw::indirect, BridgeLaw::direct}) {
    SCOPED_TRACE(bridge_law_name(law));
    Overdone simulator(law);
    for (int ms = 1; ms <= 200; ++ms) {
      ASSERT_NEAR(simulator.tick(true), kGateN * ms / 200.0, 0.1) << ms << " ms after it began";
    }
    EXPECT_NEAR(simulator.tick(true), kGateN, 1e-9);
    for (int ms = 1; ms <= 300; ++ms) {
      const double left = std::min(1.0, (300.0 - ms) / 200.0);
      ASSERT_NEAR(simulator.tick(false), kGateN * left, 0.1) << ms << " ms after it fell silent";
    }
    EXPECT_EQ(simulator.tick(false), 0.0);
    EXPECT_LT(simulator.tick(true), 0.1) << "and back by the ramp";
  }
}

TEST(BridgeFailSafe, AnAnswerIsAsOldAsItsQuestion) {
  Overdone simulator(BridgeLaw::plane);
  for (int n = 0; n < 1000; ++n) simulator.tick(true, 0.05);
  EXPECT_NEAR(simulator.tick(true, 0.05), kGateN, 1e-9);
  for (int n = 0; n < 10; ++n) EXPECT_LT(simulator.tick(true, 0.2), 0.51 * kGateN);
  for (int n = 0; n < 10; ++n) EXPECT_EQ(simulator.tick(true, 0.6), 0.0);
}

/// 1500 N/m may be closed at 250 Hz and faster: who said 1000 Hz and speaks at 50 has a fifth.
TEST(BridgeFailSafe, DirectForcesSlowerThanPromisedAreWeakened) {
  for (const BridgeLaw law : {BridgeLaw::direct, BridgeLaw::plane}) {
    Overdone simulator(law);
    for (int n = 0; n < 1000; ++n) simulator.tick(true);
    EXPECT_EQ(simulator.share(), 1.0);
    for (int n = 0; n < 2000; ++n) simulator.tick(n % 20 == 0);
    EXPECT_NEAR(simulator.share(), law == BridgeLaw::direct ? 0.2 : 1.0, 1e-3);
  }
}

TEST(BridgeSession, RefusesARateThatItsHoldWouldChop) {
  for (const double rate_hz : {1.0, 9.9}) {
    BridgeHello slow = hello(rate_hz);
    EXPECT_FALSE(decode(encode(slow).span()).has_value()) << rate_hz;
  }
  EXPECT_TRUE(decode(encode(hello(10.0)).span()).has_value());
}

}  // namespace
}  // namespace argil::haptics
