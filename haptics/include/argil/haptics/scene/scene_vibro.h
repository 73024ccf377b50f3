// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"

namespace argil::haptics {

struct VibroOptions {
  /// Of the vibration; usual 0.1, 0 to 1. More shakes the handle off the surface.
  double amplitude_n = 0.1;

  /// Of the texture; usual 1, > 0. Where it is passed faster than half the servo's rate it aliases.
  double wavelength_mm = 1.0;

  /// How far the handle may move to and fro before it slides; usual 0.1, >= 0. Less than a step or
  /// two of the device's encoders (0.03 to 0.06 mm) makes a handle at rest buzz.
  double play_mm = 0.1;
};

/// A texture over another scene: while something is touched, a sine of the distance slid along it
/// is added to the force, in the force's direction. At speed v it vibrates at v / wavelength.
///
/// The vibration is never larger than the force, so that it neither pulls nor starts with a step.
/// It does not add to the stiffness that is reported. To turn it off, use the other scene itself.
///
/// Threads  as ForceScene.
/// Source   section 3.6.4, "hybrid feedback", of the Falcon report (docs/equations.md).
class VibroScene final : public ForceScene {
 public:
  /// `touched` must outlive this, and nobody else may call its begin_tick.
  explicit VibroScene(ForceScene& touched, const VibroOptions& options = {}) noexcept;

  void begin_tick(const HandleState& handle) noexcept override;
  SceneForce force_at(const HandleState& handle) const noexcept override;
  /// The other's: a vibration is not of its surface.
  Vec3 touch_n(const HandleState& handle) const noexcept override {
    return touched_.touch_n(handle);
  }

  Vec3 aid_n(const HandleState& tool, const AidTick& tick) noexcept override {
    return touched_.aid_n(tool, tick);
  }
  void end_tick(const HandleState& tool) noexcept override { touched_.end_tick(tool); }
  void forget_motion() noexcept override;
  WindowStamp window_stamp() const noexcept override { return touched_.window_stamp(); }
  /// One less than the other's: begin_tick asks once.
  int most_queries() const noexcept override;

  /// The distance slid, as a fraction of a wavelength, 0 to 1.
  double phase() const noexcept { return phase_; }

 private:
  ForceScene& touched_;
  VibroOptions options_;
  Vec3 dragged_mm_;  ///< follows the handle within the play; what it moves along the surface counts
  double phase_ = 0.0;
  bool in_contact_ = false;
};

}  // namespace argil::haptics
