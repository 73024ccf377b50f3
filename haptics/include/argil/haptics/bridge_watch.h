// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil::haptics {

struct BridgeWatchOptions {
  double hold_s = 0.1;      ///< without news what was last said is felt on; >= 0
  double ramp_out_s = 0.2;  ///< and then less and less, down to nothing; > 0
  double ramp_in_s = 0.2;   ///< from nothing to all, at the start and after a gap; > 0
};

/// How much of a simulator's force is felt, by how old its last word is: all for hold_s, then
/// down to nothing over ramp_out_s, and back over ramp_in_s. Times are the servo's.
///
/// Threads  Realtime.
class BridgeWatch {
 public:
  explicit BridgeWatch(const BridgeWatchOptions& options) noexcept : options_(options) {}

  /// The simulator was heard, and what it says answers `asked_s`: an answer that comes late is as
  /// old as its question.
  void hear(double asked_s) noexcept {
    heard_s_ = asked_s;
    is_heard_ = true;
  }
  /// It says stop, or has left: nothing at once, until it is heard again.
  void cut() noexcept {
    is_heard_ = false;
    gain_ = 0.0;
  }

  /// The share, 0 to 1, at `now_s`: once a tick, times rising.
  double tick(double now_s) noexcept;

  double gain() const noexcept { return gain_; }  ///< of the last tick
  double age_s(double now_s) const noexcept;      ///< of its last word; infinite: none
  bool is_alive(double now_s) const noexcept {    ///< some of it may still be felt
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
