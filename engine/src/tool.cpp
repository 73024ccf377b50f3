// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/tool.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bad_input.h"

namespace argil {
namespace {

constexpr double kLargestAspect = 20.0;

/// The closest-point equation of Eberly's section 3 with s = t + 1, which keeps its precision near
/// the medial plane. Axis 2 is the shortest.
struct ClosestPoint {
  std::array<double, 3> ratio{};  ///< (radius / shortest)^2
  std::array<double, 3> z{};      ///< coordinate / radius

  double share(std::size_t a, double s) const { return ratio[a] * z[a] / (s + (ratio[a] - 1.0)); }

  /// The root in [lo, hi] of (sum of share^2) - 1, which falls and is convex: Newton steps where
  /// they stay in the bracket, else bisection.
  double solve(double lo, double hi) const {
    double s = lo;
    for (int step = 0; step < 200; ++step) {
      double value = -1.0;
      double slope = 0.0;
      for (std::size_t a = 0; a < 3; ++a) {
        const double q = share(a, s);
        value += q * q;
        slope -= 2.0 * q * q / (s + (ratio[a] - 1.0));
      }
      (value > 0.0 ? lo : hi) = s;
      double next = s - value / slope;
      if (!(next >= lo && next <= hi)) next = 0.5 * (lo + hi);
      if (std::abs(next - s) <= 1e-14 * s) return next;
      s = next;
    }
    return s;
  }
};

Result<void> validate_shape(const Tool& tool) {
  const double low = smallest_radius(tool);
  const double high = largest_radius(tool);
  if (tool.shape == Shape::ball && low != high) {
    return bad_input("radii_mm of a ball differ (" + number_text(low) + " and " +
                     number_text(high) + "); use shape \"ellipsoid\"");
  }
  if (tool.shape == Shape::capsule &&
      (tool.radii_mm.x != tool.radii_mm.y || tool.radii_mm.z < tool.radii_mm.x)) {
    return bad_input("radii_mm of a capsule are " + number_text(tool.radii_mm.x) + ", " +
                     number_text(tool.radii_mm.y) + ", " + number_text(tool.radii_mm.z) +
                     "; the first two must be equal and the third no smaller");
  }
  if (high > kLargestAspect * low) {
    return bad_input("radii_mm reach from " + number_text(low) + " to " + number_text(high) +
                     "; the largest may be at most 20 times the smallest");
  }
  if ((tool.shape == Shape::mesh) != (tool.mesh != nullptr)) {
    return bad_input(tool.mesh != nullptr
                         ? "a mesh was given to a tool of another shape; use \"mesh\""
                         : "the tool's shape is a mesh and no mesh was given");
  }
  const bool is_stamp = tool.action == Action::add || tool.action == Action::carve;
  if (!is_stamp &&
      (tool.shape == Shape::box || tool.shape == Shape::capsule || tool.shape == Shape::mesh)) {
    return bad_input(
        "boxes, capsules and meshes are for add and carve; use a ball or an ellipsoid");
  }
  return {};
}

}  // namespace

bool is_signed(Action action) noexcept {
  return action == Action::inflate || action == Action::pinch || action == Action::crease ||
         action == Action::twist || action == Action::mask;
}

bool is_anchored(Action action) noexcept {
  return action == Action::grab || action == Action::twist;
}

Result<void> validate_tool(const Tool& tool) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double r = tool.radii_mm[axis];
    if (!std::isfinite(r) || r <= 0.0) {
      return bad_input("radius_mm is " + number_text(r) +
                       "; must be a finite number greater than 0");
    }
  }
  if (auto ok = validate_shape(tool); !ok) return ok;
  const double least = is_signed(tool.action) ? -1.0 : 0.0;
  if (!std::isfinite(tool.strength) || tool.strength < least || tool.strength > 1.0 ||
      tool.strength == 0.0) {
    return bad_input("strength is " + number_text(tool.strength) +
                     (least < 0.0 ? "; must be from -1 to 1 and not 0 for this tool"
                                  : "; must be greater than 0 and at most 1"));
  }
  if (!(tool.pressure_to_strength >= 0.0 && tool.pressure_to_strength <= 1.0)) {
    return bad_input("pressure_to_strength is " + number_text(tool.pressure_to_strength) +
                     "; must be from 0 to 1");
  }
  if (!(tool.pressure_to_size >= 0.0 && tool.pressure_to_size <= 1.0)) {
    return bad_input("pressure_to_size is " + number_text(tool.pressure_to_size) +
                     "; must be from 0 to 1");
  }
  return {};
}

double box_distance(const Vec3& point_mm, const Vec3& half_mm) noexcept {
  Vec3 beyond;
  Vec3 outside;
  for (std::size_t a = 0; a < 3; ++a) {
    beyond[a] = std::abs(point_mm[a]) - half_mm[a];
    outside[a] = std::max(beyond[a], 0.0);
  }
  return length(outside) + std::min(0.0, std::max({beyond.x, beyond.y, beyond.z}));
}

double capsule_distance(const Vec3& point_mm, const Vec3& radii_mm) noexcept {
  const double half = radii_mm.z - radii_mm.x;
  const double along = std::clamp(point_mm.z, -half, half);
  return length(Vec3{point_mm.x, point_mm.y, point_mm.z - along}) - radii_mm.x;
}

double ellipsoid_distance(const Vec3& point_mm, const Vec3& radii_mm) noexcept {
  // Work in the octant of positive coordinates, axes sorted from longest to shortest.
  struct Axis {
    double radius, coordinate;
  };
  std::array<Axis, 3> axes{{{radii_mm.x, std::abs(point_mm.x)},
                            {radii_mm.y, std::abs(point_mm.y)},
                            {radii_mm.z, std::abs(point_mm.z)}}};
  std::stable_sort(axes.begin(), axes.end(),
                   [](const Axis& a, const Axis& b) { return a.radius > b.radius; });
  const double shortest = axes[2].radius;
  if (axes[0].radius == shortest) return length(point_mm) - shortest;

  ClosestPoint closest;
  double inside = -1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double e = axes[a].radius / shortest;
    closest.ratio[a] = e * e;
    closest.z[a] = axes[a].coordinate / axes[a].radius;
    inside += closest.z[a] * closest.z[a];
  }
  // On the plane of the shortest axis the root may sit at s = 0; a ten-thousand-millionth of the
  // radius picks the same branch and moves the distance by far less than the promise.
  closest.z[2] = std::max(closest.z[2], 1e-10);
  double reach = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double r = closest.ratio[a] * closest.z[a];
    reach += r * r;
  }
  const double s = closest.solve(closest.z[2], std::max(closest.z[2], std::sqrt(reach)));
  double squared = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double d = (closest.share(a, s) - closest.z[a]) * axes[a].radius;
    squared += d * d;
  }
  const double distance = std::sqrt(squared);
  return inside < 0.0 ? -distance : distance;
}

}  // namespace argil
