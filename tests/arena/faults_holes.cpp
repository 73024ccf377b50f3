// SPDX-License-Identifier: GPL-3.0-or-later
// Faults by which surface is missing, or does not meet.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "argil/mesh/check.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/triangle_geometry.h"

#include "arena/faults.h"

namespace argil::arena {
namespace {

/// A mesh of so few triangles has nothing left when many of them go.
constexpr std::size_t kFewTriangles = 100;
constexpr std::size_t kManyTriangles = 1000;

double grade(const std::array<double, 4>& of, int strength) {
  return of[static_cast<std::size_t>(strength - 1)];
}

/// The triangles with their middle above a plane through the middle, in a random direction.
std::vector<bool> one_half(const TriangleMesh& mesh, Random& random) {
  const Vec3 normal = random.direction();
  const Vec3 center = bounds(mesh).center();
  std::vector<bool> is_above;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    is_above.push_back(dot(mesh::middle(mesh::corners_of(mesh, t)) - center, normal) > 0.0);
  }
  return is_above;
}

bool is_mixed(const std::vector<bool>& set) {
  return std::count(set.begin(), set.end(), true) > 0 &&
         std::count(set.begin(), set.end(), false) > 0;
}

}  // namespace

std::optional<Broken> holes(const Solid& solid, int strength, Random& random) {
  static constexpr std::array<std::size_t, 4> kCounts{1, 3, 5, 8};
  if (strength > 1 && solid.mesh.triangles.size() < kFewTriangles) return std::nullopt;
  Broken broken = sound(solid);
  add_holes(broken, kCounts[static_cast<std::size_t>(strength - 1)],
            grade({0.02, 0.04, 0.06, 0.08}, strength), random);
  if (broken.mesh.triangles.size() == solid.mesh.triangles.size()) return std::nullopt;
  return broken;
}

std::optional<Broken> missing_faces(const Solid& solid, int strength, Random& random) {
  if (strength > 1 && solid.mesh.triangles.size() < kManyTriangles) return std::nullopt;
  Broken broken = sound(solid);
  drop_faces(broken, grade({0.01, 0.05, 0.15, 0.3}, strength), random);
  return broken;
}

/// Open where it stood on a table: what is right is a flat bottom, or what was there before.
std::optional<Broken> cut_off(const Solid& solid, int strength, Random& random) {
  const Box3 box = bounds(solid.mesh);
  const double height = grade({0.1, 0.2, 0.35, 0.5}, strength);
  for (int attempt = 0; attempt < 8; ++attempt) {
    const Vec3 at =
        box.center() + (height - 0.5 + random.between(-0.03, 0.03)) * Vec3{0, 0, box.size().z};
    const auto cut = cut_by_plane(solid.mesh, at, {0, 0, 1});
    if (!cut) continue;
    Broken broken = sound(solid);
    broken.also = {broken.truth};
    broken.mesh = cut->above;
    TriangleMesh truth = cut->above;
    TriangleMesh cap = cut->cap;
    turn_over(cap);
    append(truth, cap);
    truth = mesh::welded(truth);
    const mesh::MeshVerdict verdict = mesh::check_mesh(truth);
    if (!verdict.printable) continue;
    broken.truth.must = truth;
    broken.truth.volume = verdict.volume_mm3;
    broken.truth.bodies = {static_cast<std::uint32_t>(verdict.components)};
    return broken;
  }
  return std::nullopt;
}

/// Two halves that do not meet.
std::optional<Broken> cracks(const Solid& solid, int strength, Random& random) {
  Broken broken = sound(solid);
  const std::vector<bool> is_above = one_half(solid.mesh, random);
  if (!is_mixed(is_above)) return std::nullopt;
  const auto in_half = [&](bool above) {
    return mesh::only_triangles(solid.mesh, [&](std::size_t t) { return is_above[t] == above; });
  };
  const double gap = grade({1e-6, 1e-4, 1e-3, 4e-3}, strength) * largest_side(solid.mesh);
  TriangleMesh half = in_half(true);
  const Vec3 move = gap * random.direction();
  for (Vec3& p : half.positions) p += move;
  broken.mesh = in_half(false);
  append(broken.mesh, half);
  // What lies between the halves, if they part along all of a flat piece.
  broken.truth.volume_tolerance = std::max(
      broken.truth.volume_tolerance, 0.25 * surface_area(solid.mesh) * gap / broken.truth.volume);
  return broken;
}

/// Two halves that reach over each other, as patches of a scan do.
std::optional<Broken> overlapping_patches(const Solid& solid, int strength, Random& random) {
  const TriangleMesh& mesh = solid.mesh;
  if (mesh.triangles.size() < kFewTriangles) return std::nullopt;
  Broken broken = sound(solid);
  const std::vector<bool> is_above = one_half(mesh, random);
  std::vector<bool> reached = is_above;
  for (int ring = 0; ring < strength; ++ring) {
    std::vector<bool> at(mesh.positions.size(), false);
    for (std::size_t t = 0; t < reached.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) {
        if (reached[t]) at[v] = true;
      }
    }
    for (std::size_t t = 0; t < reached.size(); ++t) {
      const Triangle& c = mesh.triangles[t];
      reached[t] = at[c[0]] || at[c[1]] || at[c[2]];
    }
  }
  if (!is_mixed(is_above) || !is_mixed(reached)) return std::nullopt;
  // One half a little out and the other in, so that the volume stays.
  TriangleMesh over{mesh.positions, {}, mesh.triangles};
  TriangleMesh under = over;
  const double off = 0.5 * grade({0.0, 1e-4, 5e-4, 2e-3}, strength) * largest_side(mesh);
  const std::vector<Vec3> normals = vertex_normals(mesh);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    over.positions[v] += off * normals[v];
    under.positions[v] -= off * normals[v];
  }
  broken.mesh = mesh::only_triangles(under, [&](std::size_t t) { return !is_above[t]; });
  append(broken.mesh, mesh::only_triangles(over, [&](std::size_t t) { return !!reached[t]; }));
  return broken;
}

/// Walls so thin that a level set has no voxel for them, with triangles missing.
std::optional<Broken> thin_sheets(const Solid& solid, int strength, Random& random) {
  int variant = 0;
  for (const char c : solid.name) variant += c;
  Broken broken = sound(thin_solid(variant, grade({1.0, 0.3, 0.1, 0.03}, strength)));
  if (!mesh::check_mesh(broken.mesh).printable) return std::nullopt;
  drop_faces(broken, 0.01, random);
  return broken;
}

}  // namespace argil::arena
