// SPDX-License-Identifier: GPL-3.0-or-later
// Faults between solids: with walls in them, in touch, through one another, one in another.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "argil/mesh/bodies.h"
#include "argil/mesh/check.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/rounding.h"
#include "argil/mesh/triangle_geometry.h"

#include "arena/faults.h"
#include "rivals/cgal_solids.h"
#include "support/shapes.h"

namespace argil::arena {
namespace {

/// A solid in slabs, each closed by the caps that it shares with its neighbours.
struct Slabs {
  std::vector<TriangleMesh> closed;
  TriangleMesh surface;  ///< of the whole, cut where the caps are
  TriangleMesh caps;
};

std::optional<Slabs> slabs_of(const TriangleMesh& mesh, int cuts, Random& random) {
  const Vec3 normal = random.direction();
  const Vec3 center = bounds(mesh).center();
  double low = 1e300;
  double high = -1e300;
  for (const Vec3& p : mesh.positions) {
    low = std::min(low, dot(p - center, normal));
    high = std::max(high, dot(p - center, normal));
  }
  Slabs slabs;
  TriangleMesh rest = mesh;
  TriangleMesh last_cap;
  for (int i = 1; i <= cuts; ++i) {
    const double at = low + (i + random.between(-0.2, 0.2)) / (cuts + 1) * (high - low);
    const TriangleMesh solid = [&] {
      TriangleMesh closed = rest;
      append(closed, last_cap);
      return mesh::welded(closed);
    }();
    const auto cut = cut_by_plane(solid, center + at * normal, normal);
    if (!cut) return std::nullopt;
    TriangleMesh closed = cut->below;
    append(closed, cut->cap);
    slabs.closed.push_back(mesh::welded(closed));
    append(slabs.caps, cut->cap);
    rest = cut->above;
    last_cap = cut->cap;
    turn_over(last_cap);
  }
  append(rest, last_cap);
  slabs.closed.push_back(mesh::welded(rest));
  for (const TriangleMesh& slab : slabs.closed) {
    if (!mesh::check_mesh(slab).printable) return std::nullopt;
  }
  return slabs;
}

std::optional<Slabs> sound_slabs(const TriangleMesh& mesh, int cuts, Random& random) {
  for (int attempt = 0; attempt < 8; ++attempt) {
    if (auto slabs = slabs_of(mesh, cuts, random)) return slabs;
  }
  return std::nullopt;
}

/// What points are seen as from the other end of a line through `a` and `b`; a point where both are
/// one.
Vec3 opposite(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = normalized(b - a);
  const Vec3 foot = a + dot(p - a, along) * along;
  return 2.0 * foot - p;
}

/// The mesh again on the other side of vertices a and b, which both share.
TriangleMesh with_opposite(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  TriangleMesh other = mesh;
  for (Vec3& p : other.positions) p = opposite(p, mesh.positions[a], mesh.positions[b]);
  if (a == b) turn_over(other);
  other = mesh::rounded_to_float(std::move(other));
  other.positions[a] = mesh.positions[a];
  other.positions[b] = mesh.positions[b];
  TriangleMesh both = mesh;
  append(both, other);
  return both;
}

std::uint32_t farthest_along(const TriangleMesh& mesh, const Vec3& direction) {
  std::uint32_t best = 0;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    if (dot(mesh.positions[v] - mesh.positions[best], direction) > 0.0) best = v;
  }
  return best;
}

/// An edge of the convex hull: everything else is clearly below a plane through it.
std::optional<std::pair<std::uint32_t, std::uint32_t>> hull_edge(const TriangleMesh& mesh,
                                                                 Random& random) {
  const double least = 1e-4 * largest_side(mesh);
  const std::vector<Vec3> normals = vertex_normals(mesh);
  for (const std::size_t t : pick_some(random, mesh.triangles.size(), mesh.triangles.size())) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k];
      const std::uint32_t b = mesh.triangles[t][(k + 1) % 3];
      const Vec3 edge = normalized(mesh.positions[b] - mesh.positions[a]);
      Vec3 up = normals[a] + normals[b];
      up = normalized(up - dot(up, edge) * edge);
      bool is_highest = true;
      for (std::uint32_t v = 0; v < mesh.positions.size() && is_highest; ++v) {
        if (v == a || v == b) continue;
        is_highest = dot(mesh.positions[v] - mesh.positions[a], up) < -least;
      }
      if (is_highest) return std::pair{a, b};
    }
  }
  return std::nullopt;
}

