// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>

namespace argil::haptics {

struct RunningDecrementOptions {
  /// A turn counts once the position has come back from it by this; usual two counts of the
  /// encoder, > 0. Less takes a count that comes and goes for a swing.
  double least_swing_mm = 0.12;
  /// Slower swings are a hand's own motion; usual 4, > 0.
  double least_hz = 4.0;
  /// Faster ones are noise; usual 100, > least_hz.
  double most_hz = 100.0;
};

/// The logarithmic decrement of a swing while it goes on: from one turn of the position to the
/// next, with no memory but of the last three.
///
/// Notation  a turn is a peak or a valley; a stroke leads from one turn to the next and has a
///           height and a time, half a period. delta = ln(peak / next peak); over strokes, since
///           these fall by delta / 2 each whatever the swing's middle is.
/// Accuracy  of a sampled decay with zeta 0.02 to 0.3, 5 to 20 Hz at 1 kHz: 1 % of zeta
///           (RunningDecrement.*). A turn is the parabola through its three samples.
/// Threads   Realtime.
/// Source    eq. 3.2 to 3.4 of the Falcon report (docs/equations.md); FreeOscillation has the same
///           of a recorded swing. Ours takes both turns of a period, and so answers after half.
class RunningDecrement {
 public:
  explicit RunningDecrement(const RunningDecrementOptions& options) noexcept : options_(options) {
    assert(options.least_swing_mm > 0.0 && options.least_hz > 0.0);
    assert(options.most_hz > options.least_hz);
  }

  /// The position `period_s` (> 0) after the last one. True when a stroke has ended that follows
  /// another one, both of a swing: the values below are then new.
  bool add(double position_mm, double period_s) noexcept;

  /// delta, below 0 where the swing grows: over the last period, or twice that of the last half
  /// where the swing is not older.
  double decrement() const noexcept { return decrement_; }
  /// zeta = delta / sqrt(4 pi^2 + delta^2).
  double damping_ratio() const noexcept;
  /// Of the swing itself: the damped frequency.
  double omega_rad_per_s() const noexcept { return omega_rad_per_s_; }
  /// Since the last turn of a swing; infinite before the first.
  double since_turn_s() const noexcept;
  /// Half a period of the slowest swing.
  double slowest_stroke_s() const noexcept { return 0.5 / options_.least_hz; }

  /// Forgets the swing.
  void reset() noexcept { *this = RunningDecrement(options_); }

 private:
  struct Turn {
    double position_mm = 0.0;
    double time_s = 0.0;
  };
  Turn extreme() const noexcept;
  bool end_stroke(const Turn& turn) noexcept;
  void start_towards(double direction, double position_mm) noexcept;

  RunningDecrementOptions options_;
  double time_s_ = 0.0;
  double last_mm_ = 0.0;
  double direction_ = 0.0;  ///< of the stroke: 1 rising, -1 falling, 0 not known yet
  double low_mm_ = 0.0;     ///< while it is not known
  double high_mm_ = 0.0;
  // The farthest sample of the stroke so far: reached, left again, and its neighbours.
  double far_mm_ = 0.0;
  double reached_s_ = 0.0;
  double left_s_ = 0.0;
  double before_mm_ = 0.0;
  double after_mm_ = 0.0;
  Turn turn_;  ///< the last one
  bool has_position_ = false;
  bool has_turn_ = false;
  int strokes_ = 0;  ///< of the swing, at most 3
  double heights_mm_[3] = {};
  double times_s_[2] = {};
  double decrement_ = 0.0;
  double omega_rad_per_s_ = 0.0;
};

}  // namespace argil::haptics
