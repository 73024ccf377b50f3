// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/haptics/bridge/bridge_law.h"
#include "argil/haptics/bridge/bridge_link.h"
#include "argil/haptics/bridge/bridge_message.h"
#include "argil/haptics/bridge/bridge_watch.h"
#include "argil/haptics/servo/histogram.h"
#include "argil/haptics/servo/servo.h"

namespace argil::haptics {

/// What a bridge offers a simulator.
struct BridgeTerms {
  BridgeLaw law = BridgeLaw::plane;
  BridgeSpring spring;
  /// mm of the scene for a mm of the hand; usual 1, > 0.
  double scale = 1.0;
  /// > 0.
  double servo_period_s = 1e-3;
  /// b of is_bridge_stable; > 0.
  double device_damping_n_s_per_m = 3.0;
  /// Of the position filter that the servo has (filter_lag_s); usual 0, >= 0. Twice as much is
  /// added to the period of that rule, in which a delay weighs as two halves of a period.
  double filter_lag_s = 0.0;
  /// A stiffness beyond is_bridge_stable is not refused: it may vibrate.
  bool is_forced = false;
  /// Time is virtual, which the simulator is told.
  bool is_lockstep = false;
  BridgeWatchOptions watch;
};

struct BridgeCounts {
  /// Simulators that were welcomed.
  std::uint64_t sessions = 0;
  /// STATEs sent.
  std::uint64_t states = 0;
  /// PROXYs taken.
  std::uint64_t proxies = 0;
  /// Datagrams dropped: not a message, or not one for a bridge.
  std::uint64_t malformed = 0;
  /// PROXYs dropped: overtaken by a newer one.
  std::uint64_t old = 0;
  /// Messages dropped: not from the simulator of this session.
  std::uint64_t strangers = 0;
  /// Simulators refused: their rate is too slow for law and stiffness.
  std::uint64_t refused = 0;
};

/// A bridge's side of the protocol: one simulator at a time, its newest message, and how much of it
/// is to be felt. A simulator that falls silent is waited for: it may go on, or begin anew; so may
/// another one once nothing of the first is felt any longer.
///
/// Errors   none: what is malformed, old, forged or from a stranger is dropped and counted.
/// Threads  one at a time; Realtime but for the link (BridgeRealtime.*).
class BridgeSession {
 public:
  /// The most datagrams that one `receive` takes: a flood costs no more than that in a tick.
  static constexpr int kMostReceived = 64;

  /// `link` must outlive it.
  BridgeSession(BridgeLink& link, const BridgeTerms& terms) noexcept;

  /// Takes what has arrived by `now_s`, a time of the servo that never falls, and answers.
  void receive(double now_s) noexcept;

  /// Sends the simulator, when there is one, STATE of this tick, its position the one that is felt;
  /// its sequence, 0 when there is none. `is_frame`: in lockstep, its answer is waited for.
  std::uint64_t send_state(const ServoTick& tick, bool is_frame = false) noexcept;

  /// Tells the simulator that the bridge leaves.
  void leave() noexcept;

  bool has_simulator() const noexcept { return simulator_ != BridgeAddress(); }
  /// The simulator says stop or has left.
  bool is_stopped() const noexcept { return is_stopped_; }
  /// The newest PROXY of this session; null: none yet.
  const BridgeProxy* newest() const noexcept { return has_newest_ ? &newest_ : nullptr; }
  /// Of the simulator, as it said in HELLO.
  double rate_hz() const noexcept { return rate_hz_; }
  /// Of the last simulator that was refused; 0: none.
  double refused_rate_hz() const noexcept { return refused_rate_hz_; }

  /// The fraction of the simulator's force that is to be felt: the watch's. A simulator that closes
  /// the loop itself (`direct`), and more slowly than it said, has no more than k T < 2 b allows at
  /// the period T of its messages, unless BridgeTerms::is_forced.
  double share() const noexcept;

  BridgeWatch& watch() noexcept { return watch_; }
  const BridgeWatch& watch() const noexcept { return watch_; }
  const BridgeTerms& terms() const noexcept { return terms_; }
  const BridgeCounts& counts() const noexcept { return counts_; }
  /// From when a STATE was sent to the tick that felt its answer, us.
  const Histogram& latency() const noexcept { return latency_; }

 private:
  void take(const BridgeHello& hello, const BridgeAddress& from, double now_s) noexcept;
  void take(const BridgeProxy& proxy, const BridgeAddress& from, double now_s) noexcept;
  void take(const BridgeBye& bye, const BridgeAddress& from, double now_s) noexcept;
  template <class Other>
  void take(const Other&, const BridgeAddress&, double) noexcept;
  void send(const BridgeMessage& message, const BridgeAddress& to) noexcept;
  void say_bye(BridgeReason reason, const BridgeAddress& to) noexcept;
  BridgeHeader next_header(double now_s, std::uint32_t flags) noexcept;

  BridgeLink& link_;
  BridgeTerms terms_;
  BridgeWatch watch_;
  BridgeCounts counts_;
  Histogram latency_;
  BridgeProxy newest_;
  bool has_newest_ = false;
  bool is_stopped_ = false;
  BridgeAddress simulator_;  ///< none: BridgeAddress()
  std::uint64_t sequence_ = 0;
  double now_s_ = 0.0;
  double rate_hz_ = 0.0;
  double heard_s_ = 0.0;   ///< the last PROXY
  double period_s_ = 0.0;  ///< from one to the next, a running mean
  double refused_rate_hz_ = 0.0;
};

}  // namespace argil::haptics
