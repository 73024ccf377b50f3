// SPDX-License-Identifier: GPL-3.0-or-later
// Faults by which triangles face the wrong way, are there twice, or should not be there.
#include <array>
#include <cmath>
#include <utility>

#include "argil/mesh/rounding.h"
#include "argil/mesh/triangle_geometry.h"

#include "arena/faults.h"

namespace argil::arena {
namespace {

double grade(const std::array<double, 4>& of, int strength) {
  return of[static_cast<std::size_t>(strength - 1)];
}

std::size_t count_of(const std::array<std::size_t, 4>& of, int strength) {
  return of[static_cast<std::size_t>(strength - 1)];
}

/// A curved piece of n x n quads that is open.
TriangleMesh open_sheet(const Vec3& center, double side, Random& random) {
  constexpr std::uint32_t kSteps = 6;
  const Quat turn = random.orientation();
  TriangleMesh sheet;
  for (std::uint32_t j = 0; j <= kSteps; ++j) {
    for (std::uint32_t i = 0; i <= kSteps; ++i) {
      const double x = 1.0 * i / kSteps - 0.5;
      const double y = 1.0 * j / kSteps - 0.5;
      sheet.positions.push_back(center + side * rotate(turn, {x, y, 0.4 * x * x}));
    }
  }
  for (std::uint32_t j = 0; j < kSteps; ++j) {
    for (std::uint32_t i = 0; i < kSteps; ++i) {
      const std::uint32_t a = j * (kSteps + 1) + i;
      sheet.triangles.push_back({a, a + 1, a + kSteps + 2});
      sheet.triangles.push_back({a, a + kSteps + 2, a + kSteps + 1});
    }
  }
  return mesh::rounded_to_float(std::move(sheet));
}

}  // namespace

std::optional<Broken> flipped_faces(const Solid& solid, int strength, Random& random) {
  Broken broken = sound(solid);
  flip_faces(broken, grade({0.01, 0.1, 0.3, 0.5}, strength), random);
  return broken;
}

std::optional<Broken> flipped_patches(const Solid& solid, int strength, Random& random) {
  Broken broken = sound(solid);
  TriangleMesh& mesh = broken.mesh;
  const double reach = 0.12 * largest_side(mesh);
  for (std::size_t i = 0; i < count_of({1, 3, 6, 12}, strength); ++i) {
    const std::size_t first = pick(random, mesh.triangles.size());
    for (const std::size_t t : patch_around(mesh, first, reach)) turn_over(mesh.triangles[t]);
  }
  return broken;
}

/// Whole parts that face inward: all there is, one of two, all as loose triangles, two of three.
std::optional<Broken> inside_out(const Solid& solid, int strength, Random& random) {
  Broken broken = sound(solid);
  const double size = largest_side(solid.mesh);
  TriangleMesh beside = placed(solid.mesh, random.orientation(), 0.6, {2.0 * size, 0, 0});
  TriangleMesh behind = placed(solid.mesh, random.orientation(), 0.4, {0, 2.0 * size, 0});
  if (strength == 2 || strength == 4) {
    append(broken.truth.must, beside);
    if (strength == 4) append(broken.truth.must, behind);
    broken.truth.volume = signed_volume(broken.truth.must);
    broken.truth.bodies = {static_cast<std::uint32_t>(strength == 2 ? 2 : 3)};
    turn_over(beside);
    append(broken.mesh, beside);
    turn_over(behind);
    if (strength == 4) append(broken.mesh, behind);
    return broken;
  }
  turn_over(broken.mesh);
  if (strength == 3) unweld(broken, 0.0, random);
  return broken;
}

std::optional<Broken> fans(const Solid& solid, int strength, Random& random) {
  Broken broken = sound(solid);
  add_fins(broken, count_of({1, 5, 20, 60}, strength), random);
  return broken;
}

/// The whole once more: with the same vertices, with its own, inside out, a little larger, all its
/// vertices a little off.
std::optional<Broken> duplicate_shells(const Solid& solid, int strength, Random& random) {
  Broken broken = sound(solid);
  TriangleMesh again = solid.mesh;
  const double size = largest_side(solid.mesh);
  if (strength == 1) {
    broken.mesh.triangles.insert(broken.mesh.triangles.end(), again.triangles.begin(),
                                 again.triangles.end());
    return broken;
  }
  if (strength == 3) turn_over(again);
  if (strength == 4) {
    const std::vector<Vec3> normals = vertex_normals(again);
    for (std::size_t v = 0; v < normals.size(); ++v) again.positions[v] += 1e-4 * size * normals[v];
  }
  if (strength == 5) {
    for (Vec3& p : again.positions) p += 1e-5 * size * random.direction();
  }
  append(broken.mesh, again);
  return broken;
}

std::optional<Broken> duplicate_faces(const Solid& solid, int strength, Random& random) {
  Broken broken = sound(solid);
  repeat_faces(broken, grade({0.01, 0.1, 0.5, 1.0}, strength), random);
  return broken;
}

/// Open sheets that enclose nothing: one beside, some beside, dust of single triangles, one right
/// through it.
std::optional<Broken> loose_sheets(const Solid& solid, int strength, Random& random) {
  Broken broken = sound(solid);
  const double size = largest_side(solid.mesh);
  const Vec3 center = bounds(solid.mesh).center();
  const auto add = [&](const TriangleMesh& sheet) {
    append(broken.mesh, sheet);
    append(broken.truth.may, sheet);
  };
  if (strength == 4) {
    add(open_sheet(center, 1.3 * size, random));
    return broken;
  }
  for (std::size_t i = 0; i < count_of({1, 4, 60, 1}, strength); ++i) {
    const Vec3 at = center + 1.1 * size * random.direction();
    if (strength < 3) {
      add(open_sheet(at, 0.25 * size, random));
      continue;
    }
    TriangleMesh speck;
    for (int k = 0; k < 3; ++k) speck.positions.push_back(at + 0.01 * size * random.direction());
    speck.triangles = {{0, 1, 2}};
    add(speck);
  }
  return broken;
}

}  // namespace argil::arena
