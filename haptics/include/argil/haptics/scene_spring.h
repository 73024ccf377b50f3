// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/haptics/scene.h"

namespace argil::haptics {

struct SpringOptions {
  Vec3 center_mm;  ///< where the handle comes to rest; usual 0; within the workspace
  double stiffness_n_per_m = 800.0;  ///< k; usual 800; 0 to 3000, above about 1850 it vibrates
  double damping_n_s_per_m = 10.0;   ///< c; usual 10; 0 (free oscillation) to 20
};

/// A spring and a damper that draw the handle to a place, in all three directions: equations 3.1
/// and 4.1, F = -k x - c v. With no damping the free oscillation of section 3.3, from whose decay
/// mass and damping of the device are read.
class SpringScene final : public ForceScene {
 public:
  explicit SpringScene(const SpringOptions& options = {}) noexcept;

  SceneForce force_at(const HandleState& place) const noexcept override;

 private:
  SpringOptions options_;
};

}  // namespace argil::haptics
