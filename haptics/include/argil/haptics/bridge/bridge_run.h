// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "argil/haptics/bridge/bridge_session.h"
#include "argil/haptics/scene/scene.h"
#include "argil/haptics/servo/guidance.h"
#include "argil/haptics/servo/servo.h"
#include "argil/haptics/servo/servo_run.h"

namespace argil::haptics {

/// What a simulator says, as a scene of the servo: the law's force, no larger than the safety gate
/// lets through, and guidance beside it, both times BridgeSession::share. The force is cut while
/// the simulator says stop or has left.
///
/// Threads  as ForceScene; the session is the servo thread's while it runs.
class BridgeScene final : public ForceScene {
 public:
  /// `session` must outlive it.
  BridgeScene(BridgeSession& session, GuidanceOptions guidance);
  void begin_tick(const HandleState& handle) noexcept override;
  SceneForce force_at(const HandleState& handle) const noexcept override;
  Vec3 aid_n(const HandleState& tool, const AidTick& tick) noexcept override;
  void forget_motion() noexcept override { guidance_.forget_motion(); }

  /// Of the last tick; for the servo's thread.
  const GuidanceState& guidance() const noexcept { return guidance_.state(); }

 private:
  BridgeSession& session_;
  Guidance guidance_;
  double aided_share_ = 0.0;  ///< of guidance in the last tick
};

/// Options of a servo with nothing between scene and safety gate: the bridge's laws are couplings
/// themselves.
ServoOptions bridge_servo(double period_s) noexcept;

/// Both sides of a tick, for logs.
struct BridgeRow {
  ServoTick tick;
  BridgeProxy proxy;
  /// False: the simulator has not sent a proxy yet.
  bool has_proxy = false;
  /// Fraction of the simulator's force that is felt, 0 to 1.
  double share = 0.0;
  /// Since the simulator was heard.
  double age_s = 0.0;
};

/// Tells the simulator of each tick, and `log` of both sides. In lockstep it tells of the
/// simulator's frames only, and waits at each until the simulator has answered; the time of the
/// servo must then be virtual.
///
/// Threads  as ServoObserver; Realtime but for link and log.
class BridgeDriver final : public ServoObserver {
 public:
  /// How long of real time a simulator may think about a frame in lockstep.
  static constexpr double kMostWaitS = 30.0;

  /// Session and link must outlive it. Both functions are called on the servo's thread: `log` after
  /// each tick, `goes_on` (false: end the run) while a simulator in lockstep is waited for.
  BridgeDriver(
      BridgeSession& session, BridgeLink& link, std::function<void(const BridgeRow&)> log,
      std::function<bool()> goes_on = [] { return true; });
  void after_tick(const ServoTick& tick) override;

  /// True: end the run. In lockstep the simulator has left or does not answer, or `goes_on` said
  /// no.
  const std::atomic<bool>& is_over() const noexcept { return is_over_; }
  /// The simulator did not answer within kMostWaitS.
  bool is_unanswered() const noexcept { return is_unanswered_; }

 private:
  void await(std::uint64_t sequence, double now_s);

  BridgeSession& session_;
  BridgeLink& link_;
  std::function<void(const BridgeRow&)> log_;
  std::function<bool()> goes_on_;
  std::atomic<bool> is_over_ = false;
  bool is_unanswered_ = false;
  std::uint64_t frames_ = 0;
};

}  // namespace argil::haptics
