// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/triple_buffer.h"
#include "argil/core/vec3.h"
#include "argil/haptics/simulation/hand_model.h"

namespace argil::haptics {

/// What a person wants of a simulated hand.
struct HandTarget {
  /// Where the handle should be, in the device's frame.
  Vec3 place_mm;
  /// False: lets go of the handle.
  bool holds = true;
  /// Holds the button that works the clay.
  bool is_active = false;
};

/// A hand that a person leads from another thread, with a mouse that reports 60 times a second or
/// whenever it moves.
///
/// A newly seen target is approached in a straight line within the time between the last two
/// targets, so that the hand arrives when the next one is due. 1/60 s stands for that time where it
/// was less than 1 ms or more than 50 ms (the mouse had rested), and a jump takes as long as at
/// 1 m/s. The line's corners are rounded by a critically damped filter of second order: position
/// and velocity are continuous, the velocity is that of the position, and at a steady speed it is
/// that speed, to a tenth at 60 Hz, where a frame is seen up to a tick late. Altogether the hand
/// lags by one interval and 10 ms, 27 ms at 60 Hz, and rests on the target 40 ms after that.
/// Holding and the button take effect at once.
///
/// Threads  Realtime: `set` by one thread, `at` by the servo's; wait-free on both sides
///          (GuidedHandStress.*). `begin_at` and `start_mm` while neither is called.
/// Cost     `at` 20 ns.
class GuidedHand final : public HandSource {
 public:
  explicit GuidedHand(const Vec3& start_mm = {}) noexcept { begin_at(start_mm); }

  /// The newest target. One whose position is not finite is ignored as a whole.
  void set(const HandTarget& target) noexcept;

  HandIntent at(double time_s) noexcept override;
  Vec3 start_mm() const noexcept override { return place_mm_; }

  /// Rests at this finite position, holding, until the next `set`; the servo's clock may start
  /// anew.
  void begin_at(const Vec3& place_mm) noexcept;

 private:
  void take(double time_s) noexcept;
  void move(double elapsed_s) noexcept;

  TripleBuffer<HandTarget> targets_;
  HandTarget target_;         ///< the last one seen
  double target_s_ = 0.0;     ///< when
  Vec3 line_mm_;              ///< on the straight line
  Vec3 line_mm_per_s_;        ///< along it
  double line_left_s_ = 0.0;  ///< until it ends in the target
  Vec3 place_mm_;             ///< where the hand means to be: line_mm_ filtered
  Vec3 velocity_mm_per_s_;    ///< of place_mm_
  double time_s_ = 0.0;       ///< of the last `at`
  bool has_time_ = false;     ///< there was one
};

}  // namespace argil::haptics
