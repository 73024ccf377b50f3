// SPDX-License-Identifier: GPL-3.0-or-later
#include "brush.h"

#include <algorithm>
#include <cmath>

namespace argil::viewer {
namespace {

constexpr ActionInfo kActions[] = {
    {Action::inflate, "inflate", "Draw", "raises the surface along its normal; Ctrl lowers it",
     'D'},
    {Action::add, "add", "Add", "adds the tool's shape; Ctrl carves it", 'A'},
    {Action::carve, "carve", "Carve", "cuts the tool's shape away; Ctrl adds it", 'C'},
    {Action::smooth, "smooth", "Smooth",
     "draws the surface to its average; also Shift with any tool", 'S'},
    {Action::flatten, "flatten", "Flatten", "to the plane under the tool, from both sides", 'L'},
    {Action::scrape, "scrape", "Scrape", "only what stands above that plane; Ctrl fills", 'R'},
    {Action::fill, "fill", "Fill", "only what lies below that plane; Ctrl scrapes", 'B'},
    {Action::crease, "crease", "Crease", "a sharp valley; Ctrl a sharp ridge", 'E'},
    {Action::pinch, "pinch", "Pinch", "draws matter together; Ctrl spreads it", 'P'},
    {Action::grab, "grab", "Grab", "moves matter with the hand", 'G'},
    {Action::twist, "twist", "Twist", "turns matter about the normal; Ctrl the other way", 'T'},
    {Action::mask, "mask", "Mask", "holds matter so that nothing moves it; Ctrl lets it go", 'M'}};

/// The action that undoes another where that is not a negative strength.
Action opposite(Action action) noexcept {
  switch (action) {
    case Action::add:
      return Action::carve;
    case Action::carve:
      return Action::add;
    case Action::scrape:
      return Action::fill;
    case Action::fill:
      return Action::scrape;
    default:
      return action;
  }
}

/// The turn that takes z to a unit vector, the shorter way.
Quat turn_to(const Vec3& normal) noexcept {
  const Vec3 z{0.0, 0.0, 1.0};
  const double c = dot(z, normal);
  if (c < -0.999999) return {0.0, 1.0, 0.0, 0.0};
  const Vec3 axis = cross(z, normal);
  return normalized(Quat{1.0 + c, axis.x, axis.y, axis.z});
}

}  // namespace

std::span<const ActionInfo> action_infos() noexcept { return kActions; }

const ActionInfo& info_of(Action action) noexcept {
  const auto* found = std::find_if(std::begin(kActions), std::end(kActions),
                                   [&](const ActionInfo& info) { return info.action == action; });
  return found != std::end(kActions) ? *found : kActions[0];
}

Brush brush_with(const Brush& brush, const Modifiers& modifiers) noexcept {
  Brush held = brush;
  if (modifiers.shift) {
    held.action = Action::smooth;
    held.is_inverted = false;
  } else if (modifiers.ctrl) {
    held.is_inverted = !held.is_inverted;
  }
  if (held.is_inverted && !is_signed(held.action)) held.action = opposite(held.action);
  return held;
}

double radius_on(const Brush& brush, double pixel_mm) noexcept {
  const double wanted = brush.is_screen_size ? brush.radius_pixels * pixel_mm : brush.radius_mm;
  return std::clamp(wanted, kLeastRadiusMm, kMostRadiusMm);
}

Tool tool_of(const Brush& brush, double radius_mm) noexcept {
  Tool tool;
  tool.action = brush.action;
  tool.shape = brush.shape;
  tool.radii_mm = {radius_mm, radius_mm, radius_mm};
  const bool is_solid = brush.action == Action::add || brush.action == Action::carve;
  tool.strength = is_solid ? 1.0 : std::clamp(brush.strength, kLeastStrength, 1.0);
  if (brush.is_inverted && is_signed(brush.action)) tool.strength = -tool.strength;
  tool.pressure_to_strength = brush.pressure_to_strength;
  tool.pressure_to_size = brush.pressure_to_size;
  return tool;
}

StrokeStyle style_of(const Brush& brush) noexcept {
  return {brush.spacing, brush.mirror, brush.radial, brush.steady_mm, brush.hold_s};
}

StrokeSample sample_at(const Brush& brush, double radius_mm, const SurfaceHit& hit, double time_s,
                       double pressure) noexcept {
  double above = 0.0;
  const double sunk = (1.0 - std::clamp(brush.strength, kLeastStrength, 1.0)) * radius_mm;
  if (brush.action == Action::add) above = -sunk;
  if (brush.action == Action::carve) above = sunk;
  return {time_s, hit.point_mm + above * hit.normal, turn_to(hit.normal), pressure};
}

}  // namespace argil::viewer
