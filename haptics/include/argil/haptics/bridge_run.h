// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "argil/haptics/bridge_guidance.h"
#include "argil/haptics/bridge_session.h"
#include "argil/haptics/scene.h"
#include "argil/haptics/servo.h"
#include "argil/haptics/servo_run.h"

namespace argil::haptics {

/// What a simulator says, as a scene of the servo: the law and the guidance, no longer than the
/// safety gate lets through, under the session's share. Cuts the force while the simulator says
/// stop or has left.
///
/// Threads  as ForceScene. The session must outlive it, and is the servo thread's while it runs.
class BridgeScene final : public ForceScene {
 public:
  BridgeScene(BridgeSession& session, GuidanceOptions guidance);
  void begin_tick(const HandleState& handle) noexcept override;
  SceneForce force_at(const HandleState& place) const noexcept override;

 private:
  BridgeSession& session_;
  GuidanceOptions guidance_;
};

/// A servo with nothing between scene and safety gate: the bridge's laws are couplings themselves.
ServoOptions bridge_servo(double period_s) noexcept;

/// Both sides of a tick, for logs.
struct BridgeRow {
  ServoTick tick;
  BridgeProxy proxy;
  bool has_proxy = false;
  double share = 0.0;  ///< of the simulator's force that is felt
  double age_s = 0.0;  ///< since the simulator was heard
};

/// Tells the simulator of each tick, and `log` of both sides. In lockstep it tells of the
/// simulator's frames only, and waits at each until that has answered; the time of the servo must
/// be virtual then.
///
/// Threads  as ServoObserver; Realtime but for link and log.
class BridgeDriver final : public ServoObserver {
 public:
  /// How long of real time a simulator may think about a frame in lockstep.
  static constexpr double kMostWaitS = 30.0;

  /// All must outlive it. `log` is called on the servo's thread, `goes_on` (false: end the run) on
  /// it too, while a simulator in lockstep is waited for.
  BridgeDriver(
      BridgeSession& session, BridgeLink& link, std::function<void(const BridgeRow&)> log,
      std::function<bool()> goes_on = [] { return true; });
  void after_tick(const ServoTick& tick) override;

  /// In lockstep the simulator has left or does not answer, or `goes_on` says no: end the run.
  const std::atomic<bool>& is_over() const noexcept { return is_over_; }
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
