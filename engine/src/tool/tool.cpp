// SPDX-License-Identifier: GPL-3.0-or-later
// Distances to the shapes of tools, and what a tool may be. The closest point of an ellipsoid: D.
// Eberly, "Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid", 2013.
#include "argil/engine/tool.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>

#include "field/bad_input.h"

namespace argil {
namespace {

constexpr double kLargestAspect = 20.0;

/// The closest-point equation of Eberly's section 3 with s = t + 1, which keeps its precision near
/// the medial plane. Axis 2 is the shortest.
struct ClosestPoint {
  std::array<double, 3> ratio{};  ///< (radius / shortest)^2
  std::array<double, 3> z{};      ///< coordinate / radius

  /// A coordinate of the closest point, in its radius.
  double component(std::size_t a, double s) const {
    return ratio[a] * z[a] / (s + (ratio[a] - 1.0));
  }

  /// The root in [lo, hi] of (sum of component^2) - 1, which falls and is convex: Newton steps
  /// where they stay in the bracket, else bisection.
  double solve(double lo, double hi) const {
    assert(lo > 0.0 && lo <= hi);
    double s = lo;
    for (int step = 0; step < 200; ++step) {
      double value = -1.0;
      double slope = 0.0;
      for (std::size_t a = 0; a < 3; ++a) {
        const double q = component(a, s);
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

/// "add and carve"
std::string stamped_names() {
  std::string names;
  for (const ActionInfo& info : kActionInfos) {
    if (info.kind != ActionKind::stamped) continue;
    names += names.empty() ? "" : " and ";
    names += info.name;
  }
  return names;
}

/// What the radii and the mesh must be for the shape, and which actions take it.
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
  if (!is_stamped(tool.action) &&
      (tool.shape == Shape::box || tool.shape == Shape::capsule || tool.shape == Shape::mesh)) {
    return bad_input("boxes, capsules and meshes are for " + stamped_names() +
                     "; use a ball or an ellipsoid");
  }
  return {};
}

/// What single actions read.
Result<void> validate_options(const Tool& tool) {
  struct Option {
    const char* name;
    double value, least, most;
  };
  const Option options[] = {{"plane_offset", tool.plane_offset, -2.0, 2.0},
                            {"tip_roundness", tool.tip_roundness, 0.05, 1.0},
                            {"volume_preservation", tool.volume_preservation, 0.0, 1.0},
                            {"crease_pinch_factor", tool.crease_pinch_factor, 0.0, 1.0},
                            {"wavelength_mm", tool.wavelength_mm, 0.0, 1000.0},
                            {"amplitude_mm", tool.amplitude_mm, 0.0, 1000.0},
                            {"mid_level", tool.mid_level, 0.0, 1.0},
                            {"angle_deg", tool.angle_deg, -360.0, 360.0},
                            {"tile_mm", tool.tile_mm, 0.0, 1000.0}};
  for (const Option& option : options) {
    if (option.value >= option.least && option.value <= option.most) continue;
    return bad_input(std::string(option.name) + " is " + number_text(option.value) +
                     "; must be from " + number_text(option.least) + " to " +
                     number_text(option.most));
  }
  if (tool.alpha != nullptr && tool.action != Action::emboss) {
    return bad_input(std::string("an image was given to ") + info_of(tool.action).name +
                     "; use emboss");
  }
  return {};
}

Result<void> validate_falloff(const Tool& tool) {
  if (takes(tool.action, tool.falloff)) return {};
  const auto name_of = [](Falloff falloff) {
    return std::string(kFalloffNames.at(static_cast<std::size_t>(falloff)));
  };
  std::string gentle;
  for (std::size_t n = 0; n < kFalloffNames.size(); ++n) {
    const auto each = static_cast<Falloff>(n);
    if (is_gentle(each)) gentle += (gentle.empty() ? "" : ", ") + name_of(each);
  }
  return bad_input("falloff is \"" + name_of(tool.falloff) + "\", so steep that \"" +
                   info_of(tool.action).name + "\" would fold the matter it moves; use one of " +
                   gentle);
}

}  // namespace

double fall_off(Falloff falloff, double square) noexcept {
  assert(square >= 0.0);
  const double rest = std::max(0.0, 1.0 - square);
  const double p = std::max(0.0, 1.0 - std::sqrt(square));
  switch (falloff) {
    case Falloff::smooth:
      return rest * rest;
    case Falloff::smoother:
      return p * p * p * (p * (6.0 * p - 15.0) + 10.0);
    case Falloff::sphere:
      return std::sqrt(rest);
    case Falloff::root:
      return std::sqrt(p);
    case Falloff::sharp:
      return p * p;
    case Falloff::linear:
      return p;
    case Falloff::sharper:
      return p * p * (p * p);
    case Falloff::inverse_square:
      return rest;
    case Falloff::constant:
      return rest > 0.0 ? 1.0 : 0.0;
  }
  return 0.0;
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
  if (auto ok = validate_falloff(tool); !ok) return ok;
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
  if (!(tool.sharpness >= 0.0 && tool.sharpness <= 1.0)) {
    return bad_input("sharpness is " + number_text(tool.sharpness) + "; must be from 0 to 1");
  }
  if (!(tool.width >= 0.3 && tool.width <= 1.0)) {
    return bad_input("width is " + number_text(tool.width) +
                     "; must be from 0.3 to 1 smallest radii");
  }
  return validate_options(tool);
}

/// Outside the distance to the nearest face, edge or corner, inside that to the nearest face.
double box_distance(const Vec3& point_mm, const Vec3& half_mm) noexcept {
  Vec3 beyond;
  Vec3 outside;
  for (std::size_t a = 0; a < 3; ++a) {
    beyond[a] = std::abs(point_mm[a]) - half_mm[a];
    outside[a] = std::max(beyond[a], 0.0);
  }
  return length(outside) + std::min(0.0, std::max({beyond.x, beyond.y, beyond.z}));
}

/// To the segment between the centres of the two ends.
double capsule_distance(const Vec3& point_mm, const Vec3& radii_mm) noexcept {
  assert(radii_mm.z >= radii_mm.x);
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
  assert(shortest > 0.0);

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
    const double d = (closest.component(a, s) - closest.z[a]) * axes[a].radius;
    squared += d * d;
  }
  const double distance = std::sqrt(squared);
  return inside < 0.0 ? -distance : distance;
}

}  // namespace argil
