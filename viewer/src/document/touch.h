// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "argil/core/vec3.h"
#include "argil/engine/clay.h"
#include "argil/haptics/force/tool_force.h"

#include "picture/surface_probe.h"

namespace argil::viewer {

/// All numbers of a material, to compare two.
inline std::array<double, 6> numbers_of(const haptics::ForceMaterial& material) noexcept {
  return {material.surface_force_n, material.exponent,          material.skin_mm,
          material.clamp_ratio,     material.viscosity_force_n, material.viscosity_s_per_mm};
}

/// A tool that is held still, pressed `press_mm` into the clay where a ray meets it. The position
/// of `tool` is not read.
struct Touch {
  haptics::ForceTool tool;
  haptics::ForceMaterial material;
  double press_mm = 0.0;
  friend bool operator==(const Touch& a, const Touch& b) {
    return a.tool.shape == b.tool.shape && a.tool.radii_mm == b.tool.radii_mm &&
           a.press_mm == b.press_mm && numbers_of(a.material) == numbers_of(b.material);
  }
};

/// The force of the clay on a tool.
struct FeltForce {
  Vec3 tool_mm;  ///< its centre
  double radius_mm = 0.0;
  Vec3 force_n;
};

/// The centre of a tool that is pressed `press_mm` into the surface; below 0 it is held above.
Vec3 pressed_position(const haptics::ForceTool& tool, const SurfaceHit& hit, double press_mm);

/// The force on a tool that is held still there, by the energy law, as the servo evaluates it: on a
/// field window of its own, with the same lattice.
/// Returns  nothing for a tool that no window serves: far larger than the clay, or too long or
/// flat. Threads  the document thread. Cost  reading the window, about a millisecond.
std::optional<FeltForce> feel(const Clay& clay, const SurfaceHit& hit, const Touch& touch);

/// What is drawn of a force: what was drawn `before`, until ring or arrow have moved by half a
/// pixel. A hand that is held still trembles by less, and each new picture costs tens of
/// milliseconds where no graphics card draws it. `pixel_mm`: of a pixel where it is drawn;
/// `arrow_mm_per_n`: how long arrows are.
std::optional<FeltForce> steadied(const std::optional<FeltForce>& now,
                                  const std::optional<FeltForce>& before, double pixel_mm,
                                  double arrow_mm_per_n) noexcept;

}  // namespace argil::viewer
