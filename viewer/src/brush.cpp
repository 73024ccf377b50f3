// SPDX-License-Identifier: GPL-3.0-or-later
#include "brush.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace argil::viewer {
namespace {

constexpr ActionInfo kActions[] = {
    {Action::inflate, false, "inflate", "Draw",
     "raises the surface along its normal; Ctrl lowers it", 'D'},
    {Action::smooth, false, "smooth", "Smooth",
     "draws the surface to its average; also Shift with any tool", 'S'},
    {Action::add, false, "add", "Add", "adds the tool's shape; Ctrl carves it", 'A'},
    {Action::carve, false, "carve", "Carve", "cuts the tool's shape away; Ctrl adds it", 'C'},
    {Action::add, true, "stamp", "Stamp",
     "puts a shape or a mesh on, once for each press; Ctrl imprints it", 'K'},
    {Action::grab, false, "grab", "Grab", "moves matter with the hand", 'G'},
    {Action::flatten, false, "flatten", "Flatten", "to the plane under the tool, from both sides",
     'L'},
    {Action::scrape, false, "scrape", "Scrape", "only what stands above that plane; Ctrl fills",
     'R'},
    {Action::fill, false, "fill", "Fill", "only what lies below that plane; Ctrl scrapes", 'B'},
    {Action::pinch, false, "pinch", "Pinch", "draws matter together; Ctrl spreads it", 'P'},
    {Action::crease, false, "crease", "Crease", "a sharp valley; Ctrl a sharp ridge", 'E'},
    {Action::twist, false, "twist", "Twist", "turns matter about the normal; Ctrl the other way",
     'T'},
    {Action::mask, false, "mask", "Mask", "holds matter so that nothing moves it; Ctrl lets it go",
     'M'}};

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

/// First `b`, then `a`.
Quat product(const Quat& a, const Quat& b) noexcept {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Quat about_z(double degrees) noexcept {
  const double half = 0.5 * degrees * std::numbers::pi / 180.0;
  return {std::cos(half), 0.0, 0.0, std::sin(half)};
}

/// How far the tool reaches from its middle along its z axis.
double half_height_mm(const Brush& brush, double radius_mm) noexcept {
  if (shape_of(brush) != Shape::mesh) return radii_of(brush, radius_mm).z;
  const Vec3& half = brush.mesh->half_extents();
  return half.z * radius_mm / std::max({half.x, half.y, half.z});
}

}  // namespace

std::span<const ActionInfo> action_infos() noexcept { return kActions; }

const ActionInfo& info_of(Action action) noexcept {
  const auto* found =
      std::find_if(std::begin(kActions), std::end(kActions),
                   [&](const ActionInfo& info) { return info.action == action && !info.is_stamp; });
  return found != std::end(kActions) ? *found : kActions[0];
}

void choose(Brush& brush, const ActionInfo& tool) noexcept {
  brush.action = tool.action;
  brush.is_stamp = tool.is_stamp;
}

Shape shape_of(const Brush& brush) noexcept {
  const bool has_edges = brush.shape != Shape::ball && brush.shape != Shape::ellipsoid;
  if (has_edges && !is_solid(brush)) return Shape::ball;
  if (brush.shape == Shape::mesh && brush.mesh == nullptr) return Shape::ball;
  return brush.shape;
}

Vec3 radii_of(const Brush& brush, double radius_mm) noexcept {
  const double height = std::clamp(brush.height, kLeastHeight, kMostHeight);
  switch (shape_of(brush)) {
    case Shape::ellipsoid:
    case Shape::box:
      return {radius_mm, radius_mm, height * radius_mm};
    case Shape::capsule:
      return {radius_mm, radius_mm, std::max(1.0, height) * radius_mm};
    default:
      return {radius_mm, radius_mm, radius_mm};
  }
}

Brush brush_with(const Brush& brush, const Modifiers& modifiers) noexcept {
  Brush held = brush;
  if (modifiers.shift) {
    held.action = Action::smooth;
    held.is_stamp = false;
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
  tool.shape = shape_of(brush);
  if (tool.shape == Shape::mesh) tool.mesh = brush.mesh;
  tool.radii_mm = radii_of(brush, radius_mm);
  tool.strength = is_solid(brush) ? 1.0 : std::clamp(brush.strength, kLeastStrength, 1.0);
  if (brush.is_inverted && is_signed(brush.action)) tool.strength = -tool.strength;
  tool.pressure_to_strength = brush.pressure_to_strength;
  tool.pressure_to_size = brush.pressure_to_size;
  return tool;
}

StrokeStyle style_of(const Brush& brush) noexcept {
  return {brush.spacing, brush.mirror, brush.radial, brush.steady_mm, brush.hold_s};
}

std::vector<SurfaceHit> images_of(const SurfaceHit& hit, const Brush& brush) {
  Stroke one;
  one.mirror = brush.mirror;
  one.radial = brush.radial;
  const auto places = [&](const Vec3& place) {
    one.samples = {{0.0, place, {}, 1.0}};
    return dabs_of(one);
  };
  const std::vector<Dab> at = places(hit.point_mm);
  const std::vector<Dab> above = places(hit.point_mm + hit.normal);
  std::vector<SurfaceHit> images;
  for (std::size_t n = 0; n < at.size(); ++n) {
    const Vec3& place = at[n].at.position_mm;
    images.push_back({place, above[n].at.position_mm - place});
  }
  return images;
}

StrokeSample sample_at(const Brush& brush, double radius_mm, const SurfaceHit& hit, double time_s,
                       double pressure) noexcept {
  double above = 0.0;
  const double strength = std::clamp(brush.strength, kLeastStrength, 1.0);
  const double sunk = (1.0 - strength) * half_height_mm(brush, radius_mm);
  if (brush.action == Action::add) above = -sunk;
  if (brush.action == Action::carve) above = sunk;
  return {time_s, hit.point_mm + above * hit.normal,
          product(turn_to(hit.normal), about_z(brush.turn_deg)), pressure};
}

}  // namespace argil::viewer
