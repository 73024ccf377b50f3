// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/force_scenes.h"

#include <algorithm>
#include <cmath>

#include "support/effort.h"

namespace argil::test {
namespace {

constexpr std::size_t kSide = 33;      // nodes over one period, both ends counted
constexpr std::size_t kHeights = 401;  // over asinh(z / kScale) in +-kMost
constexpr double kScale = 3.0;
constexpr double kMost = 5.6;  // heights of +-400
constexpr int kSteps = 24;     // samples over one period that `closest` tries
constexpr double kTurn = 6.283185307179586;
// A body ends this far from the feature: in radii of the tool, and in mm besides.
constexpr double kBodyRadii = 6.0;
double body_mm() { return effort(4.0, 8.0); }
double least_body_mm() { return effort(12.0, 24.0); }

double share(double at, std::size_t low, std::size_t up) noexcept {
  const double t = at - static_cast<double>(low);
  return up == 1 ? t : 1.0 - t;
}

double period_share(std::size_t i) noexcept {
  return static_cast<double>(i) / static_cast<double>(kSide - 1);
}

double height(std::size_t k) noexcept {
  const double t = 2.0 * static_cast<double>(k) / static_cast<double>(kHeights - 1) - 1.0;
  return kScale * std::sinh(kMost * t);
}

double wrapped(double periods) noexcept {
  return (periods - std::floor(periods)) * static_cast<double>(kSide - 1);
}

std::vector<double> sampled_heights() {
  std::vector<double> heights;
  heights.reserve(static_cast<std::size_t>(kSteps) * kSteps);
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      heights.push_back(std::sin(kTurn * i / kSteps) * std::sin(kTurn * j / kSteps));
    }
  }
  return heights;
}

/// Axes of a body that stands askew.
struct Frame {
  Vec3 n = normalized(Vec3{0.31, -0.22, 0.9});
  Vec3 a = normalized(cross(n, Vec3{0.2, 1.0, 0.1}));
  Vec3 b = cross(n, a);

  Vec3 to(const Vec3& p) const noexcept { return {dot(a, p), dot(b, p), dot(n, p)}; }
  Vec3 from(const Vec3& p) const noexcept { return a * p.x + b * p.y + n * p.z; }
};

/// The solid x < 0, z < 0.
double edge_distance(const Vec3& q) noexcept {
  const double outside = std::hypot(std::max(q.x, 0.0), std::max(q.z, 0.0));
  return outside > 0.0 ? outside : std::max(q.x, q.z);
}

/// The solid z < 0 with a slot from -half to half along x, down to -deep.
double slot_distance(const Vec3& q, double half, double deep) noexcept {
  const double beside = std::abs(q.x) - half;
  if (q.z > 0.0) return std::min(std::hypot(std::max(-beside, 0.0), q.z), q.z + deep);
  if (beside < 0.0 && q.z > -deep) return std::min(-beside, q.z + deep);
  return -std::min(-q.z, std::hypot(std::max(beside, 0.0), std::max(-deep - q.z, 0.0)));
}

/// A feature of the plane z = 0 of the frame, cut out of a large ball.
ForceScene on_a_plane(const SceneDistance& feature, double radius_mm) {
  const Frame frame;
  const double half = std::max(kBodyRadii * radius_mm + body_mm(), least_body_mm());
  ForceScene scene;
  scene.half_mm = half;
  scene.distance = [=](const Vec3& p) { return std::max(feature(frame.to(p)), length(p) - half); };
  scene.place = [=](double height_mm, double u, double v) {
    return frame.from({u * radius_mm, v * radius_mm, height_mm});
  };
  return scene;
}

ForceScene ball_scene(double radius_mm) {
  const double r = 3.0 * radius_mm;
  ForceScene scene;
  scene.half_mm = r + 2.0;
  scene.distance = [=](const Vec3& p) { return length(p) - r; };
  scene.place = [=](double height_mm, double u, double v) {
    return normalized(Vec3{u, v, 0.7}) * (r + height_mm);
  };
  return scene;
}

ForceScene torus_scene(double radius_mm) {
  const Frame frame;
  const double ring = 6.0 * radius_mm;
  const double tube = 3.0 * radius_mm;
  ForceScene scene;
  scene.half_mm = ring + tube + 2.0;
  scene.distance = [=](const Vec3& p) {
    const Vec3 q = frame.to(p);
    return std::hypot(std::hypot(q.x, q.y) - ring, q.z) - tube;
  };
  scene.place = [=](double height_mm, double u, double v) {
    const double out = ring + (tube + height_mm) * std::cos(3.0 * v);
    return frame.from(
        {out * std::cos(3.0 * u), out * std::sin(3.0 * u), (tube + height_mm) * std::sin(3.0 * v)});
  };
  return scene;
}

}  // namespace

RoughPlane::RoughPlane(double waves) : waves_(waves), values_(kSide * kSide * kHeights) {
  const std::vector<double> heights = sampled_heights();
  for (std::size_t i = 0; i < kSide; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {  // the same at i, j as at j, i
      for (std::size_t k = 0; k < kHeights; ++k) {
        const Vec3 p{period_share(i) * waves_, period_share(j) * waves_, height(k)};
        const auto value = static_cast<float>(closest(heights, p));
        values_[(i * kSide + j) * kHeights + k] = value;
        values_[(j * kSide + i) * kHeights + k] = value;
      }
    }
  }
}

