// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "argil/core/vec3.h"

namespace argil::haptics {

struct PassivityOptions {
  /// False: only observes (default).
  bool controls = false;
  /// Most damping of the controller in a tick; usual 20, > 0. One count of the encoder within a
  /// tick of 1 ms is 60 mm/s: 20 chatters by 3 N, 100 by 12 N.
  double most_damping_n_s_per_m = 20;
};

/// Passivity observer and controller in the time domain: adds up the energy that the servo gives to
/// the hand, and when it has given more than it ever took, damps the handle by just as much. The
/// energy is that of the force which acted: with one tick of delay the force before the last.
/// Counted with the last one, as published, the observer misses what the delay gives, and a wall of
/// 8 kN/m keeps cycling by 2.5 mm (PassivityController.CalmsAWallThatCycles).
///
/// Threads  Realtime.
/// Source   B. Hannaford, J.-H. Ryu, "Time-domain passivity control of haptic interfaces", IEEE
///          Trans. Robotics and Automation 18 (2002). Ours knows the delay, and bounds the damping
///          of a tick.
class PassivityController {
 public:
  static constexpr int kMostDelayTicks = 16;

  /// `delay_ticks`: from a force written to the force held; clamped to 0 to kMostDelayTicks.
  PassivityController(const PassivityOptions& options, int delay_ticks) noexcept;

  /// The force to give instead of `force_n` for a tick of `period_s`, the handle having moved by
  /// `moved_mm` (finite) since the last one.
  Vec3 tick(const Vec3& force_n, const Vec3& moved_mm, double period_s) noexcept;

  /// What the device was really given in this tick, which limits may have made another force than
  /// `tick` returned.
  void gave(const Vec3& force_n) noexcept { written_n_[0] = force_n; }

  /// Energy given to the hand so far, above 0 when the servo is active; with the controller on,
  /// less what it has taken back.
  double given_nmm() const noexcept { return given_nmm_; }
  /// The largest that given_nmm has been since construction.
  double most_given_nmm() const noexcept { return most_given_nmm_; }
  /// Forgets forces and energy: for a jump of the handle. most_given_nmm stays.
  void reset() noexcept;

 private:
  PassivityOptions options_;
  std::array<Vec3, kMostDelayTicks + 1> written_n_{};  ///< newest first
  std::size_t delay_;
  double given_nmm_ = 0.0;
  double most_given_nmm_ = 0.0;
};

}  // namespace argil::haptics
