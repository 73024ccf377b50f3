// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "argil/core/vec3.h"
#include "argil/haptics/scene/scene.h"
#include "argil/haptics/scene/scene_parameters.h"

namespace argil::haptics {

/// A scene of the Novint Falcon report (docs/equations.md), in the device's frame, mm. It needs
/// nothing but a device.
struct SceneEntry {
  /// Lower case and hyphens; options and recordings use it, so it never changes.
  const char* name;
  /// One line, with the equation.
  const char* about;
  std::span<const SceneParameter> parameters;
  /// Where a hand can begin and feel nothing yet.
  Vec3 (*start_mm)(const SceneValues& values);
  /// Of values of these parameters. Radii of pebbles count as at most 1.5 spacings.
  std::unique_ptr<ForceScene> (*make)(const SceneValues& values);
  /// The stiffest that a direct coupling feels below 8 N.
  double (*most_stiffness_n_per_m)(const SceneValues& values);
};

/// All of them, in the order of the Falcon report. The clay (ClayScene) is not among them.
std::span<const SceneEntry> scene_catalogue() noexcept;

/// The scene of that name; null when there is none.
const SceneEntry* find_scene(std::string_view name) noexcept;

}  // namespace argil::haptics
