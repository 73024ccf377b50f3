// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_run.h"

#include <cassert>
#include <chrono>
#include <utility>

namespace argil::haptics {
namespace {

/// How often it is asked, in lockstep, whether the run should end.
constexpr double kLookS = 0.05;

}  // namespace

BridgeScene::BridgeScene(BridgeSession& session, GuidanceOptions guidance)
    : session_(session), guidance_(std::move(guidance)) {}

void BridgeScene::begin_tick(const HandleState& handle) noexcept {
  session_.receive(handle.time_s);
  session_.watch().tick(handle.time_s);
}

SceneForce BridgeScene::force_at(const HandleState& handle) const noexcept {
  SceneForce felt;
  if (session_.is_stopped()) felt.faults |= kSceneStopped;
  const BridgeProxy* const proxy = session_.newest();
  if (proxy == nullptr || session_.is_stopped()) return felt;
  const BridgeTerms& terms = session_.terms();
  Vec3 force =
      bridge_force(terms.law, terms.spring, handle.position_mm, handle.velocity_mm_per_s, *proxy);
  // Before the fraction is taken, not after it: a hundredth of what a hand deep in the matter would
  // feel is beyond the gate's limit already, and no ramp would be left.
  shorten(force, SafetyOptions().most_force_n);
  felt.force_n = session_.share() * force;
  return felt;
}

/// No guidance without a simulator: then the share is 0, or the force is cut.
Vec3 BridgeScene::aid_n(const HandleState& tool, const AidTick& tick) noexcept {
  AidTick faded = tick;
  faded.given_part *= aided_share_;
  const Vec3 aid_n = guidance_.tick(tool.position_mm, faded);
  const bool is_felt = session_.newest() != nullptr && !session_.is_stopped();
  aided_share_ = is_felt ? session_.share() : 0.0;
  return aided_share_ * aid_n;
}

ServoOptions bridge_servo(double period_s) noexcept {
  assert(period_s > 0.0);
  ServoOptions options;
  options.period_s = period_s;
  options.coupling.kind = CouplingKind::direct;
  options.governor.is_on = false;
  options.safety.ramp_in_s = BridgeWatchOptions().ramp_in_s;
  return options;
}

BridgeDriver::BridgeDriver(BridgeSession& session, BridgeLink& link,
                           std::function<void(const BridgeRow&)> log, std::function<bool()> goes_on)
    : session_(session), link_(link), log_(std::move(log)), goes_on_(std::move(goes_on)) {
  assert(log_ && goes_on_);
}

void BridgeDriver::after_tick(const ServoTick& tick) {
  BridgeRow row;
  row.tick = tick;
  row.has_proxy = session_.newest() != nullptr;
  if (row.has_proxy) row.proxy = *session_.newest();
  row.share = session_.share();
  row.age_s = session_.watch().age_s(tick.time_s);
  log_(row);
  const BridgeTerms& terms = session_.terms();
  if (!terms.is_lockstep) {
    session_.send_state(tick);
    return;
  }
  // By whole ticks, so that rounding does not add up for a rate that does not divide the servo's.
  const double in_frames = static_cast<double>(tick.number) * terms.servo_period_s;
  const auto frames = static_cast<std::uint64_t>(in_frames * session_.rate_hz() + 1e-9);
  // Only frames: time is not paced, so that other states would fill the simulator's buffer.
  if (frames == frames_) return;
  frames_ = frames;
  await(session_.send_state(tick, true), tick.time_s);
}

/// Waits in real time, since virtual time stands still meanwhile.
void BridgeDriver::await(std::uint64_t sequence, double now_s) {
  const auto is_answered = [&] {
    return session_.newest() != nullptr && session_.newest()->echo_sequence >= sequence;
  };
  const auto begin = std::chrono::steady_clock::now();
  while (session_.has_simulator() && !is_answered() && !is_over_) {
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
    is_unanswered_ = waited.count() > kMostWaitS;
    is_over_ = is_unanswered_ || !goes_on_();
    link_.wait(kLookS);
    session_.receive(now_s);
  }
  if (!session_.has_simulator()) is_over_ = true;
}

}  // namespace argil::haptics
