// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/mesh/polygon_triangles.h"

namespace argil::test {

/// A profile in x and z, counter-clockwise seen from -y, drawn out along y about y = 0; outward.
inline TriangleMesh extruded(const std::vector<Vec3>& profile, double depth_mm) {
  TriangleMesh mesh;
  const auto n = static_cast<std::uint32_t>(profile.size());
  for (const double y : {-0.5 * depth_mm, 0.5 * depth_mm}) {
    for (const Vec3& p : profile) mesh.positions.push_back({p.x, y, p.z});
  }
  const std::vector<Triangle> caps =
      mesh::triangulated({mesh.positions.data(), mesh.positions.data() + n});
  for (const Triangle& t : caps) {
    mesh.triangles.push_back(t);
    mesh.triangles.push_back({t[0] + n, t[2] + n, t[1] + n});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.triangles.push_back({i, i + n, next});
    mesh.triangles.push_back({next, i + n, next + n});
  }
  return mesh;
}

/// A closed profile in x > 0 and z, counter-clockwise seen from -y, turned about z; outward.
inline TriangleMesh revolved(const std::vector<Vec3>& profile, int segments) {
  TriangleMesh mesh;
  const auto n = static_cast<std::uint32_t>(profile.size());
  const auto turns = static_cast<std::uint32_t>(segments);
  for (std::uint32_t s = 0; s < turns; ++s) {
    const double angle = 2.0 * std::numbers::pi * s / turns;
    for (const Vec3& p : profile) {
      mesh.positions.push_back({p.x * std::cos(angle), p.x * std::sin(angle), p.z});
    }
  }
  for (std::uint32_t s = 0; s < turns; ++s) {
    const std::uint32_t here = s * n;
    const std::uint32_t there = (s + 1) % turns * n;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t next = (i + 1) % n;
      mesh.triangles.push_back({here + i, there + i, here + next});
      mesh.triangles.push_back({here + next, there + i, there + next});
    }
  }
  return mesh;
}

/// A T of 30 x 30 mm, its bars 10 wide, 8 deep along y; it stands on its stem.
inline TriangleMesh letter_t() {
  return extruded({{-5, 0, 0},
                   {5, 0, 0},
                   {5, 0, 20},
                   {15, 0, 20},
                   {15, 0, 30},
                   {-15, 0, 30},
                   {-15, 0, 20},
                   {-5, 0, 20}},
                  8.0);
}

/// A cup of 20 mm radius and 30 height, its wall and floor 2 thick, a needle's hole (0.001 mm)
/// through the floor, too narrow for any liquid: what is turned about an axis has one.
inline TriangleMesh cup() {
  return revolved({{0.001, 0, 0}, {20, 0, 0}, {20, 0, 30}, {18, 0, 30}, {18, 0, 2}, {0.001, 0, 2}},
                  96);
}

}  // namespace argil::test
