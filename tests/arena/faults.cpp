// SPDX-License-Identifier: GPL-3.0-or-later
// The list of faults, and those that others are put together from.
#include "arena/faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "argil/mesh/bodies.h"
#include "argil/mesh/check.h"
#include "argil/mesh/triangle_geometry.h"

#include "support/loose_triangles.h"

namespace argil::arena {
namespace {

constexpr std::array kFaults{
    Fault{"holes", 4, holes},
    Fault{"missing_faces", 4, missing_faces},
    Fault{"cut_off", 4, cut_off},
    Fault{"flipped_faces", 4, flipped_faces},
    Fault{"flipped_patches", 4, flipped_patches},
    Fault{"inside_out", 4, inside_out},
    Fault{"fans", 4, fans},
    Fault{"inner_walls", 4, inner_walls},
    Fault{"common_faces", 4, common_faces},
    Fault{"touching_parts", 4, touching_parts},
    Fault{"crossing_parts", 4, crossing_parts},
    Fault{"self_crossing", 4, self_crossing},
    Fault{"folds", 4, folds},
    Fault{"noise", 4, noise},
    Fault{"jitter", 5, jitter},
    Fault{"duplicate_shells", 5, duplicate_shells},
    Fault{"duplicate_faces", 4, duplicate_faces},
    Fault{"thin_sheets", 4, thin_sheets},
    Fault{"loose_sheets", 4, loose_sheets},
    Fault{"slivers", 4, slivers},
    Fault{"t_joints", 4, t_joints},
    Fault{"cracks", 4, cracks},
    Fault{"overlapping_patches", 4, overlapping_patches},
    Fault{"nested_parts", 4, nested_parts},
    Fault{"mixed", 4, mixed},
};
static_assert(kFaults.size() == 25);

std::size_t share_of(const TriangleMesh& mesh, double share) {
  return std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(share * static_cast<double>(mesh.triangles.size()))));
}

Vec3 scattered(Random& random, double size) {
  return std::cbrt(random.between(0.0, 1.0)) * size * random.direction();
}

}  // namespace

std::span<const Fault> faults() { return kFaults; }

Broken sound(const Solid& solid) {
  Broken broken;
  broken.model = solid.name;
  broken.mesh = solid.mesh;
  broken.truth.must = solid.mesh;
  broken.truth.volume = signed_volume(solid.mesh);
  broken.truth.bodies = {mesh::mesh_bodies(solid.mesh).count};
  return broken;
}

void add_holes(Broken& broken, std::size_t count, double radius, Random& random) {
  const double reach = radius * largest_side(broken.truth.must);
  for (std::size_t hole = 0; hole < count; ++hole) {
    TriangleMesh& mesh = broken.mesh;
    const std::size_t first = pick(random, mesh.triangles.size());
    const std::vector<std::size_t> patch = patch_around(mesh, first, reach);
    if (10 * patch.size() > 3 * mesh.triangles.size()) continue;
    std::vector<bool> goes(mesh.triangles.size(), false);
    FreeBall ball{mesh::middle(mesh::corners_of(mesh, first)), 0.0};
    for (const std::size_t t : patch) {
      goes[t] = true;
      for (const std::uint32_t v : mesh.triangles[t]) {
        ball.radius = std::max(ball.radius, length(mesh.positions[v] - ball.center));
      }
    }
    TriangleMesh left = mesh;
    erase_triangles(left, goes);
    // A limb that is cut through is no longer one with the rest.
    if (mesh::check_mesh(left).components > mesh::check_mesh(mesh).components) continue;
    // One triangle alone is told by its rim.
    if (patch.size() > 1) broken.truth.free.push_back(ball);
    mesh = std::move(left);
  }
}

