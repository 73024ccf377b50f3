// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "argil/core/vec3.h"
#include "argil/haptics/scene.h"

namespace argil::haptics {

/// A scene of the Falcon report, which needs nothing but a device: in the device's frame, mm.
struct SceneEntry {
  const char* name;   ///< lower case and hyphens; stays what it is
  const char* about;  ///< one line, with the equation
  Vec3 start_mm;      ///< where a hand can begin and feel nothing yet
  std::unique_ptr<ForceScene> (*make)();
  double most_stiffness_n_per_m;  ///< that a direct coupling feels, below 8 N
};

/// All of them, in the order of the report. The clay is not among them.
std::span<const SceneEntry> scene_catalogue() noexcept;

/// Null when there is none of that name.
const SceneEntry* find_scene(std::string_view name) noexcept;

}  // namespace argil::haptics
