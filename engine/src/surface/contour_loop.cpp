// SPDX-License-Identifier: GPL-3.0-or-later
// Small loops are triangulated by the best worst triangle, longer ones as a fan about a centre.
#include "surface/contour_loop.h"

#include <array>
#include <cassert>

namespace argil {

namespace {

using LoopCorners = std::span<const LoopCorner>;

bool may_join(const LoopCorner& a, const LoopCorner& b) { return (a.planes & b.planes) == 0; }

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

void add(const LoopCorner& a, const LoopCorner& b, const LoopCorner& c, ContourMesh& mesh) {
  mesh.triangles.push_back({a.vertex, b.vertex, c.vertex});
}

// The diagonal with the better worst triangle, of those that lie in no plane of the body.
void fill_four(LoopCorners p, ContourMesh& mesh) {
  assert(p.size() == 4);
  const bool even = may_join(p[0], p[2]);
  const bool odd = may_join(p[1], p[3]);
  assert(even || odd);
  bool use_even = even;
  if (even && odd) {
    const Vec3& a = p[0].position;
    const Vec3& b = p[1].position;
    const Vec3& c = p[2].position;
    const Vec3& d = p[3].position;
    const Four shape = shapes(points(a, a, b, b), points(b, c, c, d), points(c, d, d, a));
    use_even = smaller(shape[0], shape[1]) >= smaller(shape[2], shape[3]);
  }
  const std::size_t f = use_even ? 0 : 1;
  add(p[f], p[f + 1], p[f + 2], mesh);
  add(p[f], p[f + 2], p[(f + 3) % 4], mesh);
}

// The five triangulations of a pentagon are the fans of its corners: two ears and a middle.
struct PentagonShapes {
  std::array<double, 5> ear;     ///< of corners i, i + 1, i + 2
  std::array<double, 5> middle;  ///< of corners i, i + 2, i + 3
};
PentagonShapes shapes_of_pentagon(LoopCorners p) {
  const auto at = [&](std::size_t i) -> const Vec3& { return p[i % 5].position; };
  const auto from = [&](std::size_t i) { return points(at(i), at(i + 1), at(i + 2), at(i + 3)); };
  const FourPoints first = from(0);
  const Four ear = shapes(first, from(1), from(2));
  const Four middle = shapes(first, from(2), from(3));
  const Four last = shapes(points(at(4), at(4), at(4), at(4)), points(at(0), at(1), at(0), at(1)),
                           points(at(1), at(2), at(1), at(2)));
  return {{ear[0], ear[1], ear[2], ear[3], last[0]},
          {middle[0], middle[1], middle[2], middle[3], last[1]}};
}

void fill_five(LoopCorners p, ContourMesh& mesh) {
  assert(p.size() == 5);
  const PentagonShapes shape = shapes_of_pentagon(p);
  std::size_t best = 5;
  double best_shape = 0.0;
  for (std::size_t f = 0; f < 5; ++f) {
    if (!may_join(p[f], p[(f + 2) % 5]) || !may_join(p[f], p[(f + 3) % 5])) continue;
    const double worst = smaller(smaller(shape.ear[f], shape.ear[(f + 3) % 5]), shape.middle[f]);
    if (best == 5 || worst > best_shape) {
      best = f;
      best_shape = worst;
    }
  }
  assert(best < 5);
  for (std::size_t i = 1; i < 4; ++i) {
    add(p[best], p[(best + i) % 5], p[(best + i + 1) % 5], mesh);
  }
}

double clamped(double v, double low, double high) { return v < low ? low : (v > high ? high : v); }

Vec3 centre_of(LoopCorners loop, const LoopBody& body) {
  Vec3 sum;
  std::uint32_t common = ~std::uint32_t{0};
  for (const LoopCorner& corner : loop) {
    sum += corner.position;
    common &= corner.planes;
  }
  Vec3 mean = sum / static_cast<double>(loop.size());
  if (common != 0) mean = mean * 0.96 + body.middle * 0.04;
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

bool needs_centre(LoopCorners loop) noexcept {
  assert(loop.size() >= 3);
  if (loop.size() == 3) return false;
  if (loop.size() == 4) return !may_join(loop[0], loop[2]) && !may_join(loop[1], loop[3]);
  if (loop.size() > 5) return true;
  for (std::size_t f = 0; f < 5; ++f) {
    if (may_join(loop[f], loop[(f + 2) % 5]) && may_join(loop[f], loop[(f + 3) % 5])) return false;
  }
  return true;
}

void fill_plainly(LoopCorners loop, ContourMesh& mesh) {
  assert(!needs_centre(loop));
  if (loop.size() == 3) return add(loop[0], loop[1], loop[2], mesh);
  if (loop.size() == 4) return fill_four(loop, mesh);
  fill_five(loop, mesh);
}

// The centre's normal is the mean of the corners', or one of them where that is zero.
void fill_about_centre(LoopCorners loop, const LoopBody& body, std::uint32_t centre,
                       ContourMesh& mesh) {
  assert(loop.size() >= 3 && centre < mesh.positions.size());
  Vec3 normal;
  for (const LoopCorner& corner : loop) normal += mesh.normals[corner.vertex];
  normal = normalized(normal);
  if (dot(normal, normal) == 0.0) normal = mesh.normals[loop[0].vertex];
  mesh.keys[centre] = ContourMesh::kNoKey;
  mesh.positions[centre] = centre_of(loop, body);
  mesh.normals[centre] = normal;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    mesh.triangles.push_back(
        {centre, loop[i].vertex, loop[i + 1 < loop.size() ? i + 1 : 0].vertex});
  }
}

}  // namespace argil
