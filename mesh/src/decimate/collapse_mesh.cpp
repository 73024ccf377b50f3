// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimate/collapse_mesh.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace argil::mesh {

std::optional<CollapseMesh> CollapseMesh::build(const TriangleMesh& mesh) {
  const EdgeTable edges(mesh);
  CollapseMesh made;
  made.positions_ = mesh.positions;
  made.triangles_ = mesh.triangles.size();
  const auto count = static_cast<HalfEdge>(3 * mesh.triangles.size());
  made.from_.resize(count);
  made.twin_.resize(count);
  made.out_.assign(mesh.positions.size(), kGone);
  made.mark_.assign(mesh.positions.size(), 0);
  for (HalfEdge h = 0; h < count; ++h) {
    made.from_[h] = edges.from(h);
    made.out_[edges.from(h)] = h;
    if (!edges.takes_part(triangle_of(h))) return std::nullopt;
    const auto uses = edges.uses(edges.edge_of(h));
    if (uses.size() != 2 || edges.forward(uses[0]) == edges.forward(uses[1])) return std::nullopt;
    made.twin_[h] = uses[0] == h ? uses[1] : uses[0];
  }
  if (!made.is_one_fan_each()) return std::nullopt;
  return made;
}

std::size_t CollapseMesh::degree(std::uint32_t v) const noexcept {
  assert(v < out_.size() && out_[v] != kGone);
  std::size_t count = 0;
  HalfEdge h = out_[v];
  do {
    ++count;
    h = next_around(h);
  } while (h != out_[v]);
  return count;
}

/// Whether turning round each vertex meets all its triangles.
bool CollapseMesh::is_one_fan_each() const {
  std::size_t met = 0;
  for (std::uint32_t v = 0; v < out_.size(); ++v) {
    if (out_[v] != kGone) met += degree(v);
  }
  return met == from_.size();
}

/// The link condition of a closed two-manifold: T. K. Dey et al., "Topology preserving edge
/// contraction", 1999.
bool CollapseMesh::can_collapse(HalfEdge h) noexcept {
  assert(!is_gone(h));
  const HalfEdge back = twin_[h];
  const std::uint32_t third = from_[next_in_triangle(next_in_triangle(h))];
  const std::uint32_t fourth = from_[next_in_triangle(next_in_triangle(back))];
  if (degree(third) == 3 || degree(fourth) == 3) return false;
  // Marks hold for the call that set them, so that none needs to be cleared.
  ++call_;
  HalfEdge around = h;
  do {
    mark_[to(around)] = call_;
    around = next_around(around);
  } while (around != h);
  int common = 0;
  around = back;
  do {
    common += mark_[to(around)] == call_ ? 1 : 0;
    around = next_around(around);
  } while (around != back);
  return common == 2;
}

void CollapseMesh::glue(HalfEdge a, HalfEdge b) noexcept {
  assert(!is_gone(a) && !is_gone(b));
  twin_[a] = b;
  twin_[b] = a;
  out_[from_[a]] = a;
  out_[from_[b]] = b;
}

void CollapseMesh::collapse(HalfEdge h, const Vec3& position) noexcept {
  assert(!is_gone(h) && is_finite(position) && triangles_ >= 2);
  const std::uint32_t stays = from_[h];
  const std::uint32_t goes = to(h);
  const HalfEdge back = twin_[h];
  HalfEdge around = back;
  do {
    from_[around] = stays;
    around = next_around(around);
  } while (around != back);
  for (const HalfEdge side : {h, back}) {
    const HalfEdge second = next_in_triangle(side);
    const HalfEdge last = next_in_triangle(second);
    // The two sides of the vanishing triangle that are left become one edge.
    glue(twin_[second], twin_[last]);
    from_[side] = from_[second] = from_[last] = kGone;
  }
  out_[goes] = kGone;
  assert(twin_[twin_[out_[stays]]] == out_[stays] && from_[out_[stays]] == stays);
  positions_[stays] = position;
  triangles_ -= 2;
}

TriangleMesh CollapseMesh::mesh(std::vector<std::uint32_t>& kept) const {
  TriangleMesh left;
  kept.clear();
  std::vector<std::uint32_t> number(positions_.size(), kGone);
  for (std::uint32_t v = 0; v < positions_.size(); ++v) {
    if (out_[v] == kGone) continue;
    number[v] = static_cast<std::uint32_t>(left.positions.size());
    left.positions.push_back(positions_[v]);
    kept.push_back(v);
  }
  left.triangles.reserve(triangles_);
  for (HalfEdge h = 0; h < from_.size(); h += 3) {
    if (is_gone(h)) continue;
    left.triangles.push_back({number[from_[h]], number[from_[h + 1]], number[from_[h + 2]]});
  }
  assert(left.triangles.size() == triangles_);
  return left;
}

}  // namespace argil::mesh
