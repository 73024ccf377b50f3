// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangles of a mesh belong to one body, also while it is broken.
#include "argil/io/body_parts.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "argil/core/winding_number.h"
#include "argil/mesh/bodies.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"

namespace argil::io {
namespace {

/// Components of a mesh by the edges its triangles share. Where more than two meet at an edge, as
/// where solids touch in welded vertices, those are neighbours that have a solid between them.
class Components {
 public:
  Components(const TriangleMesh& mesh, const mesh::EdgeTable& edges)
      : mesh_(mesh), edges_(edges), sets_(mesh.triangles.size()) {}

  mesh::MeshParts run();

 private:
  struct Around {
    std::int64_t angle = 0;   ///< about the edge, in 1e-7 radians, so that rounding does not tell
    bool ends_solid = false;  ///< that lies before it; else one begins behind it
    std::uint32_t triangle = 0;
  };

  void join_all(std::span<const mesh::HalfEdge> uses);
  void join_around(std::span<const mesh::HalfEdge> uses);
  std::vector<Around> sorted_around(std::span<const mesh::HalfEdge> uses) const;

  const TriangleMesh& mesh_;
  const mesh::EdgeTable& edges_;
  mesh::DisjointSets sets_;  ///< of triangles
};

void Components::join_all(std::span<const mesh::HalfEdge> uses) {
  for (const mesh::HalfEdge h : uses) sets_.unite(uses[0] / 3, h / 3);
}

std::vector<Components::Around> Components::sorted_around(
    std::span<const mesh::HalfEdge> uses) const {
  constexpr double kPerRadian = 1e7;
  const auto third_from = [&](mesh::HalfEdge h) {
    return mesh_.positions[mesh_.triangles[h / 3][(h % 3 + 2) % 3]] -
           mesh_.positions[edges_.from(uses[0])];
  };
  const Vec3 along = mesh_.positions[edges_.to(uses[0])] - mesh_.positions[edges_.from(uses[0])];
  const Vec3 up = cross(along, third_from(uses[0]));
  const Vec3 ahead = cross(up, along);
  const double per_up = length(up) > 0.0 ? length(ahead) / length(up) : 0.0;
  const std::int64_t turn = std::llround(2.0 * polar_angle(-1.0, 0.0) * kPerRadian);
  std::vector<Around> around;
  for (const mesh::HalfEdge h : uses) {
    const Vec3 third = third_from(h);
    const double angle = polar_angle(dot(third, ahead), per_up * dot(third, up));
    const std::int64_t steps = (std::llround(angle * kPerRadian) + turn) % turn;
    // Run along as the first is, it faces the way of greater angles.
    around.push_back({steps, edges_.from(h) == edges_.from(uses[0]), h / 3});
  }
  std::sort(around.begin(), around.end(), [](const Around& a, const Around& b) {
    return std::tuple(a.angle, !a.ends_solid, a.triangle) <
           std::tuple(b.angle, !b.ends_solid, b.triangle);
  });
  return around;
}

/// A triangle whose solid lies behind it in the order around the edge belongs with the next, where
/// that solid ends.
void Components::join_around(std::span<const mesh::HalfEdge> uses) {
  const std::vector<Around> around = sorted_around(uses);
  const auto next = [&](std::size_t n) -> const Around& { return around[(n + 1) % around.size()]; };
  for (std::size_t n = 0; n < around.size(); ++n) {
    // Two in a row that begin or end: they face as they should not, and nothing tells them apart.
    if (around[n].ends_solid == next(n).ends_solid) return join_all(uses);
  }
  for (std::size_t n = 0; n < around.size(); ++n) {
    if (!around[n].ends_solid) sets_.unite(around[n].triangle, next(n).triangle);
  }
}

mesh::MeshParts Components::run() {
  for (std::size_t edge = 0; edge < edges_.size(); ++edge) {
    const auto uses = edges_.uses(edge);
    uses.size() > 2 ? join_around(uses) : join_all(uses);
  }
  mesh::MeshParts parts;
  std::vector<std::uint32_t> number(mesh_.triangles.size(), mesh::kNoPart);
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    if (!edges_.takes_part(t)) {
      parts.of_triangle.push_back(mesh::kNoPart);
      continue;
    }
    std::uint32_t& own = number[sets_.find(t)];
    if (own == mesh::kNoPart) own = parts.count++;
    parts.of_triangle.push_back(own);
  }
  return parts;
}

class BodySearch {
 public:
  explicit BodySearch(const TriangleMesh& mesh)
      : mesh_(mesh),
        edges_(mesh_),
        parts_(Components(mesh_, edges_).run()),
        is_open_(parts_.count),
        bodies_(parts_.count) {}

