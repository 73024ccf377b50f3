// SPDX-License-Identifier: GPL-3.0-or-later
// Faults of where vertices are, and several faults at once.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "argil/mesh/triangle_geometry.h"

#include "arena/faults.h"

namespace argil::arena {
namespace {

constexpr std::size_t kFewTriangles = 100;

double grade(const std::array<double, 4>& of, int strength) {
  return of[static_cast<std::size_t>(strength - 1)];
}

/// Both triangles at an edge are cut by a point so near its end that one of each two is a needle.
void split_to_needles(TriangleMesh& mesh, std::size_t count, double off, Random& random) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::size_t, std::size_t>> left;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      left[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] = {t, k};
    }
  }
  std::vector<bool> is_done(mesh.triangles.size(), false);
  for (const std::size_t t : pick_some(random, is_done.size(), is_done.size())) {
    if (count == 0) return;
    const std::size_t k = pick(random, 3);
    const Triangle c = mesh.triangles[t];
    const std::uint32_t a = c[k];
    const std::uint32_t b = c[(k + 1) % 3];
    const auto found = left.find({b, a});
    if (is_done[t] || found == left.end() || is_done[found->second.first]) continue;
    const auto [other, at] = found->second;
    const Triangle d = mesh.triangles[other];
    is_done[t] = is_done[other] = true;
    const Vec3 along = mesh.positions[b] - mesh.positions[a];
    const double part = std::min(0.3, off * random.between(1.0, 10.0) / length(along));
    mesh.positions.push_back(mesh.positions[a] + part * along);
    const auto on = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    const std::uint32_t c3 = c[(k + 2) % 3];
    const std::uint32_t d3 = d[(at + 2) % 3];
    mesh.triangles[t] = {a, on, c3};
    mesh.triangles[other] = {b, on, d3};
    mesh.triangles.push_back({on, b, c3});
    mesh.triangles.push_back({on, a, d3});
    --count;
  }
}

/// Triangles along edges, with no area or a vertex twice.
void add_flat_triangles(TriangleMesh& mesh, std::size_t count, Random& random) {
  for (const std::size_t t : pick_some(random, mesh.triangles.size(), count)) {
    const Triangle c = mesh.triangles[t];
    if (random.between(0.0, 1.0) < 0.5) {
      mesh.triangles.push_back({c[0], c[1], c[1]});
      continue;
    }
    mesh.positions.push_back(0.5 * (mesh.positions[c[0]] + mesh.positions[c[1]]));
    mesh.triangles.push_back({c[0], c[1], static_cast<std::uint32_t>(mesh.positions.size() - 1)});
  }
}

}  // namespace

/// Single vertices pushed along the surface beyond their neighbours.
std::optional<Broken> folds(const Solid& solid, int strength, Random& random) {
  if (solid.mesh.triangles.size() < kFewTriangles) return std::nullopt;
  Broken broken = sound(solid);
  TriangleMesh& mesh = broken.mesh;
  const std::vector<Vec3> normals = vertex_normals(mesh);
  const std::vector<double> edges = edge_lengths(mesh);
  const double size = largest_side(mesh);
  const double share = grade({0.001, 0.003, 0.01, 0.03}, strength);
  const auto count = std::max<std::size_t>(
      1, static_cast<std::size_t>(share * static_cast<double>(mesh.positions.size())));
  std::size_t moved = 0;
  for (const std::size_t v : pick_some(random, mesh.positions.size(), mesh.positions.size())) {
    if (moved == count) break;
    if (edges[v] > 0.05 * size) continue;
    const Vec3 along = normalized(cross(normals[v], random.direction()));
    const double far = random.between(1.2, 2.2) * edges[v];
    broken.truth.free.push_back({mesh.positions[v], 1.5 * far});
    mesh.positions[v] += far * along;
    ++moved;
  }
  if (moved == 0) return std::nullopt;
  return broken;
}

std::optional<Broken> noise(const Solid& solid, int strength, Random& random) {
  Broken broken = sound(solid);
  const double reach = grade({1e-4, 1e-3, 2e-3, 4e-3}, strength) * largest_side(solid.mesh);
  for (Vec3& p : broken.mesh.positions) {
    p += std::cbrt(random.between(0.0, 1.0)) * reach * random.direction();
  }
  return broken;
}

std::optional<Broken> jitter(const Solid& solid, int strength, Random& random) {
  Broken broken = sound(solid);
  const double size = std::pow(10.0, strength - 7);
  unweld(broken, size, random);
  broken.truth.tolerance = std::max(broken.truth.tolerance, 1.5 * size);
  return broken;
}

std::optional<Broken> slivers(const Solid& solid, int strength, Random& random) {
  Broken broken = sound(solid);
  const double share = grade({0.01, 0.05, 0.2, 0.5}, strength);
  const auto count = std::max<std::size_t>(
      1, static_cast<std::size_t>(share * static_cast<double>(solid.mesh.triangles.size())));
  const double off = grade({1e-4, 1e-5, 1e-6, 1e-6}, strength) * largest_side(solid.mesh);
  split_to_needles(broken.mesh, count, off, random);
  add_flat_triangles(broken.mesh, count, random);
  return broken;
}

std::optional<Broken> t_joints(const Solid& solid, int strength, Random& random) {
  Broken broken = sound(solid);
  add_t_joints(broken, grade({0.01, 0.1, 0.3, 0.3}, strength),
               grade({0.0, 0.0, 0.0, 1e-5}, strength), random);
  return broken;
}

/// Two to five faults one after another, in an order that leaves each what it needs.
std::optional<Broken> mixed(const Solid& solid, int strength, Random& random) {
  if (solid.mesh.triangles.size() < kFewTriangles) return std::nullopt;
  Broken broken = sound(solid);
  std::vector<std::size_t> chosen = pick_some(random, 7, static_cast<std::size_t>(strength + 1));
  std::sort(chosen.begin(), chosen.end());
  for (const std::size_t fault : chosen) {
    switch (fault) {
      case 0:
        add_holes(broken, 2, 0.03, random);
        break;
      case 1:
        add_t_joints(broken, 0.01, 0.0, random);
        break;
      case 2:
        drop_faces(broken, 0.005, random);
        break;
      case 3:
        add_fins(broken, 4, random);
        break;
      case 4:
        flip_faces(broken, 0.05, random);
        break;
      case 5:
        repeat_faces(broken, 0.03, random);
        break;
      default:
        unweld(broken, 1e-6, random);
        break;
    }
  }
  return broken;
}

}  // namespace argil::arena
