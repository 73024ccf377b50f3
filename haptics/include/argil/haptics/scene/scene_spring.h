// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"

namespace argil::haptics {

struct SpringOptions {
  /// Where the handle comes to rest; usual 0; within the workspace.
  Vec3 center_mm;
  /// k; usual 800, 0 to 3000. Above about 1850 it vibrates.
  double stiffness_n_per_m = 800.0;
  /// c; usual 10, 0 (free oscillation) to 20; more buzzes.
  double damping_n_s_per_m = 10.0;
};

/// A spring and a damper that draw the handle to a point, in all three directions: F = -k x - c v.
/// Without damping it is the free oscillation of section 3.3, from whose decay
/// estimate_free_oscillation reads mass and damping of the device.
///
/// Threads  as ForceScene.
/// Source   equations 3.1 and 4.1 of the Falcon report (docs/equations.md).
class SpringScene final : public ForceScene {
 public:
  explicit SpringScene(const SpringOptions& options = {}) noexcept;

  SceneForce force_at(const HandleState& handle) const noexcept override;

 private:
  SpringOptions options_;
};

}  // namespace argil::haptics