  /// The body of each triangle, from 0 without gaps.
  std::vector<std::uint32_t> run();

 private:
  using Cell = std::array<std::int64_t, 3>;

  void find_open();
  void join_near_rims();
  void join_cavities();
  std::vector<std::uint32_t> in_order_of_parts() const;
  std::vector<std::uint32_t> numbered();

  const TriangleMesh& mesh_;
  const mesh::EdgeTable edges_;
  const mesh::MeshParts parts_;
  std::vector<bool> is_open_;  ///< of each component
  mesh::DisjointSets bodies_;  ///< of components
};

void BodySearch::find_open() {
  for (std::size_t edge = 0; edge < edges_.size(); ++edge) {
    const auto uses = edges_.uses(edge);
    if (uses.size() == 1) is_open_[parts_.of_triangle[uses[0] / 3]] = true;
  }
}

/// Each rim is compared with those in its cell and the cells around, which are as wide as counts
/// for near.
void BodySearch::join_near_rims() {
  constexpr double kNear = 1e-3;  // of the diagonal
  const Box3 box = mesh::used_bounds(mesh_);
  const double near_mm = kNear * length(box.size());
  if (!(near_mm > 0.0)) return;
  std::map<Cell, std::uint32_t> part_in;
  const auto cell_of = [&](const Vec3& p) {
    Cell cell;
    for (std::size_t k = 0; k < 3; ++k) {
      cell[k] = static_cast<std::int64_t>(std::floor((p[k] - box.min[k]) / near_mm));
    }
    return cell;
  };
  const auto join_around = [&](const Cell& at, std::uint32_t part) {
    for (std::int64_t n = 0; n < 27; ++n) {
      const Cell other{at[0] + n / 9 - 1, at[1] + n / 3 % 3 - 1, at[2] + n % 3 - 1};
      const auto known = part_in.find(other);
      if (known != part_in.end()) bodies_.unite(known->second, part);
    }
  };
  for (std::size_t edge = 0; edge < edges_.size(); ++edge) {
    const auto uses = edges_.uses(edge);
    if (uses.size() != 1) continue;
    const std::uint32_t part = parts_.of_triangle[uses[0] / 3];
    for (const std::uint32_t v : {edges_.from(uses[0]), edges_.to(uses[0])}) {
      const Cell cell = cell_of(mesh_.positions[v]);
      join_around(cell, part);
      part_in.emplace(cell, part);
    }
  }
}

/// Closed components that face inward belong to the shell around them.
void BodySearch::join_cavities() {
  std::vector<std::uint32_t> part_of;  // of the triangles of the closed ones
  TriangleMesh closed;                 // each with vertices of its own, also where they touch
  std::vector<std::uint32_t> number(mesh_.positions.size());
  std::vector<std::uint32_t> last_part(mesh_.positions.size(), mesh::kNoPart);
  for (const std::uint32_t t : in_order_of_parts()) {
    Triangle triangle = mesh_.triangles[t];
    const std::uint32_t part = parts_.of_triangle[t];
    for (std::uint32_t& v : triangle) {
      if (last_part[v] != part) {
        number[v] = static_cast<std::uint32_t>(closed.positions.size());
        closed.positions.push_back(mesh_.positions[v]);
        last_part[v] = part;
      }
      v = number[v];
    }
    closed.triangles.push_back(triangle);
    part_of.push_back(part);
  }
  const mesh::MeshBodies bodies = mesh::mesh_bodies(closed);
  std::vector<std::uint32_t> first(bodies.count, mesh::kNoPart);
  for (std::size_t t = 0; t < part_of.size(); ++t) {
    std::uint32_t& of_body = first[bodies.of_triangle[t]];
    if (of_body == mesh::kNoPart) of_body = part_of[t];
    bodies_.unite(of_body, part_of[t]);
  }
}

/// The triangles of closed components, one component after the other.
std::vector<std::uint32_t> BodySearch::in_order_of_parts() const {
  std::vector<std::uint32_t> order;
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    const std::uint32_t part = parts_.of_triangle[t];
    if (part != mesh::kNoPart && !is_open_[part]) order.push_back(t);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return parts_.of_triangle[a] < parts_.of_triangle[b];
  });
  return order;
}

