// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/measure/dense_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "support/measure/triangle_buckets.h"

namespace argil::test {
namespace {

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

/// A cube in space.
struct Cube {
  Vec3 low;
  double side = 0.0;
  double met = 0.0;  ///< the greatest distance found in it or in that of which it is an eighth
  bool may_exceed = true;

  Vec3 middle() const { return low + 0.5 * side * Vec3{1, 1, 1}; }
  double reach() const { return 0.5 * std::sqrt(3.0) * side; }  ///< from there to its corners
};

Cube eighth_of(const Cube& cube, std::size_t number) {
  const double side = 0.5 * cube.side;
  const auto shift = [&](unsigned bit) { return (number >> bit & 1U) != 0 ? side : 0.0; };
  return {cube.low + Vec3{shift(2), shift(1), shift(0)}, side, cube.met};
}

/// A number within [0, 1) for each index, evenly spread: SplitMix64.
double random_of(std::uint64_t index) {
  std::uint64_t x = (index + 1) * 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return static_cast<double>((x ^ (x >> 31U)) >> 11U) * 0x1p-53;
}

/// Points with phi = 0, on lines along the axes.
class ZeroLines {
 public:
  explicit ZeroLines(const Clay& clay) : clay_(clay) {}

  double phi(const Vec3& p) const { return clay_.distance_at(p); }

  /// Calls `use(point)` where the line from `a` along an axis passes phi = 0 within `steps` of this
  /// length. Where levels meet phi may jump across zero: that is no point of the surface.
  template <class Use>
  void pass(Vec3 a, std::size_t axis, double step, int steps, const Use& use) const {
    const double from = a[axis];
    double before = phi(a);
    for (int i = 1; i <= steps; ++i) {
      Vec3 b = a;
      b[axis] = from + i * step;
      const double behind = phi(b);
      if ((before < 0.0) != (behind < 0.0)) {
        const Vec3 in = before < 0.0 ? halved(a, b) : halved(b, a);
        if (std::abs(phi(in)) < 0.01 * clay_.options().voxel_mm) use(in);
      }
      a = b;
      before = behind;
    }
  }

  /// The area that a point on lines of this spacing along all three axes stands for, by the slope.
  double area_at(const Vec3& p, double spacing) const {
    const double probe = 0.01 * spacing;
    Vec3 slope;
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 on = p;
      on[k] += probe;
      Vec3 off = p;
      off[k] -= probe;
      slope[k] = std::abs(phi(on) - phi(off));
    }
    const double size = length(slope);
    const double shown = size > 0.0 ? (slope.x + slope.y + slope.z) / size : 1.0;
    return spacing * spacing / std::max(1.0, shown);
  }

 private:
  /// The last point inside between one inside and one outside.
  Vec3 halved(Vec3 in, Vec3 out) const {
    for (int k = 0; k < 14; ++k) {
      const Vec3 middle = 0.5 * (in + out);
      (phi(middle) < 0.0 ? in : out) = middle;
    }
    return in;
  }

  const Clay& clay_;
};

/// How far points with phi = 0 are from a mesh.
class FieldSide {
 public:
  FieldSide(const TriangleMesh& mesh, const TriangleMesh& surface, const Clay& clay, double step_mm)
      : lines_(clay),
        buckets_(mesh, 4.0 * clay.options().voxel_mm),
        step_mm_(step_mm),
        voxel_mm_(clay.options().voxel_mm) {
    for (const Vec3& low : cubes_near(surface, voxel_mm_)) cubes_.push_back({low, voxel_mm_, 0.0});
  }

  mesh::DistanceSummary measure() const;

 private:
  Sum on_lines(std::uint64_t number) const;
  double greatest(std::vector<Cube> cubes, double found) const;
  bool may_exceed(const Cube& cube, double found) const;
  double greatest_on_axes(const Cube& cube) const;

