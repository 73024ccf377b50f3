// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/measure/dense_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "support/effort.h"

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

struct Sum {
  double area = 0.0, distance = 0.0, square = 0.0, max = 0.0;

  void add(double d, double weight) { add({weight, weight * d, weight * d * d, d}); }
  void add(const Sum& s) {
    area += s.area;
    distance += s.distance;
    square += s.square;
    max = std::max(max, s.max);
  }
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
    sum.add(distance(a + (u * i + v * j) / n), weight);
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

mesh::DistanceSummary summary_of(const Sum& all) {
  return {all.max, all.distance / all.area, std::sqrt(all.square / all.area)};
}

/// |phi| over the mesh; triangles with values near the greatest again, five times as dense.
mesh::DistanceSummary mesh_to_field(const TriangleMesh& mesh, const Clay& clay, double step_mm) {
  const auto distance = [&](const Vec3& p) { return std::abs(clay.distance_at(p)); };
  std::vector<Sum> sums(mesh.triangles.size());
  tbb::parallel_for(std::size_t{0}, sums.size(),
                    [&](std::size_t t) { sums[t] = over_triangle(mesh, t, step_mm, distance); });
  Sum all;
  for (const Sum& s : sums) all.add(s);
  const double near = 0.7 * all.max;
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t t) {
    if (sums[t].max > near) sums[t] = over_triangle(mesh, t, 0.2 * step_mm, distance);
  });
  for (const Sum& s : sums) all.max = std::max(all.max, s.max);
  return summary_of(all);
}

/// The cubes of a lattice of a voxel that come near a surface.
std::vector<Vec3> cubes_near(const TriangleMesh& surface, double voxel) {
  std::set<std::array<int, 3>> cubes;
  const auto key = [&](double x) { return static_cast<int>(std::floor(x / voxel)); };
  for (const Triangle& t : surface.triangles) {
    Box3 box;
    for (const std::uint32_t v : t) box.include(surface.positions[v]);
    for (int x = key(box.min.x - 0.3 * voxel); x <= key(box.max.x + 0.3 * voxel); ++x) {
      for (int y = key(box.min.y - 0.3 * voxel); y <= key(box.max.y + 0.3 * voxel); ++y) {
        for (int z = key(box.min.z - 0.3 * voxel); z <= key(box.max.z + 0.3 * voxel); ++z) {
          cubes.insert({x, y, z});
        }
      }
    }
  }
  std::vector<Vec3> lows;
  for (const auto& [x, y, z] : cubes) lows.push_back({x * voxel, y * voxel, z * voxel});
  return lows;
}

/// The points with phi = 0 in a cube, on n x n lines along each axis, and the area each stands for:
/// by how the lines are spaced and by the slope there. Where levels meet phi may jump across zero:
/// that is no point of the surface.
template <class Use>
void on_lines(const Vec3& low, double side, int n, const Clay& clay, const Use& use) {
  const double step = side / n;
  const auto phi = [&](const Vec3& p) { return clay.distance_at(p); };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int line = 0; line < n * n; ++line) {
      Vec3 a = low;
      a[(axis + 1) % 3] += (line / n + 0.5) * step;
      a[(axis + 2) % 3] += (line % n + 0.5) * step;
      double before = phi(a);
      for (int i = 0; i < n; ++i) {
        Vec3 b = a;
        b[axis] = low[axis] + (i + 1) * step;
        const double behind = phi(b);
        if ((before < 0.0) != (behind < 0.0)) {
          Vec3 in = before < 0.0 ? a : b;
          Vec3 out = before < 0.0 ? b : a;
          for (int k = 0; k < 14; ++k) {
            const Vec3 middle = 0.5 * (in + out);
            (phi(middle) < 0.0 ? in : out) = middle;
          }
          if (std::abs(phi(in)) < 0.01 * side) {
            const double probe = 0.01 * step;
            Vec3 slope;
            for (std::size_t k = 0; k < 3; ++k) {
              Vec3 on = in;
              on[k] += probe;
              Vec3 off = in;
              off[k] -= probe;
              slope[k] = std::abs(phi(on) - phi(off));
            }
            const double size = length(slope);
            const double shown = size > 0.0 ? (slope.x + slope.y + slope.z) / size : 1.0;
            use(in, step * step / std::max(1.0, shown));
          }
        }
        a = b;
        before = behind;
      }
    }
  }
}

mesh::DistanceSummary field_to_mesh(const TriangleMesh& mesh, const TriangleMesh& surface,
                                    const Clay& clay, double step_mm) {
  const double voxel = clay.options().voxel_mm;
  const Buckets buckets(mesh, 4.0 * voxel);
  const std::vector<Vec3> cubes = cubes_near(surface, voxel);
  std::vector<Sum> sums(cubes.size());
  const auto measure = [&](std::size_t i, int n) {
    sums[i] = {};
    on_lines(cubes[i], voxel, n, clay,
             [&](const Vec3& at, double area) { sums[i].add(buckets.distance(at), area); });
  };
  const int lines = static_cast<int>(std::ceil(voxel / step_mm));
  tbb::parallel_for(std::size_t{0}, cubes.size(), [&](std::size_t i) { measure(i, lines); });
  Sum all;
  for (const Sum& s : sums) all.add(s);
  // The greatest lies in a cube where it is nearly as great already; the nearer, the denser.
  for (const auto& [times, share] : {std::pair{4, 0.7}, std::pair{16, effort(0.9, 0.7)}}) {
    const double near = share * all.max;
    tbb::parallel_for(std::size_t{0}, cubes.size(), [&, more = times](std::size_t i) {
      if (sums[i].max > near) measure(i, more * lines);
    });
    for (const Sum& s : sums) all.max = std::max(all.max, s.max);
  }
  return summary_of(all);
}

}  // namespace

mesh::MeshError dense_error(const TriangleMesh& mesh, const TriangleMesh& surface, const Clay& clay,
                            double step_mm) {
  return {mesh_to_field(mesh, clay, step_mm), field_to_mesh(mesh, surface, clay, step_mm)};
}

}  // namespace argil::test
