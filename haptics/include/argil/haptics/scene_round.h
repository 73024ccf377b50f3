// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/haptics/scene.h"

namespace argil::haptics {

struct SphereOptions {
  Vec3 center_mm;
  double radius_mm = 50.0;            ///< > 0
  double stiffness_n_per_m = 3000.0;  ///< >= 0. Beyond what a released handle can hold at 1 kHz
  double damping_n_s_per_m = 50.0;    ///< on the radial velocity; >= 0
};

/// Eq. 3.9: a solid ball. At its centre, where there is no direction, no force.
class SphereScene final : public ForceScene {
 public:
  explicit SphereScene(const SphereOptions& options) noexcept : options_(options) {}
  SceneForce force_at(const HandleState& place) const noexcept override;

 private:
  SphereOptions options_;
};

struct CylinderOptions {
  Vec3 center_mm;
  double radius_mm = 30.0;            ///< > 0
  double height_mm = 100.0;           ///< along z; > 0
  double stiffness_n_per_m = 3000.0;  ///< >= 0
  double damping_n_s_per_m = 50.0;    ///< on the radial velocity; >= 0
};

/// Eq. 3.10 to 3.14: a solid cylinder about z. Beyond |z - center| = height / 2 there is nothing, a
/// choice of ours (the report's goes on for ever); on the axis no force (eq. 3.12).
class CylinderScene final : public ForceScene {
 public:
  explicit CylinderScene(const CylinderOptions& options) noexcept : options_(options) {}
  SceneForce force_at(const HandleState& place) const noexcept override;

 private:
  CylinderOptions options_;
};

}  // namespace argil::haptics
