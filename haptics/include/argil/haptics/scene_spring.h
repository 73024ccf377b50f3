// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/haptics/scene.h"

namespace argil::haptics {

struct SpringOptions {
  double stiffness_n_per_m = 800.0;  ///< k; >= 0
  double damping_n_s_per_m = 10.0;   ///< c; >= 0. Critical for a Falcon is 38
  Vec3 center_mm;
};

/// Eq. 3.1 and 4.1 of the Falcon report: F = -k x - c v about a place.
class SpringScene final : public ForceScene {
 public:
  explicit SpringScene(const SpringOptions& options) noexcept : options_(options) {}
  SceneForce force_at(const HandleState& place) const noexcept override;

 private:
  SpringOptions options_;
};

struct WorkspaceOptions {
  Vec3 min_mm{-50.0, -70.0, -70.0};  ///< what the report's user could reach
  Vec3 max_mm{50.0, 80.0, 80.0};
  double stiffness_n_per_m = 0.0;  ///< of a wall around it; 0: none, as in the report
};

/// Section 3.1: nothing to feel inside the reach; outside of it a wall, when wanted.
class WorkspaceScene final : public ForceScene {
 public:
  explicit WorkspaceScene(const WorkspaceOptions& options) noexcept : options_(options) {}
  SceneForce force_at(const HandleState& place) const noexcept override;

 private:
  WorkspaceOptions options_;
};

}  // namespace argil::haptics
