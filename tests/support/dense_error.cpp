// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/dense_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include <tbb/parallel_for.h>

namespace argil::test {
namespace {

/// The distance from a point to a triangle: from the plane where the foot lies within, else from
/// the nearest side.
double distance_to(const Vec3& p, const std::array<Vec3, 3>& t) {
  const Vec3 n = normalized(cross(t[1] - t[0], t[2] - t[0]));
  bool inside = n != Vec3{};
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 side = t[(k + 1) % 3] - t[k];
    if (dot(cross(n, side), p - t[k]) < 0.0) inside = false;
    const double square = dot(side, side);
    const double along = square > 0.0 ? std::clamp(dot(p - t[k], side) / square, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, length(p - (t[k] + along * side)));
  }
  return inside ? std::abs(dot(n, p - t[0])) : nearest;
}

/// The triangles of a mesh by the boxes of a grid that they touch.
class Buckets {
 public:
  Buckets(const TriangleMesh& mesh, double side) : mesh_(mesh), side_(side) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      Box3 box;
      for (const std::uint32_t v : mesh.triangles[t]) box.include(mesh.positions[v]);
      const Key low = key(box.min);
      const Key high = key(box.max);
      for (int x = low[0]; x <= high[0]; ++x) {
        for (int y = low[1]; y <= high[1]; ++y) {
          for (int z = low[2]; z <= high[2]; ++z) boxes_[{x, y, z}].push_back(t);
        }
      }
    }
  }

  double distance(const Vec3& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (int ring = 0; nearest > (ring - 1) * side_; ++ring) look_in_ring(p, ring, nearest);
    return nearest;
  }

 private:
  using Key = std::array<int, 3>;
  struct KeyHash {
    std::size_t operator()(const Key& k) const noexcept {
      return static_cast<std::size_t>((static_cast<unsigned>(k[0]) * 73856093U) ^
                                      (static_cast<unsigned>(k[1]) * 19349663U) ^
                                      (static_cast<unsigned>(k[2]) * 83492791U));
    }
  };
  Key key(const Vec3& p) const {
    const auto of = [&](double x) { return static_cast<int>(std::floor(x / side_)); };
    return {of(p.x), of(p.y), of(p.z)};
  }
  void look_in_ring(const Vec3& p, int ring, double& nearest) const {
    const Key at = key(p);
    for (int x = -ring; x <= ring; ++x) {
      for (int y = -ring; y <= ring; ++y) {
        const bool rim = std::abs(x) == ring || std::abs(y) == ring;
        for (int z = -ring; z <= ring; z += rim || ring == 0 ? 1 : 2 * ring) {
          const auto box = boxes_.find({at[0] + x, at[1] + y, at[2] + z});
          if (box == boxes_.end()) continue;
          for (const std::uint32_t t : box->second) {
            const auto& [a, b, c] = mesh_.triangles[t];
            nearest = std::min(nearest, distance_to(p, {mesh_.positions[a], mesh_.positions[b],
                                                        mesh_.positions[c]}));
          }
        }
      }
    }
  }

  const TriangleMesh& mesh_;
  double side_;
  std::unordered_map<Key, std::vector<std::uint32_t>, KeyHash> boxes_;
};

/// The place with phi = 0 along the gradient, within half a voxel of `p`; nothing where it does not
/// change sign there or jumps, as it may where levels meet.
std::optional<Vec3> on_surface(const Vec3& p, const Clay& clay) {
  const double voxel = clay.options().voxel_mm;
  const double probe = 0.1 * voxel;
  Vec3 slope;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 step;
    step[axis] = probe;
    slope[axis] = clay.distance_at(p + step) - clay.distance_at(p - step);
  }
  const Vec3 outward = normalized(slope);
  double low = 0.0;
  double high = 0.0;
  while (high < 0.5 * voxel && (clay.distance_at(p - low * outward) > 0.0) ==
                                   (clay.distance_at(p + high * outward) > 0.0)) {
    high += probe;
    low += probe;
  }
  double inside = -low;
  double outside = high;
  if (clay.distance_at(p + inside * outward) > 0.0 ||
      clay.distance_at(p + outside * outward) < 0.0) {
    return std::nullopt;
  }
  for (int i = 0; i < 14; ++i) {
    const double middle = 0.5 * (inside + outside);
    (clay.distance_at(p + middle * outward) < 0.0 ? inside : outside) = middle;
  }
  const Vec3 place = p + inside * outward;
  if (std::abs(clay.distance_at(place)) > 0.01 * voxel) return std::nullopt;
  return place;
}

struct Sum {
  double area = 0.0, distance = 0.0, square = 0.0, max = 0.0;
};

/// `distance` at the corners, for the maximum, and at the middles of n^2 like parts.
template <class Distance>
Sum over_triangle(const TriangleMesh& mesh, std::size_t t, double step_mm,
                  const Distance& distance) {
  const auto& [ia, ib, ic] = mesh.triangles[t];
  const Vec3& a = mesh.positions[ia];
  const Vec3 u = mesh.positions[ib] - a;
  const Vec3 v = mesh.positions[ic] - a;
  const double side = std::max({length(u), length(v), length(v - u)});
  const int n = std::max(4, static_cast<int>(std::ceil(side / step_mm)));
  const double area = 0.5 * length(cross(u, v)) / (n * n);
  Sum sum;
  const auto add = [&](double i, double j, double weight) {
    const std::optional<double> d = distance(a + (u * i + v * j) / n);
    if (!d) return;
    sum.area += weight;
    sum.distance += weight * *d;
    sum.square += weight * *d * *d;
    sum.max = std::max(sum.max, *d);
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      add(i + 1.0 / 3.0, j + 1.0 / 3.0, area);
      if (i + j + 1 < n) add(i + 2.0 / 3.0, j + 2.0 / 3.0, area);
    }
  }
  add(0.0, 0.0, 0.0);
  add(n, 0.0, 0.0);
  add(0.0, n, 0.0);
  return sum;
}

/// Over all triangles; those with distances near the greatest again, five times as dense.
template <class Distance>
io::DistanceSummary over(const TriangleMesh& mesh, double step_mm, const Distance& distance) {
  std::vector<Sum> sums(mesh.triangles.size());
  tbb::parallel_for(std::size_t{0}, sums.size(),
                    [&](std::size_t t) { sums[t] = over_triangle(mesh, t, step_mm, distance); });
  Sum all;
  for (const Sum& s : sums) {
    all.area += s.area;
    all.distance += s.distance;
    all.square += s.square;
    all.max = std::max(all.max, s.max);
  }
  const double near = 0.7 * all.max;
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t t) {
    if (sums[t].max > near) sums[t] = over_triangle(mesh, t, 0.2 * step_mm, distance);
  });
  for (const Sum& s : sums) all.max = std::max(all.max, s.max);
  return {all.max, all.distance / all.area, std::sqrt(all.square / all.area)};
}

}  // namespace

io::MeshError dense_error(const TriangleMesh& mesh, const TriangleMesh& surface, const Clay& clay,
                          double step_mm) {
  io::MeshError error;
  error.mesh_to_field = over(
      mesh, step_mm, [&](const Vec3& p) { return std::optional(std::abs(clay.distance_at(p))); });
  const Buckets buckets(mesh, 4.0 * clay.options().voxel_mm);
  error.field_to_mesh = over(surface, step_mm, [&](const Vec3& p) -> std::optional<double> {
    const std::optional<Vec3> on = on_surface(p, clay);
    if (!on) return std::nullopt;
    return buckets.distance(*on);
  });
  return error;
}

}  // namespace argil::test
