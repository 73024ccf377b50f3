// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "argil/core/field_window.h"
#include "argil/core/vec3.h"
#include "argil/haptics/force/tool_force.h"

namespace argil::haptics::fields {

/// A signed distance in mm, negative inside.
using Distance = std::function<double(const Vec3&)>;

inline Distance plane(const Vec3& normal, double offset_mm = 0.0) {
  return [n = normalized(normal), offset_mm](const Vec3& p) { return dot(n, p) - offset_mm; };
}
inline Distance ball(double radius_mm, const Vec3& center = {}) {
  return [=](const Vec3& p) { return length(p - center) - radius_mm; };
}
inline Distance slab(double thickness_mm) {
  return [=](const Vec3& p) { return std::abs(p.z) - thickness_mm / 2.0; };
}
/// The solid x < 0 and z < 0: a 90 degree edge along y with its exact distance.
inline Distance edge() {
  return [](const Vec3& p) {
    const double outside = std::hypot(std::max(p.x, 0.0), std::max(p.z, 0.0));
    return outside > 0.0 ? outside : std::max(p.x, p.z);
  };
}
inline Distance torus(double ring_mm, double tube_mm) {
  return [=](const Vec3& p) { return std::hypot(std::hypot(p.x, p.y) - ring_mm, p.z) - tube_mm; };
}
/// Two unequal balls melted together: a smooth minimum, no exact distance, |grad| varies.
inline Distance blended_balls(double width_mm) {
  return [=](const Vec3& p) {
    const double a = length(p - Vec3{-8, 0, 0}) - 12.0;
    const double b = length(p - Vec3{11, 0, 0}) - 8.0;
    const double h = std::clamp(0.5 + 0.5 * (b - a) / width_mm, 0.0, 1.0);
    return b + (a - b) * h - width_mm * h * (1.0 - h);
  };
}
/// A field that stores no more than a depth inside, as a narrow band does.
inline Distance clamped_at(double depth_mm, Distance field) {
  return [=, inner = std::move(field)](const Vec3& p) { return std::max(inner(p), -depth_mm); };
}

/// A window that owns its values.
struct Window {
  FieldWindowView view;
  std::vector<float> values;
};

/// A window of an analytic field: at least `reach_mm` to every side of `center`, nodes at multiples
/// of `voxel_mm` plus `offset_mm`.
inline Window sampled(const Distance& field, const Vec3& center, double reach_mm, double voxel_mm,
                      const Vec3& offset_mm = {}) {
  Window window;
  window.view.voxel_mm = voxel_mm;
  for (std::size_t a = 0; a < 3; ++a) {
    const double low = std::floor((center[a] - reach_mm - offset_mm[a]) / voxel_mm);
    window.view.origin_mm[a] = low * voxel_mm + offset_mm[a];
    window.view.nodes[a] =
        static_cast<int>(std::ceil((center[a] + reach_mm - offset_mm[a]) / voxel_mm) - low) + 1;
  }
  const auto& n = window.view.nodes;
  for (int i = 0; i < n[0]; ++i) {
    for (int j = 0; j < n[1]; ++j) {
      for (int k = 0; k < n[2]; ++k) {
        const Vec3 step{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        window.values.push_back(static_cast<float>(field(window.view.origin_mm + voxel_mm * step)));
      }
    }
  }
  window.view.distance_mm = window.values;
  return window;
}

inline ForceTool ball_tool(double radius_mm, const Vec3& position_mm) {
  ForceTool tool;
  tool.radii_mm = {radius_mm, radius_mm, radius_mm};
  tool.position_mm = position_mm;
  return tool;
}

/// The volume force of a resting tool with `across` nodes along its smallest diameter, in a window
/// cut to fit it.
inline ForceResult force_at(const Distance& field, const ForceTool& tool, double across,
                            const ForceMaterial& material, ForceLaw law,
                            const Vec3& offset_share = {}) {
  const Vec3& radii = tool.radii_mm;
  const double voxel = 2.0 * std::min({radii.x, radii.y, radii.z}) / across;
  const double reach = kKernelSupport * std::max({radii.x, radii.y, radii.z}) + 2.0 * voxel;
  const Window window = sampled(field, tool.position_mm, reach, voxel, voxel * offset_share);
  return volume_force(window.view, tool, material, law);
}

/// The angle between two vectors, in degrees; 180 when one is zero.
inline double angle_deg(const Vec3& a, const Vec3& b) {
  const double scale = length(a) * length(b);
  if (scale == 0.0) return 180.0;
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180.0 / 3.14159265358979323846;
}

}  // namespace argil::haptics::fields
