// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "argil/io/assembly.h"
#include "argil/mesh/rounding.h"

#include "support/shapes.h"

namespace argil::test {

/// Three parts with names and colors: a foot, and an item of a head and a shade, the shade turned
/// by a quarter about z and the whole item lifted off the bed. All coordinates are multiples of a
/// 64th, which every program's decimals hold.
inline io::Assembly lamp() {
  TriangleMesh head = torus_mesh(10.0, 3.0, 24, 12);
  for (Vec3& p : head.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = std::round(64.0 * p[axis]) / 64.0 + 0.0;
  }
  io::Assembly lamp;
  lamp.objects = {{"Foot & \"base\"", io::Srgb{200, 30, 0}, box_mesh({30, 20, 5})},
                  {"Head", io::Srgb{0, 160, 255}, std::move(head)},
                  {"Sch\xC3\xBCrze <1>", io::Srgb{255, 255, 254}, box_mesh({4, 8, 12})}};
  const io::Affine lifted{{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, 10.5}}};
  const io::Affine turned{{Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}, Vec3{40, 2, 13.25}}};
  lamp.items = {{"", {{0, {}}}}, {"Top", {{1, lifted}, {2, turned}}}};
  return lamp;
}

/// The corners of every triangle, as floats, in an order that no file changes.
inline std::vector<std::array<double, 9>> corners_sorted(const TriangleMesh& given) {
  const TriangleMesh mesh = mesh::rounded_to_float(given);
  std::vector<std::array<double, 9>> all;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t corner) { return mesh.positions[t[corner]] + Vec3{}; };
    const Vec3 a = at(0);
    const Vec3 b = at(1);
    const Vec3 c = at(2);
    all.push_back({a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z});
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace argil::test
