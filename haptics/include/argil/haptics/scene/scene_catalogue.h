// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"

namespace argil::haptics {

/// A scene of the Novint Falcon report (docs/equations.md), in the device's frame, mm. It needs
/// nothing but a device.
struct SceneEntry {
  /// Lower case and hyphens; options and recordings use it, so it never changes.
  const char* name;
  /// One line, with the equation.
  const char* about;
  /// Where a hand can begin and feel nothing yet.
  Vec3 start_mm;
  std::unique_ptr<ForceScene> (*make)();
  /// The stiffest that a direct coupling feels below 8 N.
  double most_stiffness_n_per_m;
};

/// All of them, in the order of the Falcon report. The clay (ClayScene) is not among them.
std::span<const SceneEntry> scene_catalogue() noexcept;

/// The scene of that name; null when there is none.
const SceneEntry* find_scene(std::string_view name) noexcept;

}  // namespace argil::haptics
