// SPDX-License-Identifier: GPL-3.0-or-later
// Small loops are triangulated by the best worst triangle, longer ones as a fan about a centre.
#include "surface/contour_loop.h"

#include <array>
#include <cassert>

namespace argil {

namespace {

using LoopCorners = std::span<const LoopCorner>;

bool may_join(const LoopCorner& a, const LoopCorner& b) { return (a.planes & b.planes) == 0; }

// Shape of a triangle, 1/12 when equilateral and 0 when degenerate: its squared double area over
// the square of the sum of its squared sides. It orders triangles much as the smallest angle does
// and needs neither roots nor arcs.
double shape(const LoopCorner& a, const LoopCorner& b, const LoopCorner& c) {
  const Vec3 u = b.position - a.position;
  const Vec3 v = c.position - a.position;
  const Vec3 w = v - u;
  const Vec3 n = cross(u, v);
  const double sides = dot(u, u) + dot(v, v) + dot(w, w);
  return dot(n, n) / (sides * sides);
}

double smaller(double a, double b) { return b < a ? b : a; }

void add(const LoopCorner& a, const LoopCorner& b, const LoopCorner& c, ContourMesh& mesh) {
  mesh.triangles.push_back({a.vertex, b.vertex, c.vertex});
}

// The diagonal with the better worst triangle, of those that lie in no plane of the body.
bool fill_four(LoopCorners p, ContourMesh& mesh) {
  assert(p.size() == 4);
  const bool even = may_join(p[0], p[2]);
  const bool odd = may_join(p[1], p[3]);
  if (!even && !odd) return false;
  bool use_even = even;
  if (even && odd) {
    use_even = smaller(shape(p[0], p[1], p[2]), shape(p[0], p[2], p[3])) >=
               smaller(shape(p[1], p[2], p[3]), shape(p[1], p[3], p[0]));
  }
  const std::size_t f = use_even ? 0 : 1;
  add(p[f], p[f + 1], p[f + 2], mesh);
  add(p[f], p[f + 2], p[(f + 3) % 4], mesh);
  return true;
}

// The five triangulations of a pentagon are the fans of its corners: two ears and a middle.
bool fill_five(LoopCorners p, ContourMesh& mesh) {
  assert(p.size() == 5);
  std::array<double, 5> ear;
  for (std::size_t i = 0; i < 5; ++i) ear[i] = shape(p[i], p[(i + 1) % 5], p[(i + 2) % 5]);
  std::size_t best = 5;
  double best_shape = -1.0;
  for (std::size_t f = 0; f < 5; ++f) {
    const LoopCorner& a = p[(f + 2) % 5];
    const LoopCorner& b = p[(f + 3) % 5];
    if (!may_join(p[f], a) || !may_join(p[f], b)) continue;
    const double worst = smaller(smaller(ear[f], ear[(f + 3) % 5]), shape(p[f], a, b));
    if (worst > best_shape) {
      best = f;
      best_shape = worst;
    }
  }
  if (best == 5) return false;
  for (std::size_t i = 1; i < 4; ++i) {
    add(p[best], p[(best + i) % 5], p[(best + i + 1) % 5], mesh);
  }
  return true;
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

// The centre's normal is the mean of the corners', or one of them where that is zero.
void fill_about_centre(LoopCorners loop, const LoopBody& body, ContourMesh& mesh) {
  Vec3 normal;
  for (const LoopCorner& corner : loop) normal += mesh.normals[corner.vertex];
  normal = normalized(normal);
  if (dot(normal, normal) == 0.0) normal = mesh.normals[loop[0].vertex];
  const std::uint32_t centre = mesh.add_vertex(ContourMesh::kNoKey, centre_of(loop, body), normal);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    mesh.triangles.push_back(
        {centre, loop[i].vertex, loop[i + 1 < loop.size() ? i + 1 : 0].vertex});
  }
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

LoopFill fill_loop(LoopCorners loop, const LoopBody& body, ContourMesh& mesh) {
  assert(loop.size() >= 3);
  if (loop.size() == 3) {
    add(loop[0], loop[1], loop[2], mesh);
    return LoopFill::triangles;
  }
  if (loop.size() == 4 && fill_four(loop, mesh)) return LoopFill::triangles;
  if (loop.size() == 5 && fill_five(loop, mesh)) return LoopFill::triangles;
  fill_about_centre(loop, body, mesh);
  return LoopFill::centre;
}

}  // namespace argil
