// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "argil/engine/stroke.h"
#include "argil/engine/tool.h"

#include "input_event.h"
#include "surface_probe.h"

namespace argil::viewer {

/// An action as a person chooses it.
struct ActionInfo {
  Action action = Action::add;
  const char* name = "";   ///< as scripts have it
  const char* title = "";  ///< as panels have it
  const char* about = "";  ///< one line
  int key = 0;             ///< letter that chooses it; 0: none
};
/// All, in the order in which panels show them.
std::span<const ActionInfo> action_infos() noexcept;
const ActionInfo& info_of(Action action) noexcept;

/// The brush as a person sets it.
struct Brush {
  Action action = Action::inflate;
  Shape shape = Shape::ball;  ///< ball or box
  double radius_mm = 5.0;
  double radius_pixels = 60.0;
  bool is_screen_size = false;  ///< radius_pixels counts, where the stroke begins
  double strength = 0.5;        ///< 0.01 to 1; for add and carve the share of the radius that the
                                ///< tool stands out of the surface, or dips in
  bool is_inverted = false;
  double pressure_to_strength = 1.0;
  double pressure_to_size = 0.0;
  double spacing = 0.25;
  double steady_mm = 0.0;
  double hold_s = 0.0;
  Mirror mirror;
  Radial radial;
};

inline constexpr double kLeastRadiusMm = 0.01;
inline constexpr double kMostRadiusMm = 1000.0;
inline constexpr double kLeastStrength = 0.01;

/// What the keys held when a stroke begins make of a brush: Ctrl the opposite, Shift smooth.
Brush brush_with(const Brush& brush, const Modifiers& modifiers) noexcept;

/// The radius on a surface where a pixel spans `pixel_mm`.
double radius_on(const Brush& brush, double pixel_mm) noexcept;

Tool tool_of(const Brush& brush, double radius_mm) noexcept;
StrokeStyle style_of(const Brush& brush) noexcept;

/// Where the tool's centre lies for a brush on the surface, its z axis along the normal: what adds
/// or carves stands out by the strength, all else works about the surface itself.
StrokeSample sample_at(const Brush& brush, double radius_mm, const SurfaceHit& hit, double time_s,
                       double pressure) noexcept;

}  // namespace argil::viewer
