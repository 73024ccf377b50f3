// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/haptics/scene.h"

namespace argil::haptics {

struct WorkspaceOptions {
  /// What the handle of the report reached, in mm; y and z are not symmetric. Not empty.
  Box3 reach_mm{{-50.0, -70.0, -70.0}, {50.0, 80.0, 80.0}};

  /// A soft wall around the box; usual 0, off; to be felt 200, to 1850.
  double wall_stiffness_n_per_m = 0.0;
  double wall_damping_n_s_per_m = 0.0;  ///< usual 0; 0 to 20; without a wall it does nothing
};

/// Section 3.1: nothing to feel, so that the handle can be moved to its ends and the reach
/// recorded. With the wall a handle outside the box is pushed to the nearest place of it.
class WorkspaceScene final : public ForceScene {
 public:
  explicit WorkspaceScene(const WorkspaceOptions& options = {}) noexcept;

  SceneForce force_at(const HandleState& place) const noexcept override;

  /// Whether a place is in the box, its faces included.
  bool is_inside(const Vec3& position_mm) const noexcept;

 private:
  WorkspaceOptions options_;
};

}  // namespace argil::haptics