  ZeroLines lines_;
  TriangleBuckets buckets_;
  double step_mm_;
  double voxel_mm_;
  std::vector<Cube> cubes_;
};

/// Over n x n lines along each axis of a cube, each anywhere in its square: what repeats in step
/// with the lattice, such as the rims of a block, would be met everywhere alike.
Sum FieldSide::on_lines(std::uint64_t number) const {
  const Cube& cube = cubes_[number];
  const int n = static_cast<int>(std::ceil(voxel_mm_ / step_mm_));
  const double step = cube.side / n;
  Sum sum;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int line = 0; line < n * n; ++line) {
      const std::uint64_t seed = 2 * ((3 * number + axis) * 4096 + static_cast<unsigned>(line));
      Vec3 a = cube.low;
      a[(axis + 1) % 3] += (line / n + random_of(seed)) * step;
      a[(axis + 2) % 3] += (line % n + random_of(seed + 1)) * step;
      lines_.pass(a, axis, step, n, [&](const Vec3& at) {
        sum.add(buckets_.distance(at), lines_.area_at(at, step));
      });
    }
  }
  return sum;
}

/// Whether a point with phi = 0 in the cube may be farther from the mesh than `found`: no distance
/// changes faster than its point moves, and phi not much faster.
bool FieldSide::may_exceed(const Cube& cube, double found) const {
  constexpr double kSteepest = 1.5;
  const Vec3 middle = cube.middle();
  return std::abs(lines_.phi(middle)) <= kSteepest * cube.reach() &&
         buckets_.distance(middle) + cube.reach() > found;
}

/// Of the points with phi = 0 on the three lines through the middle.
double FieldSide::greatest_on_axes(const Cube& cube) const {
  double most = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 a = cube.middle();
    a[axis] = cube.low[axis];
    lines_.pass(a, axis, 0.5 * cube.side, 2,
                [&](const Vec3& at) { most = std::max(most, buckets_.distance(at)); });
  }
  return most;
}

/// The greatest distance in cubes of one size, if it exceeds `found`: they are halved, down to a
/// sixty-fourth of a voxel, and those left out where it cannot lie, or where it is so much less
/// that it will not: the nearer, the denser.
double FieldSide::greatest(std::vector<Cube> cubes, double found) const {
  while (!cubes.empty() && cubes.front().side > voxel_mm_ / 64.0) {
    std::vector<Cube> eighths(8 * cubes.size());
    tbb::parallel_for(std::size_t{0}, eighths.size(), [&](std::size_t i) {
      Cube& cube = eighths[i] = eighth_of(cubes[i / 8], i % 8);
      // Where the surface meets none of the three lines what is known of the whole counts.
      cube.may_exceed = may_exceed(cube, found);
      if (cube.may_exceed) cube.met = std::max(cube.met, greatest_on_axes(cube));
    });
    for (const Cube& cube : eighths) found = std::max(found, cube.met);
    const double near = (cubes.front().side > 0.2 * voxel_mm_ ? 0.7 : 0.9) * found;
    cubes.clear();
    std::copy_if(eighths.begin(), eighths.end(), std::back_inserter(cubes),
                 [&](const Cube& cube) { return cube.met > near && cube.may_exceed; });
  }
  return found;
}

mesh::DistanceSummary FieldSide::measure() const {
  std::vector<Sum> sums(cubes_.size());
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t i) { sums[i] = on_lines(i); });
  Sum all;
  for (const Sum& s : sums) all.add(s);
  std::vector<Cube> open;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].max <= 0.6 * all.max) continue;
    open.push_back(cubes_[i]);
    open.back().met = sums[i].max;
  }
  all.max = greatest(std::move(open), all.max);
  return summary_of(all);
}

}  // namespace

mesh::MeshError dense_error(const TriangleMesh& mesh, const TriangleMesh& surface, const Clay& clay,
                            double step_mm) {
  return {mesh_to_field(mesh, clay, step_mm), FieldSide(mesh, surface, clay, step_mm).measure()};
}

}  // namespace argil::test