/// The solid, cut off flat, on a plate that is wider and has none of its vertices.
std::optional<Broken> on_a_plate(const Solid& solid, Random& random) {
  const Box3 box = bounds(solid.mesh);
  const double size = largest_side(solid.mesh);
  for (int attempt = 0; attempt < 8; ++attempt) {
    const auto z = static_cast<double>(
        static_cast<float>(box.min.z + random.between(0.2, 0.4) * (box.max.z - box.min.z)));
    const auto cut = cut_by_plane(solid.mesh, {0, 0, z}, {0, 0, 1});
    if (!cut) continue;
    TriangleMesh cap = cut->cap;
    turn_over(cap);
    TriangleMesh upper = cut->above;
    append(upper, cap);
    upper = mesh::welded(upper);
    for (Vec3& p : upper.positions) p.z = std::max(p.z, z);
    const mesh::MeshVerdict verdict = mesh::check_mesh(upper);
    if (!verdict.printable || verdict.components != 1) continue;
    const double thick = 0.1 * size;
    TriangleMesh plate = mesh::rounded_to_float(
        test::box_mesh({1.3 * (box.max.x - box.min.x), 1.3 * (box.max.y - box.min.y), thick},
                       {box.center().x, box.center().y, z - 0.5 * thick}));
    for (std::size_t v = 4; v < 8; ++v) plate.positions[v].z = z;
    Broken broken = sound(solid);
    broken.mesh = upper;
    append(broken.mesh, plate);
    broken.truth.volume = verdict.volume_mm3 + signed_volume(plate);
    broken.truth.must = cut->above;
    append(broken.truth.must, mesh::only_triangles(plate, [](std::size_t t) {
             return t != 2 && t != 3;  // its top
           }));
    append(broken.truth.may, cap);
    append(broken.truth.may,
           mesh::only_triangles(plate, [](std::size_t t) { return t == 2 || t == 3; }));
    broken.truth.bodies = {1, 2};
    return broken;
  }
  return std::nullopt;
}

/// What CGAL unites all of them to; none where it cannot.
std::optional<TriangleMesh> united(const std::vector<TriangleMesh>& parts) {
  std::optional<TriangleMesh> all = parts.front();
  for (std::size_t i = 1; i < parts.size() && all; ++i) {
    all = evaluation::cgal_united(*all, parts[i]);
  }
  return all;
}

bool set_united(Truth& truth, const std::vector<TriangleMesh>& parts) {
  auto all = united(parts);
  if (!all) return false;
  truth.must = std::move(*all);
  truth.may = {};
  truth.volume = signed_volume(truth.must);
  truth.bodies = {mesh::mesh_bodies(truth.must).count};
  return true;
}

/// Curves in a plane that cross themselves. Of `passes` equal pieces each goes through a crossing
/// once, in its middle or near it.
struct NamedCurve {
  const char* name;
  int passes;
  Vec3 (*at)(double turn);
};
constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr std::array kCurves{
    NamedCurve{"eight", 2,
               [](double t) {
                 return Vec3{40 * std::cos(kTurn * t), -20 * std::sin(2 * kTurn * t), 0};
               }},
    NamedCurve{"clover", 6,
               [](double t) {
                 const double r = 25 + 14 * std::cos(3 * kTurn * t);
                 return Vec3{r * std::cos(2 * kTurn * t), r * std::sin(2 * kTurn * t), 0};
               }},
    NamedCurve{"limacon", 2,
               [](double t) {
                 const double r = 15 + 35 * std::cos(kTurn * t);
                 return Vec3{r * std::cos(kTurn * t), r * std::sin(kTurn * t), 0};
               }},
    NamedCurve{"star", 10, [](double t) {
                 const double r = 35 + 12 * std::cos(5 * kTurn * t);
                 return Vec3{r * std::cos(2 * kTurn * t), r * std::sin(2 * kTurn * t), 0};
               }}};

}  // namespace

std::optional<Broken> inner_walls(const Solid& solid, int strength, Random& random) {
  const auto slabs = sound_slabs(solid.mesh, strength, random);
  if (!slabs) return std::nullopt;
  Broken broken = sound(solid);
  broken.mesh = {};
  for (const TriangleMesh& slab : slabs->closed) append(broken.mesh, slab);
  broken.mesh = mesh::welded(broken.mesh);
  // Each cap is there twice, once for each slab: one of them is the wall.
  std::vector<bool> goes(broken.mesh.triangles.size(), false);
  std::vector<std::array<std::uint32_t, 4>> seen;  // corners in order, then the number
  for (std::uint32_t t = 0; t < goes.size(); ++t) {
    Triangle c = broken.mesh.triangles[t];
    std::sort(c.begin(), c.end());
    seen.push_back({c[0], c[1], c[2], t});
  }
  std::sort(seen.begin(), seen.end());
  for (std::size_t i = 1; i < seen.size(); ++i) {
    if (std::equal(seen[i].begin(), seen[i].begin() + 3, seen[i - 1].begin())) {
      goes[seen[i][3]] = true;
    }
  }
  erase_triangles(broken.mesh, goes);
  return broken;
}

std::optional<Broken> common_faces(const Solid& solid, int strength, Random& random) {
  const auto slabs = sound_slabs(solid.mesh, strength, random);
  if (!slabs) return std::nullopt;
  Broken broken = sound(solid);
  broken.mesh = {};
  for (const TriangleMesh& slab : slabs->closed) append(broken.mesh, slab);
  return broken;
}

