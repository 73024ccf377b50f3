// SPDX-License-Identifier: GPL-3.0-or-later
// A key light that is a disc, a sky, and a ground that throws light back: enough to show form.
#include "raycast/shading.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "raycast/ray_walk.h"

namespace argil {
namespace {

constexpr int kPhases = 16;
constexpr int kSkyRays = 8;  // per point; 128 in a block of 4 x 4 pixels
constexpr int kKeyRays = 4;
constexpr double kKeyRadius = 0.16;  // of the key light's disc at distance 1

constexpr Vec3 kDarkClay{0.075, 0.055, 0.050};
constexpr Vec3 kKeyColor{2.0, 1.88, 1.70};
constexpr Vec3 kSkyHigh{0.66, 0.72, 0.82};
constexpr Vec3 kSkyLow{0.46, 0.44, 0.43};
constexpr Vec3 kFloorColor{0.30, 0.28, 0.26};
constexpr Vec3 kHidden{0.085, 0.042, 0.028};  // light that other clay throws back into a hollow

Vec3 times(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vec3 mix(const Vec3& a, const Vec3& b, double t) { return a * (1.0 - t) + b * t; }

/// Two unit vectors that with unit `n` make a right-handed frame.
/// Source  T. Duff et al., "Building an orthonormal basis, revisited", JCGT 6 (2017).
std::array<Vec3, 2> tangents(const Vec3& n) {
  const double sign = n.z >= 0.0 ? 1.0 : -1.0;
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  return {Vec3{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x},
          Vec3{b, sign + n.y * n.y * a, -n.y}};
}

/// Point `index` of the R2 sequence in the unit square.
/// Source  M. Roberts, "The unreasonable effectiveness of quasirandom sequences" (2018).
std::array<double, 2> r2_point(int index) {
  const double u = 0.5 + 0.7548776662466927 * index;
  const double v = 0.5 + 0.5698402909980532 * index;
  return {u - std::floor(u), v - std::floor(v)};
}

/// A point of the unit disc, area preserving: radius and angle.
std::array<double, 2> disc_point(int index) {
  const auto [u, v] = r2_point(index);
  const double r = std::sqrt(u);
  const double angle = 2.0 * std::numbers::pi * v;
  return {r * std::cos(angle), r * std::sin(angle)};
}

template <int N>
std::array<std::array<double, 2>, N> disc_pattern() {
  std::array<std::array<double, 2>, N> points;
  for (int i = 0; i < N; ++i) points[static_cast<std::size_t>(i)] = disc_point(i);
  return points;
}

Vec3 sky_color(const Studio& studio, const Vec3& direction) {
  const double height = dot(direction, studio.up);
  if (height < 0.0) return studio.has_ground ? kFloorColor : mix(kSkyLow, kFloorColor, -height);
  return mix(kSkyLow, kSkyHigh, height);
}

/// The fraction of the key light's disc that is visible.
double gather_key(const RayScene& scene, const Studio& studio, const SurfacePoint& point,
                  const Vec3& origin, int phase) {
  static const auto pattern = disc_pattern<kKeyRays * kPhases>();
  if (dot(point.normal, studio.key) <= -kKeyRadius) return 0.0;
  const auto [s, t] = tangents(studio.key);
  int seen = 0;
  for (int i = 0; i < kKeyRays; ++i) {
    const auto& [a, b] = pattern[static_cast<std::size_t>(i * kPhases + phase)];
    const Vec3 direction = normalized(studio.key + kKeyRadius * (a * s + b * t));
    if (dot(direction, point.normal) > 0.0 && !scene.occluded(origin, direction)) ++seen;
  }
  return static_cast<double>(seen) / kKeyRays;
}

}  // namespace

SurfacePoint trace_camera_ray(const RayScene& scene, const Studio& studio, const Vec3& eye,
                              const Vec3& direction) {
  assert(is_unit(direction));
  SurfacePoint point;
  if (const auto hit = scene.closest(eye, direction)) {
    point = {Seen::clay, hit->position + studio.lift * hit->facet, hit->normal, hit->distance,
             hit->triangle};
  }
  const double fall = dot(direction, studio.up);
  const double height = dot(eye, studio.up) - studio.ground_height;
  if (!studio.has_ground || fall > -1e-6) return point;
  const double distance = -height / fall;
  if (point.seen == Seen::clay && point.distance <= distance) return point;
  return {Seen::ground, eye + distance * direction + studio.lift * studio.up, studio.up, distance,
          0};
}

Light gather_light(const RayScene& scene, const Studio& studio, const SurfacePoint& point,
                   int phase) {
  assert(phase >= 0 && phase < kPhases && point.seen != Seen::background);
  static const auto pattern = disc_pattern<kSkyRays * kPhases>();
  Light light;
  light.key = gather_key(scene, studio, point, point.position, phase);
  const auto [s, t] = tangents(point.normal);
  int open = 0;
  for (int i = 0; i < kSkyRays; ++i) {
    const auto& [a, b] = pattern[static_cast<std::size_t>(i * kPhases + phase)];
    const double up = std::sqrt(std::max(0.0, 1.0 - a * a - b * b));
    const Vec3 direction = normalized(a * s + b * t + up * point.normal);
    const bool hidden = scene.occluded(point.position, direction);
    light.sky += hidden ? kHidden : sky_color(studio, direction);
    if (!hidden) ++open;
  }
  light.sky *= 1.0 / kSkyRays;
  light.open = static_cast<double>(open) / kSkyRays;
  return light;
}

Vec3 shade_clay(const Studio& studio, const SurfacePoint& point, const Light& light,
                const Vec3& toward_eye, const Vec3& albedo, double darkness) {
  const double facing = std::max(0.0, dot(point.normal, studio.key));
  const Vec3 diffuse =
      times(mix(albedo, kDarkClay, darkness), light.sky + (0.62 * facing * light.key) * kKeyColor);
  // A faint, wide highlight, as on leather-hard clay, and a rim light that lifts edges off the
  // backdrop.
  const Vec3 half = normalized(studio.key + toward_eye);
  const double shine = std::max(0.0, dot(point.normal, half));
  const double gloss = 0.09 * std::pow(shine, 26.0) * light.key * (facing > 0.0 ? 1.0 : 0.0);
  const double grazing = 1.0 - std::max(0.0, dot(point.normal, toward_eye));
  const double rim = 0.10 * grazing * grazing * grazing * light.open;
  return diffuse + gloss * kKeyColor + rim * kSkyHigh;
}

Vec3 backdrop(double height) {
  return mix(Vec3{0.70, 0.69, 0.675}, Vec3{0.93, 0.935, 0.945},
             std::clamp(0.15 + 0.85 * height, 0.0, 1.0));
}

Vec3 shade_ground(const Studio& studio, const Vec3& backdrop_color, const Light& light) {
  // What an open floor would get is the backdrop's own colour; the object only takes from that.
  const double key = dot(studio.up, studio.key);
  const double fraction = 0.62 * key / (0.62 * key + 0.36);
  const Vec3 warm = mix(Vec3{0.50, 0.43, 0.38}, Vec3{1.0, 1.0, 1.0}, light.open);
  return times(backdrop_color, warm) * (1.0 - fraction + fraction * light.key);
}

}  // namespace argil
