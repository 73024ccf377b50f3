// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"
#include "argil/haptics/scene/scene_round.h"

namespace argil::haptics {

/// The Falcon report gives the offset. Amplitude and frequency are ours: grooves 10 mm deep and
/// 50 mm apart, three in reach, with flanks of 32 degrees, steep enough to guide and not to jam.
struct SliderOptions {
  /// Height of the middle of the waves; usual 40.
  double offset_mm = 40.0;
  /// A; usual 5, 0 (flat) to 20.
  double amplitude_mm = 5.0;
  /// f_y; usual 20, 0 to 500.
  double frequency_per_m = 20.0;
  /// k_spring; usual 1500, 0 to 3000.
  double stiffness_n_per_m = 1500.0;
  /// c_damping; usual 5, 0 to 20; more buzzes.
  double damping_n_s_per_m = 5.0;
};

/// A slider: solid below z = A sin(2 pi f_y y) + offset. Its grooves run along x; a handle that is
/// pressed down settles in one and moves along it freely, by the shape alone.
///
/// Delta of 3.26 is the offset straight down to the surface, (0, 0, z - z_surface), projected on
/// the normal, so that the spring pushes along the normal with k depth n_z: nearly k times the
/// distance. The damper (3.27) works along the normal and never pulls.
///
/// Threads  as ForceScene.
/// Source   equations 3.23 to 3.27 of the Falcon report (docs/equations.md).
class SliderScene final : public ForceScene {
 public:
  explicit SliderScene(const SliderOptions& options = {}) noexcept;

  SceneForce force_at(const HandleState& handle) const noexcept override;

  /// z_surface.
  double height_mm(double y_mm) const noexcept;

  /// The unit normal of equation 3.24.
  Vec3 normal_at(double y_mm) const noexcept;

 private:
  SliderOptions options_;
  double wave_per_mm_ = 0.0;  ///< 2 pi f_y
};

/// With the printed offset of 40 mm the whole sphere lies 45 mm under the slider and is never
/// felt. At -6 mm it stands 4 mm out of the bottom of the groove at y = -12.5, as a button does.
struct ClickOptions {
  SliderOptions slider{.offset_mm = -6.0};
  SphereOptions sphere{.center_mm = {0.0, -20.0, -20.0},
                       .radius_mm = 15.0,
                       .stiffness_n_per_m = 8000.0,  ///< a light hand chatters on it
                       .damping_n_s_per_m = 0.0};
};

/// The slider with a sphere to click on: where both touch, forces are summed, and stiffnesses too,
/// which is an upper bound there.
///
/// Threads  as ForceScene.
/// Source   equation 3.28 of the Falcon report (docs/equations.md).
class ClickScene final : public ForceScene {
 public:
  explicit ClickScene(const ClickOptions& options = {}) noexcept;

  SceneForce force_at(const HandleState& handle) const noexcept override;

 private:
  SliderScene slider_;
  SphereScene sphere_;
};

}  // namespace argil::haptics
