// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>

namespace argil::haptics {

struct BridgeWatchOptions {
  /// How long the last message is felt in full; usual 0.1, >= 0.
  double hold_s = 0.1;
  /// How long it then takes to fade out; usual 0.2, > 0.
  double ramp_out_s = 0.2;
  /// How long the force takes to come in, at the start and after a gap; usual 0.2, > 0.
  double ramp_in_s = 0.2;
};

/// Heartbeat of a simulator: how much of its force is felt, by how old its last message is. All of
/// it for hold_s, then down to nothing over ramp_out_s, and back over ramp_in_s. Times are the
/// servo's.
///
/// Threads  Realtime.
class BridgeWatch {
 public:
  explicit BridgeWatch(const BridgeWatchOptions& options) noexcept : options_(options) {
    assert(options.hold_s >= 0.0 && options.ramp_out_s > 0.0 && options.ramp_in_s > 0.0);
  }

  /// The simulator was heard, and answered what was sent at `asked_s`: an answer that comes late is
  /// as old as its question.
  void hear(double asked_s) noexcept {
    heard_s_ = asked_s;
    is_heard_ = true;
  }
  /// The simulator says stop, or has left: no force at once, until it is heard again.
  void cut() noexcept {
    is_heard_ = false;
    gain_ = 0.0;
  }

  /// The fraction that is felt at `now_s`, 0 to 1. Once a tick, with rising times.
  double tick(double now_s) noexcept;

  /// Of the last tick.
  double gain() const noexcept { return gain_; }
  /// Of the last message; infinite: none.
  double age_s(double now_s) const noexcept;
  /// Whether some of the last message may still be felt.
  bool is_alive(double now_s) const noexcept {
    return age_s(now_s) < options_.hold_s + options_.ramp_out_s;
  }

 private:
  BridgeWatchOptions options_;
  double heard_s_ = 0.0;
  double last_s_ = 0.0;
  double gain_ = 0.0;
  bool is_heard_ = false;
};

}  // namespace argil::haptics
