// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"

namespace argil::haptics {

struct SphereOptions {
  /// Usual 0.
  Vec3 center_mm;
  /// R; usual 50, > 0.
  double radius_mm = 50.0;
  /// k; usual 3000, >= 0. Above 1850 it vibrates without a hand or damping.
  double stiffness_n_per_m = 3000.0;
  /// c; usual 50, >= 0. Above 20 a measured velocity makes it buzz.
  double damping_n_s_per_m = 50.0;
};

/// A solid sphere: F = -k (d - R) - c d', along the line from its middle.
///
/// The damper works on the radial velocity alone, so that sliding is free, and never pulls. In the
/// very middle there is no direction and no force.
///
/// Threads  as ForceScene.
/// Source   equation 3.9 of the Falcon report (docs/equations.md).
class SphereScene final : public ForceScene {
 public:
  explicit SphereScene(const SphereOptions& options = {}) noexcept;

  SceneForce force_at(const HandleState& handle) const noexcept override;

 private:
  SphereOptions options_;
};

struct CylinderOptions {
  /// The middle of its axis; usual 0.
  Vec3 center_mm;
  /// R; usual 30, > 0.
  double radius_mm = 30.0;
  /// H; usual 100, > 0.
  double height_mm = 100.0;
  /// k; >= 0. The Falcon report names none: this is the sphere's.
  double stiffness_n_per_m = 3000.0;
  /// c; >= 0; the same.
  double damping_n_s_per_m = 50.0;
};

/// A solid cylinder along z that pushes away from its axis; no force at the distance R and more.
///
/// The printed normal (3.12) points inwards and distance_to_surface = R - d is positive inside, so
/// that their product with -k points outwards; here the normal points outwards and the push is
/// along it, which is the same force. The Falcon report says nothing of the ends: here, beyond
/// |z| = H / 2 there is no force, and within them no cap pushes along z, so that a handle which
/// enters through an end is pushed aside. On the axis there is no force. The damper never pulls.
///
/// Threads  as ForceScene.
/// Source   equations 3.10 to 3.14 of the Falcon report (docs/equations.md).
class CylinderScene final : public ForceScene {
 public:
  explicit CylinderScene(const CylinderOptions& options = {}) noexcept;

  SceneForce force_at(const HandleState& handle) const noexcept override;

 private:
  CylinderOptions options_;
};

}  // namespace argil::haptics