/// The largest first, by what they enclose and then by area; what has no area goes with the first.
std::vector<std::uint32_t> BodySearch::numbered() {
  struct Size {
    double volume = 0.0;
    double area = 0.0;
    std::uint32_t body = 0;
  };
  const std::vector<double> volumes = mesh::part_volumes(mesh_, parts_);
  std::vector<Size> sizes(parts_.count);
  for (std::uint32_t part = 0; part < parts_.count; ++part) {
    sizes[part].body = part;
    if (!is_open_[part]) sizes[bodies_.find(part)].volume += volumes[part];
  }
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    if (parts_.of_triangle[t] == mesh::kNoPart) continue;
    const auto& [a, b, c] = mesh_.triangles[t];
    const Vec3 twice =
        cross(mesh_.positions[b] - mesh_.positions[a], mesh_.positions[c] - mesh_.positions[a]);
    sizes[bodies_.find(parts_.of_triangle[t])].area += 0.5 * length(twice);
  }
  std::erase_if(sizes, [&](const Size& size) { return bodies_.find(size.body) != size.body; });
  std::stable_sort(sizes.begin(), sizes.end(), [](const Size& a, const Size& b) {
    const double volume_a = std::abs(a.volume);
    const double volume_b = std::abs(b.volume);
    return volume_a != volume_b ? volume_a > volume_b : a.area > b.area;
  });
  std::vector<std::uint32_t> number(parts_.count);
  for (std::uint32_t n = 0; n < sizes.size(); ++n) number[sizes[n].body] = n;
  std::vector<std::uint32_t> of_triangle;
  of_triangle.reserve(mesh_.triangles.size());
  for (const std::uint32_t part : parts_.of_triangle) {
    of_triangle.push_back(part == mesh::kNoPart ? 0 : number[bodies_.find(part)]);
  }
  return of_triangle;
}

std::vector<std::uint32_t> BodySearch::run() {
  find_open();
  join_near_rims();
  join_cavities();
  return numbered();
}

}  // namespace

std::vector<std::uint32_t> bodies_of(const TriangleMesh& mesh) { return BodySearch(mesh).run(); }

Assembly split_into_bodies(Assembly assembly) {
  if (assembly.objects.size() != 1) return assembly;
  AssemblyObject& whole = assembly.objects[0];
  assert(!whole.mesh.triangles.empty());
  std::vector<TriangleMesh> bodies = mesh::split_mesh(whole.mesh, bodies_of(whole.mesh));
  if (bodies.size() == 1) return assembly;
  Assembly parted;
  for (TriangleMesh& body : bodies) {
    const std::string number = std::to_string(parted.objects.size() + 1);
    parted.objects.push_back(
        {whole.name.empty() ? "" : whole.name + " " + number, whole.color, std::move(body)});
  }
  for (const AssemblyItem& item : assembly.items) {
    AssemblyItem& several = parted.items.emplace_back();
    several.name = item.name.empty() ? whole.name : item.name;
    for (const PlacedObject& placed : item.placements) {
      for (std::size_t body = 0; body < parted.objects.size(); ++body) {
        several.placements.push_back({body, placed.to_mm});
      }
    }
  }
  return parted;
}

}  // namespace argil::io
