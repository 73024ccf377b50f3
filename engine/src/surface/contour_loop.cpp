// SPDX-License-Identifier: GPL-3.0-or-later
// Small loops are triangulated by the best worst triangle, longer ones as a fan about a centre.
#include "surface/contour_loop.h"

#include <array>
#include <cassert>

#include "rows/rows.h"

namespace argil {

namespace {

using Loop = std::span<const std::uint32_t>;

using Four = double __attribute__((vector_size(32)));

// Four triangles at once, a lane each.
struct FourPoints {
  Four x, y, z;
};
FourPoints operator-(const FourPoints& a, const FourPoints& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Four dot(const FourPoints& a, const FourPoints& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
FourPoints cross(const FourPoints& a, const FourPoints& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
FourPoints points(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return {Four{a.x, b.x, c.x, d.x}, Four{a.y, b.y, c.y, d.y}, Four{a.z, b.z, c.z, d.z}};
}

// Shapes of triangles, 1/12 when equilateral and 0 when degenerate: their squared double area over
// the square of the sum of their squared sides. That orders triangles much as the smallest angle
// does and needs neither roots nor arcs.
Four shapes(const FourPoints& a, const FourPoints& b, const FourPoints& c) {
  const FourPoints u = b - a;
  const FourPoints v = c - a;
  const FourPoints w = v - u;
  const FourPoints n = cross(u, v);
  const Four sides = dot(u, u) + dot(v, v) + dot(w, w);
  return dot(n, n) / (sides * sides);
}

double smaller(double a, double b) { return b < a ? b : a; }

// The diagonal with the better worst triangle, of those that lie in no plane of the body.
void fill_four(Loop p, unsigned joins, ContourMesh& mesh) {
  assert(p.size() == 4 && (joins & ~3U) == 0 && joins != 0);
  unsigned char is_even = joins == 1 ? 1 : 0;
  if (joins == 3) {
    const Quadrilateral quad{{p[0], p[1], p[2], p[3]}};
    row_loops().choose_diagonals(&mesh.positions[0].x, &quad, 1, &is_even);
  }
  std::array<Triangle, 2> two;
  fill_along({p[0], p[1], p[2], p[3]}, is_even != 0, two.data());
  mesh.triangles.insert(mesh.triangles.end(), two.begin(), two.end());
}

// The five triangulations of a pentagon are the fans of its corners: two ears and a middle.
struct PentagonShapes {
  std::array<double, 5> ear;     ///< of corners i, i + 1, i + 2
  std::array<double, 5> middle;  ///< of corners i, i + 2, i + 3
};
PentagonShapes shapes_of_pentagon(Loop p, const ContourMesh& mesh) {
  const auto at = [&](std::size_t i) -> const Vec3& { return mesh.positions[p[i % 5]]; };
  const auto from = [&](std::size_t i) { return points(at(i), at(i + 1), at(i + 2), at(i + 3)); };
  const FourPoints first = from(0);
  const Four ear = shapes(first, from(1), from(2));
  const Four middle = shapes(first, from(2), from(3));
  const Four last = shapes(points(at(4), at(4), at(4), at(4)), points(at(0), at(1), at(0), at(1)),
                           points(at(1), at(2), at(1), at(2)));
  return {{ear[0], ear[1], ear[2], ear[3], last[0]},
          {middle[0], middle[1], middle[2], middle[3], last[1]}};
}

void fill_five(Loop p, unsigned joins, ContourMesh& mesh) {
  assert(p.size() == 5 && (joins & ~0x1fU) == 0 && joins != 0);
  const PentagonShapes shape = shapes_of_pentagon(p, mesh);
  std::size_t best = 5;
  double best_shape = 0.0;
  for (std::size_t f = 0; f < 5; ++f) {
    if ((joins >> f & 1U) == 0) continue;
    const double worst = smaller(smaller(shape.ear[f], shape.ear[(f + 3) % 5]), shape.middle[f]);
    if (best == 5 || worst > best_shape) {
      best = f;
      best_shape = worst;
    }
  }
  assert(best < 5);
  for (std::size_t i = 1; i < 4; ++i) {
    mesh.triangles.push_back({p[best], p[(best + i) % 5], p[(best + i + 1) % 5]});
  }
}

double clamped(double v, double low, double high) { return v < low ? low : (v > high ? high : v); }

/// How far above the corners' mean the surface is there, along the mean normal. On a paraboloid the
/// mean lies as far below it as the corners' tangent planes pass above it, so it is half of those.
/// Nothing where the corners face apart.
double lift_of(Loop loop, const Vec3& mean, const Vec3& normal, const ContourMesh& mesh) {
  constexpr double kLeastCosine = 0.8;
  double sum = 0.0;
  for (const std::uint32_t vertex : loop) {
    const double facing = dot(normal, mesh.normals[vertex]);
    if (!(facing > kLeastCosine)) return 0.0;
    sum += dot(mesh.positions[vertex] - mean, mesh.normals[vertex]) / facing;
  }
  return sum / (2.0 * static_cast<double>(loop.size()));
}

Vec3 centre_of(Loop loop, const LoopShape& shape, const LoopBody& body, const Vec3& normal,
               const ContourMesh& mesh) {
  constexpr double kMostLift = 0.2;  // of the body's extent
  Vec3 mean;
  for (const std::uint32_t vertex : loop) mean += mesh.positions[vertex];
  mean = mean / static_cast<double>(loop.size());
  if (shape.is_in_a_plane) {
    mean = mean * 0.96 + body.middle * 0.04;
  } else {
    const double most = kMostLift * (body.max.x - body.min.x);
    mean += clamped(lift_of(loop, mean, normal, mesh), -most, most) * normal;
  }
  return {clamped(mean.x, body.min.x, body.max.x), clamped(mean.y, body.min.y, body.max.y),
          clamped(mean.z, body.min.z, body.max.z)};
}

}  // namespace

std::uint32_t ContourMesh::add_vertex(std::uint64_t key, const Vec3& position, const Vec3& normal) {
  assert(keys.size() == positions.size() && keys.size() == normals.size());
  assert(is_finite(position) && is_finite(normal));
  keys.push_back(key);
  positions.push_back(position);
  normals.push_back(normal);
  return static_cast<std::uint32_t>(positions.size() - 1);
}

void ContourMesh::clear() noexcept {
  keys.clear();
  positions.clear();
  normals.clear();
  triangles.clear();
}

LoopShape shape_of(std::span<const std::uint32_t> planes) noexcept {
  const std::size_t count = planes.size();
  assert(count >= 3 && count <= 0xffff);
  const auto may_join = [&](std::size_t a, std::size_t b) {
    return (planes[a % count] & planes[b % count]) == 0;
  };
  LoopShape shape{static_cast<std::uint16_t>(count), 0, false};
  std::uint32_t common = ~std::uint32_t{0};
  for (const std::uint32_t each : planes) common &= each;
  shape.is_in_a_plane = common != 0;
  unsigned joins = 0;
  for (std::size_t f = 0; f < 2 && count == 4; ++f) joins |= may_join(f, f + 2) ? 1U << f : 0U;
  for (std::size_t f = 0; f < 5 && count == 5; ++f) {
    joins |= may_join(f, f + 2) && may_join(f, f + 3) ? 1U << f : 0U;
  }
  shape.joins = static_cast<std::uint8_t>(joins);
  return shape;
}

void fill_plainly(Loop loop, const LoopShape& shape, ContourMesh& mesh) {
  assert(loop.size() == shape.length && !shape.has_centre());
  if (loop.size() == 3) {
    mesh.triangles.push_back({loop[0], loop[1], loop[2]});
  } else if (loop.size() == 4) {
    fill_four(loop, shape.joins, mesh);
  } else {
    fill_five(loop, shape.joins, mesh);
  }
}

// The centre's normal is the mean of the corners', or one of them where that is zero.
void fill_about_centre(Loop loop, const LoopShape& shape, const LoopBody& body, ContourMesh& mesh) {
  assert(loop.size() == shape.length && loop.size() >= 3);
  Vec3 normal;
  for (const std::uint32_t vertex : loop) normal += mesh.normals[vertex];
  normal = normalized(normal);
  if (dot(normal, normal) == 0.0) normal = mesh.normals[loop[0]];
  const std::uint32_t centre =
      mesh.add_vertex(ContourMesh::kNoKey, centre_of(loop, shape, body, normal, mesh), normal);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    mesh.triangles.push_back({centre, loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]});
  }
}

}  // namespace argil
