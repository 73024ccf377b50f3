// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

namespace argil::test {

TriangleMesh box_mesh(const Vec3& size_mm, const Vec3& center_mm) {
  TriangleMesh mesh;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 side{(corner & 1U) != 0 ? 0.5 : -0.5, (corner & 2U) != 0 ? 0.5 : -0.5,
                    (corner & 4U) != 0 ? 0.5 : -0.5};
    mesh.positions.push_back(center_mm +
                             Vec3{side.x * size_mm.x, side.y * size_mm.y, side.z * size_mm.z});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TriangleMesh torus_mesh(double radius_mm, double tube_mm, int segments, int rings) {
  TriangleMesh mesh;
  const auto vertex = [&](int segment, int ring) {
    return static_cast<std::uint32_t>((segment % segments) * rings + ring % rings);
  };
  for (int s = 0; s < segments; ++s) {
    for (int r = 0; r < rings; ++r) {
      const double around = 2.0 * std::numbers::pi * s / segments;
      const double across = 2.0 * std::numbers::pi * r / rings;
      const double reach = radius_mm + tube_mm * std::cos(across);
      mesh.positions.push_back(
          {reach * std::cos(around), reach * std::sin(around), tube_mm * std::sin(across)});
      mesh.triangles.push_back({vertex(s, r), vertex(s + 1, r), vertex(s + 1, r + 1)});
      mesh.triangles.push_back({vertex(s, r), vertex(s + 1, r + 1), vertex(s, r + 1)});
    }
  }
  return mesh;
}

TriangleMesh self_crossing_mesh() {
  TriangleMesh knot = torus_mesh(10.0, 3.0, 96, 48);
  for (Vec3& p : knot.positions) {
    const double angle = std::atan2(p.y, p.x);
    const double r = std::hypot(p.x, p.y) - 10.0;
    const double ring = 6.0 + 2.0 * std::cos(angle);
    p = {(ring + r) * std::cos(2.0 * angle), (ring + r) * std::sin(2.0 * angle),
         p.z + 2.0 * std::sin(angle)};
  }
  return knot;
}

TriangleMesh ball_mesh(double radius_mm, int splits, const Vec3& center_mm) {
  TriangleMesh mesh;
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int split = 0; split < splits; ++split) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, added] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
      if (added) mesh.positions.push_back(normalized(mesh.positions[a] + mesh.positions[b]));
      return found->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  for (Vec3& p : mesh.positions) p = center_mm + radius_mm * p;
  return mesh;
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh mesh = a;
  const auto base = static_cast<std::uint32_t>(a.positions.size());
  mesh.positions.insert(mesh.positions.end(), b.positions.begin(), b.positions.end());
  for (const Triangle& t : b.triangles) {
    mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
  return mesh;
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TriangleMesh without(TriangleMesh mesh, std::size_t index) {
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(index));
  return mesh;
}

TriangleMesh cut_above(const TriangleMesh& mesh, double z_mm) {
  TriangleMesh part{mesh.positions, {}, {}};
  for (const Triangle& t : mesh.triangles) {
    const double sum = mesh.positions[t[0]].z + mesh.positions[t[1]].z + mesh.positions[t[2]].z;
    if (sum >= 3.0 * z_mm) part.triangles.push_back(t);
  }
  return part;
}

}  // namespace argil::test
