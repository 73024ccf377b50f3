// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"

namespace argil::haptics {

enum class WallKind {
  rigid,      ///< equation 3.6: a constant force behind the surface
  linear,     ///< equation 3.7: spring and damper (default)
  nonlinear,  ///< equation 3.8: powers of depth and of speed
};

/// The Falcon report gives position, force of the rigid wall and exponents; it names no stiffness
/// and no damping, so that these are ours: those of its spring, and a nonlinear wall that 3 N enter
/// by 5.5 mm.
struct WallOptions {
  WallKind kind = WallKind::linear;
  /// Out of the wall; usual y; any length but 0.
  Vec3 normal{0.0, 1.0, 0.0};
  /// Solid where dot(unit normal, x) < offset; usual -20.
  double offset_mm = -20.0;

  /// Of the rigid wall; usual 20, > 0. Every value makes the handle chatter.
  double rigid_force_n = 20.0;

  /// k of the linear wall; usual 800, 0 to 3000. Above about 1850 it vibrates.
  double stiffness_n_per_m = 800.0;
  /// c of the linear wall; usual 10, 0 to 20; more buzzes.
  double damping_n_s_per_m = 10.0;

  /// k of the nonlinear wall, N / m^n, depth in metres; usual 1e5 with n = 2, >= 0. The stiffness
  /// felt under a force F is n (k F^(n - 1))^(1 / n); above about 1850 N/m it vibrates.
  double power_stiffness_n_per_m_to_n = 1e5;
  /// c of the nonlinear wall, N / (m/s)^m; usual 10, >= 0.
  double power_damping_n_per_mps_to_m = 10.0;
  /// n; usual 2, 1 (linear) to 4.
  double depth_exponent = 2.0;
  /// m; usual 2, 1 (linear) to 4.
  double speed_exponent = 2.0;

  /// Linear and nonlinear: the wall never pulls; usual true. False is the equations as printed,
  /// whose damper holds a handle that leaves.
  bool one_sided = true;
};

/// What a rigid wall reports as its stiffness instead of infinity.
inline constexpr double kRigidStiffnessNPerM = 1e6;

/// A flat wall without friction: the force is along the normal.
///
/// On the surface itself the rigid wall gives no force, as printed (y < y_r), and the others touch
/// (y <= y_r): there the damper may push.
///
/// Threads  as ForceScene.
/// Source   equations 3.6 to 3.8 of the Falcon report (docs/equations.md).
class WallScene final : public ForceScene {
 public:
  explicit WallScene(const WallOptions& options = {}) noexcept;

  SceneForce force_at(const HandleState& handle) const noexcept override;

 private:
  SceneForce power_law(double depth_mm, double speed_mm_per_s) const noexcept;

  WallOptions options_;  ///< with a unit normal
};

}  // namespace argil::haptics