void drop_faces(Broken& broken, double share, Random& random) {
  TriangleMesh& mesh = broken.mesh;
  std::vector<bool> goes(mesh.triangles.size(), false);
  for (const std::size_t t : pick_some(random, goes.size(), share_of(mesh, share))) goes[t] = true;
  // Where neighbours go together, nothing says how the surface went between them.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> gone;
  const auto for_each_edge = [&](std::size_t t, const auto& use) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& c = mesh.triangles[t];
      use(gone[std::minmax(c[k], c[(k + 1) % 3])]);
    }
  };
  for (std::size_t t = 0; t < goes.size(); ++t) {
    if (goes[t]) for_each_edge(t, [](int& count) { ++count; });
  }
  for (std::size_t t = 0; t < goes.size(); ++t) {
    bool is_with_others = false;
    if (goes[t]) for_each_edge(t, [&](const int& count) { is_with_others |= count > 1; });
    if (!is_with_others) continue;
    const mesh::Corners c = mesh::corners_of(mesh, t);
    FreeBall ball{mesh::middle(c), 0.0};
    for (const Vec3& p : c) ball.radius = std::max(ball.radius, length(p - ball.center));
    broken.truth.free.push_back(ball);
  }
  erase_triangles(mesh, goes);
}

void flip_faces(Broken& broken, double share, Random& random) {
  TriangleMesh& mesh = broken.mesh;
  for (const std::size_t t : pick_some(random, mesh.triangles.size(), share_of(mesh, share))) {
    turn_over(mesh.triangles[t]);
  }
}

void add_fins(Broken& broken, std::size_t count, Random& random) {
  constexpr double kLong = 0.03;  // of the largest side
  TriangleMesh& mesh = broken.mesh;
  const double reach = kLong * largest_side(broken.truth.must);
  for (const std::size_t t : pick_some(random, mesh.triangles.size(), count)) {
    const Triangle c = mesh.triangles[t];
    const std::size_t k = pick(random, 3);
    const Vec3 middle = 0.5 * (mesh.positions[c[k]] + mesh.positions[c[(k + 1) % 3]]);
    const Vec3 normal = normalized(mesh::area_normal(mesh::corners_of(mesh, t)));
    const double side = random.between(0.0, 1.0) < 0.5 ? -1.0 : 1.0;
    mesh.positions.push_back(middle + side * reach * normal + 0.2 * reach * random.direction());
    const Triangle fin{c[k], c[(k + 1) % 3], static_cast<std::uint32_t>(mesh.positions.size() - 1)};
    mesh.triangles.push_back(fin);
    TriangleMesh alone;
    for (const std::uint32_t v : fin) alone.positions.push_back(mesh.positions[v]);
    alone.triangles = {{0, 1, 2}};
    append(broken.truth.may, alone);
  }
}

void repeat_faces(Broken& broken, double share, Random& random) {
  TriangleMesh& mesh = broken.mesh;
  std::size_t at = 0;
  for (const std::size_t t : pick_some(random, mesh.triangles.size(), share_of(mesh, share))) {
    Triangle again = mesh.triangles[t];
    mesh.triangles.push_back(again);
    if (++at % 3 != 0) continue;
    turn_over(again);
    mesh.triangles.push_back(again);
  }
}

void add_t_joints(Broken& broken, double share, double off, Random& random) {
  TriangleMesh& mesh = broken.mesh;
  const double reach = off * largest_side(broken.truth.must);
  for (const std::size_t t : pick_some(random, mesh.triangles.size(), share_of(mesh, share))) {
    const Triangle c = mesh.triangles[t];
    const std::size_t k = pick(random, 3);
    const Vec3& a = mesh.positions[c[k]];
    const Vec3& b = mesh.positions[c[(k + 1) % 3]];
    mesh.positions.push_back(a + random.between(0.3, 0.7) * (b - a) + reach * random.direction());
    const auto on = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    mesh.triangles[t] = {c[k], on, c[(k + 2) % 3]};
    mesh.triangles.push_back({on, c[(k + 1) % 3], c[(k + 2) % 3]});
  }
}

void unweld(Broken& broken, double size, Random& random) {
  const double reach = size * largest_side(broken.truth.must);
  broken.mesh = test::loose_triangles(broken.mesh);
  for (Vec3& p : broken.mesh.positions) p += scattered(random, reach);
}

}  // namespace argil::arena