double RoughPlane::operator()(const Vec3& p) const noexcept {
  const double t = std::clamp((std::asinh(p.z / kScale) + kMost) / (2.0 * kMost), 0.0, 1.0);
  const Vec3 at{wrapped(p.x / waves_), wrapped(p.y / waves_),
                t * static_cast<double>(kHeights - 1)};
  const auto i = std::min(static_cast<std::size_t>(at.x), kSide - 2);
  const auto j = std::min(static_cast<std::size_t>(at.y), kSide - 2);
  const auto k = std::min(static_cast<std::size_t>(at.z), kHeights - 2);
  double sum = 0.0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t a = corner >> 2;
    const std::size_t b = (corner >> 1) & 1;
    const std::size_t c = corner & 1;
    const double weight = share(at.x, i, a) * share(at.y, j, b) * share(at.z, k, c);
    sum += weight * static_cast<double>(values_[((i + a) * kSide + j + b) * kHeights + k + c]);
  }
  return sum;
}

/// The nearest of the samples around, then Newton steps on the squared distance.
double RoughPlane::closest(const std::vector<double>& heights, const Vec3& p) const noexcept {
  const double step = waves_ / kSteps;
  double u = 0.0;
  double v = 0.0;
  const int low_i = static_cast<int>(std::lround(p.x / step)) - kSteps * 3 / 4;
  const int low_j = static_cast<int>(std::lround(p.y / step)) - kSteps * 3 / 4;
  const auto square_at = [&](int i, int j) {
    const auto n =
        static_cast<std::size_t>(((i + 2 * kSteps) % kSteps) * kSteps + (j + 2 * kSteps) % kSteps);
    const double dx = i * step - p.x;
    const double dy = j * step - p.y;
    const double dz = heights[n] - p.z;
    return dx * dx + dy * dy + dz * dz;
  };
  // A few samples, crests and troughs among them, show in which rows none can be nearer.
  double best = 1e300;
  for (int i = low_i; i <= low_i + kSteps * 3 / 2; ++i) {
    if (i % (kSteps / 4) != 0) continue;
    for (int j = low_j; j <= low_j + kSteps * 3 / 2; ++j) {
      if (j % (kSteps / 4) == 0) best = std::min(best, square_at(i, j));
    }
  }
  best = std::nextafter(best, 1e300);
  const double above = std::max(std::abs(p.z) - 1.0, 0.0);
  for (int i = low_i; i <= low_i + kSteps * 3 / 2; ++i) {
    const double beside = i * step - p.x;
    if (beside * beside + above * above >= best) continue;
    for (int j = low_j; j <= low_j + kSteps * 3 / 2; ++j) {
      const double square = square_at(i, j);
      if (square < best) {
        best = square;
        u = i * step;
        v = j * step;
      }
    }
  }
  return polished(p, u, v);
}

double RoughPlane::polished(const Vec3& p, double u, double v) const noexcept {
  const double k = kTurn / waves_;
  for (int turn = 0; turn < 12; ++turn) {
    const double su = std::sin(k * u);
    const double cu = std::cos(k * u);
    const double sv = std::sin(k * v);
    const double cv = std::cos(k * v);
    const double rise = su * sv - p.z;
    const double gu = (u - p.x) + rise * k * cu * sv;
    const double gv = (v - p.y) + rise * k * su * cv;
    const double uu = 1.0 + k * k * (cu * cu * sv * sv - rise * su * sv);
    const double vv = 1.0 + k * k * (su * su * cv * cv - rise * su * sv);
    const double uv = k * k * (cu * sv * su * cv + rise * cu * cv);
    const double det = uu * vv - uv * uv;
    if (!(det > 1e-6) || !(uu > 0.0)) break;
    u -= (vv * gu - uv * gv) / det;
    v -= (uu * gv - uv * gu) / det;
  }
  const double here = std::sin(k * u) * std::sin(k * v);
  const double distance = length(Vec3{u - p.x, v - p.y, here - p.z});
  return p.z < std::sin(k * p.x) * std::sin(k * p.y) ? -distance : distance;
}

ForceScene force_scene(const std::string& name, double radius_mm, double voxel_mm) {
  ForceScene scene;
  if (name == "ball") {
    scene = ball_scene(radius_mm);
  } else if (name == "torus") {
    scene = torus_scene(radius_mm);
  } else if (name == "edge") {
    scene = on_a_plane(edge_distance, radius_mm);
  } else if (name == "rough") {
    static const RoughPlane rough(8.0);
    scene = on_a_plane([=](const Vec3& q) { return voxel_mm * rough(q / voxel_mm); }, radius_mm);
  } else if (name == "slot") {
    scene = on_a_plane(
        [=](const Vec3& q) { return slot_distance(q, radius_mm / 2.0, 4.0 * radius_mm); },
        radius_mm);
  } else if (name == "sheet") {
    scene = on_a_plane([=](const Vec3& q) { return std::abs(q.z) - radius_mm / 2.0; }, radius_mm);
  } else {
    scene = on_a_plane([](const Vec3& q) { return q.z; }, radius_mm);
  }
  scene.name = name;
  return scene;
}

}  // namespace argil::test
