// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/triple_buffer.h"
#include "argil/core/vec3.h"
#include "argil/haptics/hand_model.h"

namespace argil::haptics {

/// What a person wants of a simulated hand.
struct HandTarget {
  Vec3 place_mm;           ///< where the handle should be, in the device's frame
  bool holds = true;       ///< false: lets go of the handle
  bool is_active = false;  ///< holds the button that works the clay
};

/// A hand that a person leads from another thread, with a mouse that speaks 60 times a second or
/// whenever it moves.
///
/// Law: a newly seen target is approached in a straight line at the speed of the last two, that is
/// in the time between them, so that the hand comes to one when the next is due. 1/60 s stands for
/// that time where it was less than 1 ms or more than 50 ms (the mouse had rested), and a jump
/// takes as long as 1 m/s asks for. The line's corners are rounded by a critically damped filter of
/// second order: place and velocity are continuous, the velocity is that of the place, and at a
/// steady speed it is that speed, to a tenth at 60 Hz, whose frames are seen to a tick. In all the
/// hand lags by one interval and 10 ms, 27 ms at 60 Hz, and rests on the target 40 ms after that.
/// Holding and the button take effect at once.
///
/// Threads  Realtime: `set` by one thread, `at` by the servo's; wait-free on both sides
///          (GuidedHandStress.*). `begin_at` and `start_mm` while neither is called.
/// Cost     `at` 20 ns.
class GuidedHand final : public HandSource {
 public:
  explicit GuidedHand(const Vec3& start_mm = {}) noexcept { begin_at(start_mm); }

  /// A place that is no number is ignored, and the rest with it.
  void set(const HandTarget& target) noexcept;

  HandIntent at(double time_s) noexcept override;
  Vec3 start_mm() const noexcept override { return place_mm_; }

  /// Rests here, holding, until the next `set`; the servo's clock may start anew.
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
  Vec3 place_mm_;             ///< where the hand means to be: line_mm_ through the filter
  Vec3 velocity_mm_per_s_;    ///< of place_mm_
  double time_s_ = 0.0;       ///< of the last `at`
  bool has_time_ = false;     ///< there was one
};

}  // namespace argil::haptics
