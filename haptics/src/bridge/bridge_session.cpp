// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_session.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "math/units.h"

namespace argil::haptics {
namespace {

constexpr double kUsPerNs = 1e-3;
/// Weight of a period in the running mean: eight frames, so that one late frame is hardly felt.
constexpr double kPeriodWeight = 1.0 / 8.0;

std::uint64_t ns_of(double time_s) noexcept {
  return static_cast<std::uint64_t>(std::llround(std::max(0.0, time_s) * kNsPerS));
}

}  // namespace

BridgeSession::BridgeSession(BridgeLink& link, const BridgeTerms& terms) noexcept
    : link_(link), terms_(terms), watch_(terms.watch) {
  assert(terms.servo_period_s > 0.0 && terms.scale > 0.0 && terms.device_damping_n_s_per_m >= 0.0);
  assert(terms.spring.stiffness_n_per_m > 0.0 && terms.spring.damping_n_s_per_m >= 0.0);
}

BridgeHeader BridgeSession::next_header(double now_s, std::uint32_t flags) noexcept {
  return {++sequence_, ns_of(now_s), flags};
}

void BridgeSession::send(const BridgeMessage& message, const BridgeAddress& to) noexcept {
  link_.send(encode(message).span(), to);
}

void BridgeSession::say_bye(BridgeReason reason, const BridgeAddress& to) noexcept {
  send(BridgeBye{next_header(now_s_, 0), reason}, to);
}

/// A simulator is welcomed unless another one may still be felt, or its rate is too slow for the
/// law.
void BridgeSession::take(const BridgeHello& hello, const BridgeAddress& from,
                         double now_s) noexcept {
  if (from != simulator_ && has_simulator() && watch_.is_alive(now_s)) {
    ++counts_.strangers;
    return say_bye(BridgeReason::busy, from);
  }
  const double period_s = bridge_period_s(terms_.law, terms_.servo_period_s, hello.rate_hz);
  // A force of Argil's own is held back by the governor, whatever the simulator's rate.
  if (!terms_.is_forced && !is_own_force(terms_.law) &&
      !is_bridge_stable(terms_.spring.stiffness_n_per_m, period_s + 2.0 * terms_.filter_lag_s,
                        terms_.device_damping_n_s_per_m)) {
    ++counts_.refused;
    refused_rate_hz_ = hello.rate_hz;
    return say_bye(BridgeReason::too_stiff, from);
  }
  // HELLO again before the welcome arrived: the same session.
  if (from != simulator_ || has_newest_) {
    ++counts_.sessions;
    simulator_ = from;
    has_newest_ = false;
    is_stopped_ = false;
    watch_.cut();
    watch_.hear(now_s);
  }
  rate_hz_ = hello.rate_hz;
  period_s_ = 1.0 / hello.rate_hz;
  heard_s_ = now_s;
  BridgeWelcome welcome;
  welcome.header = next_header(now_s, terms_.is_lockstep ? kBridgeLockstep : 0U);
  welcome.rate_hz = 1.0 / terms_.servo_period_s;
  welcome.stiffness_n_per_m = terms_.spring.stiffness_n_per_m;
  welcome.damping_n_s_per_m = terms_.spring.damping_n_s_per_m;
  welcome.scale = terms_.scale;
  welcome.law = static_cast<std::uint32_t>(terms_.law);
  send(welcome, simulator_);
}

/// The newest PROXY replaces the one before; its age is that of the STATE it answers.
void BridgeSession::take(const BridgeProxy& proxy, const BridgeAddress& from,
                         double now_s) noexcept {
  if (from != simulator_) {
    ++counts_.strangers;
    return;
  }
  // It cannot answer a STATE that was never sent.
  if (proxy.echo_sequence > sequence_ || proxy.echo_time_ns > ns_of(now_s)) {
    ++counts_.malformed;
    return;
  }
  if (has_newest_ && proxy.header.sequence <= newest_.header.sequence) {
    ++counts_.old;
    return;
  }
  ++counts_.proxies;
  newest_ = proxy;
  has_newest_ = true;
  is_stopped_ = (proxy.header.flags & kBridgeStop) != 0;
  if (is_stopped_) {
    watch_.cut();
  } else {
    watch_.hear(static_cast<double>(proxy.echo_time_ns) / kNsPerS);
    period_s_ += kPeriodWeight * (now_s - heard_s_ - period_s_);
    heard_s_ = now_s;
    latency_.add(static_cast<double>(ns_of(now_s) - proxy.echo_time_ns) * kUsPerNs);
  }
}

void BridgeSession::take(const BridgeBye&, const BridgeAddress& from, double) noexcept {
  if (from != simulator_) {
    ++counts_.strangers;
    return;
  }
  simulator_ = {};
  has_newest_ = false;
  is_stopped_ = true;
  watch_.cut();
}

/// What only a bridge sends.
template <class Other>
void BridgeSession::take(const Other&, const BridgeAddress&, double) noexcept {
  ++counts_.malformed;
}

double BridgeSession::share() const noexcept {
  const double heard = watch_.gain();
  if (terms_.law != BridgeLaw::direct || terms_.is_forced) return heard;
  const double loop = terms_.spring.stiffness_n_per_m * (period_s_ + 2.0 * terms_.filter_lag_s);
  const double most = 2.0 * terms_.device_damping_n_s_per_m;
  return loop > most ? heard * most / loop : heard;
}

void BridgeSession::receive(double now_s) noexcept {
  now_s_ = now_s;
  std::array<std::byte, kBridgeMostBytes> buffer;
  for (int taken = 0; taken < kMostReceived; ++taken) {
    BridgeAddress from;
    const std::size_t size = link_.receive(buffer, from);
    if (size == 0) return;
    if (size == BridgeLink::kDropped) continue;
    const auto message = size > buffer.size()
                             ? std::nullopt
                             : decode(std::span<const std::byte>(buffer).first(size));
    if (!message) {
      ++counts_.malformed;
      continue;
    }
    std::visit([&](const auto& kind) { take(kind, from, now_s); }, *message);
  }
}

std::uint64_t BridgeSession::send_state(const ServoTick& tick, bool is_frame) noexcept {
  if (!has_simulator()) return 0;
  BridgeState state;
  state.header = next_header(tick.time_s, is_frame ? kBridgeFrame : 0U);
  state.position_mm = tick.felt_mm;
  state.velocity_mm_per_s = tick.velocity_mm_per_s;
  state.force_n = tick.force_n;
  state.buttons = tick.buttons;
  ++counts_.states;
  send(state, simulator_);
  return sequence_;
}

void BridgeSession::leave() noexcept {
  if (has_simulator()) say_bye(BridgeReason::ends, simulator_);
  simulator_ = {};
}

}  // namespace argil::haptics
