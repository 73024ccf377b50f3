// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/haptics/scene.h"

namespace argil::haptics {

struct SphereOptions {
  Vec3 center_mm;           ///< usual 0
  double radius_mm = 50.0;  ///< R; usual 50; > 0
  double stiffness_n_per_m =
      3000.0;  ///< k; usual 3000; >= 0, above 1850 it needs a hand or damping
  double damping_n_s_per_m =
      50.0;  ///< c; usual 50; >= 0, above 20 a measured velocity makes it buzz
};

/// A solid sphere, equation 3.9: F = -k (d - R) - c d', along the line from its middle.
///
/// The damper works on the radial velocity alone, so sliding is free, and never pulls. In the very
/// middle there is no direction and no force.
class SphereScene final : public ForceScene {
 public:
  explicit SphereScene(const SphereOptions& options = {}) noexcept;

  SceneForce force_at(const HandleState& place) const noexcept override;

 private:
  SphereOptions options_;
};

struct CylinderOptions {
  Vec3 center_mm;                     ///< the middle of its axis; usual 0
  double radius_mm = 30.0;            ///< R; usual 30; > 0
  double height_mm = 100.0;           ///< H; usual 100; > 0
  double stiffness_n_per_m = 3000.0;  ///< k; the sphere's, the report names none; >= 0
  double damping_n_s_per_m = 50.0;    ///< c; the same
};

/// A solid cylinder along z, equations 3.10 to 3.14: away from its axis inside, no force at the
/// distance R and more.
///
/// The printed normal (3.12) points inwards and distance_to_surface = R - d is positive inside, so
/// that their product with -k points outwards; here the normal points outwards and the push is
/// along it, which is the same force. The report says nothing of the ends: beyond |z| = H / 2 there
/// is no force, and within them no cap pushes along z, so a handle that enters through an end is
/// pushed aside. On the axis there is no force. The damper never pulls.
class CylinderScene final : public ForceScene {
 public:
  explicit CylinderScene(const CylinderOptions& options = {}) noexcept;

  SceneForce force_at(const HandleState& place) const noexcept override;

 private:
  CylinderOptions options_;
};

}  // namespace argil::haptics
