// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"

namespace argil::haptics {

struct WorkspaceOptions {
  /// What the handle reached in the Falcon report; y and z are not symmetric. Not empty.
  Box3 reach_mm{{-50.0, -70.0, -70.0}, {50.0, 80.0, 80.0}};

  /// Of a soft wall around the box; usual 0 (off), to be felt 200, to 1850.
  double wall_stiffness_n_per_m = 0.0;
  /// Usual 0, 0 to 20. Without a wall it does nothing.
  double wall_damping_n_s_per_m = 0.0;
};

/// Nothing to feel, so that the handle can be moved to its ends and the reach recorded. With the
/// wall a handle outside the box is pushed to the nearest point of it.
///
/// Threads  as ForceScene.
/// Source   section 3.1 of the Falcon report (docs/equations.md).
class WorkspaceScene final : public ForceScene {
 public:
  explicit WorkspaceScene(const WorkspaceOptions& options = {}) noexcept;

  SceneForce force_at(const HandleState& handle) const noexcept override;

 private:
  WorkspaceOptions options_;
};

}  // namespace argil::haptics