/// At a vertex, along an edge, on the face of a plate, three at vertices.
std::optional<Broken> touching_parts(const Solid& solid, int strength, Random& random) {
  if (strength == 3) return on_a_plate(solid, random);
  Broken broken = sound(solid);
  if (strength == 2) {
    const auto edge = hull_edge(solid.mesh, random);
    if (!edge) return std::nullopt;
    broken.mesh = with_opposite(solid.mesh, edge->first, edge->second);
  } else {
    const Vec3 direction = random.direction();
    const std::uint32_t top = farthest_along(solid.mesh, direction);
    broken.mesh = with_opposite(solid.mesh, top, top);
    if (strength == 4) {
      const std::uint32_t bottom = farthest_along(solid.mesh, -direction);
      TriangleMesh three = with_opposite(solid.mesh, bottom, bottom);
      const auto own = static_cast<std::ptrdiff_t>(solid.mesh.triangles.size());
      three.triangles.erase(three.triangles.begin(), three.triangles.begin() + own);
      append(broken.mesh, mesh::compacted(three));
    }
  }
  broken.truth.must = broken.mesh;
  broken.truth.volume = (strength == 4 ? 3.0 : 2.0) * signed_volume(solid.mesh);
  broken.truth.bodies = {static_cast<std::uint32_t>(strength == 4 ? 3 : 2)};
  broken.mesh = mesh::welded(broken.mesh);
  return broken;
}

/// Two to five parts that overlap: the solid, balls, boxes, and itself turned.
std::optional<Broken> crossing_parts(const Solid& solid, int strength, Random& random) {
  Broken broken = sound(solid);
  const double size = largest_side(solid.mesh);
  std::vector<TriangleMesh> parts{solid.mesh};
  for (int i = 0; i < strength; ++i) {
    const TriangleMesh other =
        i % 3 == 0 ? solid.mesh
                   : (i % 3 == 1 ? test::ball_mesh(0.3 * size, 3, bounds(solid.mesh).center())
                                 : test::box_mesh({0.6 * size, 0.4 * size, 0.3 * size},
                                                  bounds(solid.mesh).center()));
    const std::size_t at = pick(random, solid.mesh.positions.size());
    const Vec3 move = 0.7 * (solid.mesh.positions[at] - bounds(solid.mesh).center());
    parts.push_back(placed(other, random.orientation(), 1.0, move));
  }
  if (!set_united(broken.truth, parts)) return std::nullopt;
  broken.mesh = {};
  for (const TriangleMesh& part : parts) append(broken.mesh, part);
  return broken;
}

/// A tube that goes through itself: right through, and higher and higher, where it passes again.
/// The solid only chooses curve and radius.
std::optional<Broken> self_crossing(const Solid& solid, int strength, Random& random) {
  constexpr int kRings = 240;
  std::size_t variant = 0;
  for (const char c : solid.name) variant += static_cast<std::size_t>(c);
  const NamedCurve& curve = kCurves[variant % kCurves.size()];
  const double radius = random.between(3.0, 5.0);
  const double lift = 0.6 * (strength - 1) * radius;
  const Curve lifted = [&](double turns) {
    // The same bits at the end of a turn as at its beginning.
    const double t = std::round(1e9 * (turns - std::floor(turns))) / 1e9;
    // Both passes of a crossing are at crests of this, one up and one down.
    return curve.at(t) + Vec3{0, 0, 0.5 * lift * std::sin(0.5 * curve.passes * kTurn * t)};
  };
  Broken broken;
  broken.model = std::string(curve.name) + "-" + solid.name;
  broken.mesh = mesh::rounded_to_float(tube_along(lifted, radius, kRings, 24));
  std::vector<TriangleMesh> pieces;
  for (int i = 0; i < curve.passes; ++i) {
    const int first = kRings * i / curve.passes;
    const int last = kRings * (i + 1) / curve.passes;
    pieces.push_back(mesh::rounded_to_float(tube_piece(lifted, radius, kRings, 24, first, last)));
    if (!mesh::check_mesh(pieces.back()).printable) return std::nullopt;
  }
  if (!set_united(broken.truth, pieces)) return std::nullopt;
  return broken;
}

/// A ball inside that adds nothing, three of them; hollow with triangles missing, and as loose
/// triangles with a hole within.
std::optional<Broken> nested_parts(const Solid& solid, int strength, Random& random) {
  Broken broken = sound(solid);
  const InnerBall inside = inner_ball(solid.mesh, random);
  if (inside.radius < 0.05 * largest_side(solid.mesh)) return std::nullopt;
  if (strength <= 2) {
    for (int i = 0; i < 2 * strength - 1; ++i) {
      const TriangleMesh ball = mesh::rounded_to_float(
          test::ball_mesh((0.8 - 0.2 * i) * inside.radius, 3, inside.center));
      append(broken.mesh, ball);
      append(broken.truth.may, ball);
    }
    return broken;
  }
  TriangleMesh cavity =
      mesh::rounded_to_float(test::ball_mesh(0.8 * inside.radius, 3, inside.center));
  turn_over(cavity);
  append(broken.mesh, cavity);
  append(broken.truth.must, cavity);
  broken.truth.volume += signed_volume(cavity);
  drop_faces(broken, 0.01, random);
  if (strength == 4) unweld(broken, 0.0, random);
  return broken;
}

}  // namespace argil::arena
