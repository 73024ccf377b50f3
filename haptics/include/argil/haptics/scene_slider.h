// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/haptics/scene.h"
#include "argil/haptics/scene_round.h"

namespace argil::haptics {

struct SliderOptions {
  double offset_mm = 40.0;            ///< middle height, as eq. 3.23 prints it
  double amplitude_mm = 3.0;          ///< A, not given by the report
  double frequency_per_m = 40.0;      ///< f_y, not given: grooves 25 mm apart, slopes up to 37 deg
  double stiffness_n_per_m = 1500.0;  ///< k_spring; >= 0
  double damping_n_s_per_m = 5.0;     ///< on the velocity along the normal; >= 0
};

/// Eq. 3.23 to 3.27: grooves along x, solid below z = A sin(2 pi f_y y) + offset. The offset Delta
/// of eq. 3.26 is taken as the vertical depth projected on the normal: the distance to the
/// surface's tangent plane.
class SliderScene final : public ForceScene {
 public:
  explicit SliderScene(const SliderOptions& options) noexcept : options_(options) {}
  SceneForce force_at(const HandleState& place) const noexcept override;

  double height_mm(double y_mm) const noexcept;  ///< eq. 3.23
  double slope(double y_mm) const noexcept;      ///< eq. 3.25
  Vec3 normal(double y_mm) const noexcept;       ///< eq. 3.24

 private:
  SliderOptions options_;
};

struct ClickOptions {
  /// With the printed offset of 40 mm the ball of eq. 3.28 would lie buried below the slider, and
  /// nobody could press it: here the slider lies through the ball's middle.
  SliderOptions slider{-20.0, 3.0, 40.0, 1500.0, 5.0};
  SphereOptions ball{{0.0, -20.0, -20.0}, 15.0, 8000.0, 0.0};
};

/// Eq. 3.28: the slider with a hard ball in it; what both push adds up.
class ClickScene final : public ForceScene {
 public:
  explicit ClickScene(const ClickOptions& options) noexcept
      : slider_(options.slider), ball_(options.ball) {}
  SceneForce force_at(const HandleState& place) const noexcept override;

 private:
  SliderScene slider_;
  SphereScene ball_;
};

}  // namespace argil::haptics
