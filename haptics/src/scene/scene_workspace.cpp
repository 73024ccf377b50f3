// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_workspace.h"

#include <algorithm>
#include <cassert>

#include "scene/contact.h"

namespace argil::haptics {
namespace {

Vec3 nearest_in(const Box3& box, const Vec3& p) noexcept {
  return {std::clamp(p.x, box.min.x, box.max.x), std::clamp(p.y, box.min.y, box.max.y),
          std::clamp(p.z, box.min.z, box.max.z)};
}

}  // namespace

WorkspaceScene::WorkspaceScene(const WorkspaceOptions& options) noexcept : options_(options) {
  assert(!options.reach_mm.empty());
  assert(options.wall_stiffness_n_per_m >= 0.0 && options.wall_damping_n_s_per_m >= 0.0);
}

SceneForce WorkspaceScene::force_at(const HandleState& handle) const noexcept {
  if (options_.wall_stiffness_n_per_m <= 0.0) {
    return {};
  }
  const HandleState at = bounded(handle);
  const Vec3 inwards = nearest_in(options_.reach_mm, at.position_mm) - at.position_mm;
  const double depth = length(inwards);
  if (!(depth > 0.0)) {
    return {};
  }
  return contact({options_.wall_stiffness_n_per_m, options_.wall_damping_n_s_per_m}, depth,
                 normalized(inwards), at.velocity_mm_per_s);
}

}  // namespace argil::haptics
