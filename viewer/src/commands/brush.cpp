// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/brush.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace argil::viewer {
namespace {

/// The shortest rotation that takes z to a unit vector.
Quat turn_to(const Vec3& normal) noexcept {
  assert(std::abs(length(normal) - 1.0) < 1e-6);
  const Vec3 z{0.0, 0.0, 1.0};
  const double c = dot(z, normal);
  // Straight down every axis in the plane is as short: half a turn about x.
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
  assert(brush.mesh != nullptr);  // shape_of has said so
  const Vec3& half = brush.mesh->half_extents();
  return half.z * radius_mm / std::max({half.x, half.y, half.z});
}

}  // namespace

void choose(Brush& brush, const ToolInfo& tool) noexcept {
  brush.action = tool.action;
  brush.is_stamp = tool.is_stamp;
}

Shape shape_of(const Brush& brush) noexcept {
  // Edges would show as steps where a brush moves the surface instead of adding to it.
  const bool has_edges = brush.shape != Shape::ball && brush.shape != Shape::ellipsoid;
  if (has_edges && !is_solid(brush)) return Shape::ball;
  if (brush.shape == Shape::mesh && brush.mesh == nullptr) return Shape::ball;
  return brush.shape;
}

bool takes_modes(const Brush& brush) noexcept {
  const bool needs_a_way = brush.action == Action::twist || brush.action == Action::slide;
  return !brush.is_stamp && !info_of(brush.action).is_dragged && !needs_a_way;
}

StrokeMode mode_of(const Brush& brush) noexcept {
  if (!takes_modes(brush)) return StrokeMode::space;
  return brush.action == Action::emboss ? brush.emboss_mode : brush.stroke_mode;
}

Vec3 radii_of(const Brush& brush, double radius_mm) noexcept {
  assert(radius_mm > 0.0);
  const double height = std::clamp(brush.height, kLeastHeight, kMostHeight);
  switch (shape_of(brush)) {
    case Shape::ellipsoid:
    case Shape::box:
      return {radius_mm, radius_mm, height * radius_mm};
    case Shape::capsule:  // its caps are half balls, so it is at least as high as it is wide
      return {radius_mm, radius_mm, std::max(1.0, height) * radius_mm};
    case Shape::ball:
    case Shape::mesh:
      break;
  }
  return {radius_mm, radius_mm, radius_mm};
}

Brush brush_with(const Brush& brush, const Modifiers& modifiers) noexcept {
  Brush held = brush;
  if (modifiers.shift) {
    held.action = Action::smooth;
    held.is_stamp = false;
    held.is_inverted = false;
    held.stroke_mode = StrokeMode::space;
  } else if (modifiers.ctrl) {
    held.is_inverted = !held.is_inverted;
  }
  // Where the engine takes a negative strength that is the opposite, else another action.
  if (held.is_inverted) held.action = info_of(held.action).opposite.value_or(held.action);
  return held;
}

double radius_on(const Brush& brush, double pixel_mm) noexcept {
  assert(pixel_mm >= 0.0);
  const double wanted = brush.is_screen_size ? brush.radius_pixels * pixel_mm : brush.radius_mm;
  return std::clamp(wanted, kLeastRadiusMm, kMostRadiusMm);
}

Tool tool_of(const Brush& brush, double radius_mm) noexcept {
  Tool tool;
  tool.action = brush.action;
  tool.shape = shape_of(brush);
  if (tool.shape == Shape::mesh) tool.mesh = brush.mesh;
  tool.radii_mm = radii_of(brush, radius_mm);
  // For what adds or carves the strength is how far the tool is sunk (sample_at).
  tool.strength = is_solid(brush) ? 1.0 : std::clamp(brush.strength, kLeastStrength, 1.0);
  if (brush.is_inverted && is_signed(brush.action)) tool.strength = -tool.strength;
  tool.pressure_to_strength = brush.pressure_to_strength;
  tool.pressure_to_size = brush.pressure_to_size;
  tool.sharpness = brush.sharpness;
  tool.width = brush.width;
  if (takes(brush.action, brush.falloff)) tool.falloff = brush.falloff;
  tool.plane_offset = brush.plane_offset;
  tool.tip_roundness = brush.tip_roundness;
  tool.volume_preservation = brush.volume_preservation;
  tool.crease_pinch_factor = brush.crease_pinch_factor;
  tool.wavelength_mm = std::min(brush.wavelength * radius_mm, kMostRadiusMm);
  tool.seed = static_cast<std::uint32_t>(brush.seed);
  if (tool.action == Action::emboss) tool.alpha = brush.alpha;
  const bool is_anchored_image = mode_of(brush) == StrokeMode::anchored;
  tool.alpha_mode = is_anchored_image ? AlphaMode::anchored : brush.alpha_mode;
  tool.amplitude_mm = std::min(brush.amplitude * radius_mm, kMostRadiusMm);
  tool.mid_level = brush.mid_level;
  tool.angle_deg = brush.angle_deg;
  tool.use_rake = brush.use_rake;
  tool.tile_mm = std::min(brush.tile * radius_mm, kMostRadiusMm);
  return tool;
}

StrokeStyle style_of(const Brush& brush) noexcept {
  return {brush.spacing,   brush.mirror, brush.radial,
          brush.steady_mm, brush.hold_s, mode_of(brush) == StrokeMode::dots};
}

std::vector<SurfaceHit> images_of(const SurfaceHit& hit, const Brush& brush) {
  // The engine makes the images, so that a ring lies where a dab will.
  Stroke one;
  one.mirror = brush.mirror;
  one.radial = brush.radial;
  const auto dabs_at = [&](const Vec3& point) {
    one.samples = {{0.0, point, {}, 1.0}};
    return dabs_of(one);
  };
  const std::vector<Dab> at = dabs_at(hit.point_mm);
  const std::vector<Dab> above = dabs_at(hit.point_mm + hit.normal);
  assert(at.size() == above.size());
  std::vector<SurfaceHit> images;
  for (std::size_t n = 0; n < at.size(); ++n) {
    const Vec3& point = at[n].at.position_mm;
    images.push_back({point, above[n].at.position_mm - point});
  }
  return images;
}

StrokeSample sample_at(const Brush& brush, double radius_mm, const SurfaceHit& hit, double time_s,
                       double pressure) noexcept {
  // The tool's centre: sunk into the surface by what the strength leaves of its half height.
  double above = 0.0;
  if (is_solid(brush)) {
    const double strength = std::clamp(brush.strength, kLeastStrength, 1.0);
    const double sunk = (1.0 - strength) * half_height_mm(brush, radius_mm);
    above = info_of(brush.action).is_cut ? sunk : -sunk;
  }
  return {time_s, hit.point_mm + above * hit.normal,
          product(turn_to(hit.normal), about_z(brush.turn_deg)), pressure};
}

StrokeSample anchored_sample(const Brush& brush, double radius_mm, const SurfaceHit& hit,
                             const Vec3& way, double pressure) noexcept {
  const Vec3 local = rotate(conjugate(turn_to(hit.normal)), way);
  Brush turned = brush;
  turned.turn_deg += std::atan2(local.y, local.x) * 180.0 / std::numbers::pi;
  return sample_at(turned, radius_mm, hit, 0.0, pressure);
}

}  // namespace argil::viewer
