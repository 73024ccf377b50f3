// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimate/collapse_mesh.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <numeric>
#include <span>
#include <utility>

#include <tbb/parallel_for.h>

#include "argil/mesh/rounding.h"

#include "topology/corners_around.h"

namespace argil::mesh {

std::optional<CollapseMesh> CollapseMesh::build(const TriangleMesh& mesh) {
  CollapseMesh made;
  made.positions_ = mesh.positions;
  const auto count = static_cast<HalfEdge>(3 * mesh.triangles.size());
  made.from_.reserve(count);
  for (const Triangle& t : mesh.triangles) made.from_.insert(made.from_.end(), t.begin(), t.end());
  made.twin_.resize(count);
  made.out_.assign(mesh.positions.size(), kGone);
  made.into_.resize(mesh.positions.size());
  std::iota(made.into_.begin(), made.into_.end(), 0U);
  const CornersAround half_edges(mesh);  // a half-edge begins at the corner of its number
  std::atomic<bool> is_good = true;
  // Each half-edge must be the only one its way, and have just one the other way.
  tbb::parallel_for(HalfEdge{0}, count, [&](HalfEdge h) {
    const std::uint32_t from = made.from_[h];
    int back = 0;
    for (const HalfEdge other : half_edges.of(made.to(h))) {
      if (made.to(other) != from) continue;
      made.twin_[h] = other;
      ++back;
    }
    if (back != 1 || made.to(h) == from) is_good = false;
  });
  if (!is_good) return std::nullopt;
  // Turning round a vertex must meet all its triangles.
  tbb::parallel_for(std::size_t{0}, made.out_.size(), [&](std::size_t v) {
    const auto around = half_edges.of(static_cast<std::uint32_t>(v));
    if (around.empty()) return;
    made.out_[v] = around.back();
    std::size_t met = 0;
    HalfEdge h = around.back();
    do {
      ++met;
      h = made.next_around(h);
    } while (h != around.back());
    if (met != around.size()) is_good = false;
  });
  if (!is_good) return std::nullopt;
  return made;
}

bool CollapseMesh::has_three_triangles(std::uint32_t v) const noexcept {
  assert(v < out_.size() && out_[v] != kGone);
  return next_around(next_around(next_around(out_[v]))) == out_[v];
}

/// The link condition of a closed two-manifold: T. K. Dey et al., "Topology preserving edge
/// contraction", 1999.
bool CollapseMesh::can_collapse(HalfEdge h, std::vector<std::uint32_t>& ring) const {
  assert(!is_gone(h));
  const HalfEdge back = twin_[h];
  const std::uint32_t third = from_[next_in_triangle(next_in_triangle(h))];
  const std::uint32_t fourth = from_[next_in_triangle(next_in_triangle(back))];
  if (has_three_triangles(third) || has_three_triangles(fourth)) return false;
  ring.clear();
  HalfEdge around = h;
  do {
    ring.push_back(to(around));
    around = next_around(around);
  } while (around != h);
  // A ring is mostly of six: to look through it takes less than marks in memory.
  int common = 0;
  around = back;
  do {
    common += std::find(ring.begin(), ring.end(), to(around)) != ring.end() ? 1 : 0;
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
  assert(!is_gone(h) && is_finite(position));
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
  into_[goes] = stays;
  assert(twin_[twin_[out_[stays]]] == out_[stays] && from_[out_[stays]] == stays);
  positions_[stays] = position;
}

void CollapseMesh::round_to_float() {
  tbb::parallel_for(std::size_t{0}, positions_.size(), [&](std::size_t v) {
    const std::array<float, 3> rounded = floats_of(positions_[v]);
    positions_[v] = {static_cast<double>(rounded[0]), static_cast<double>(rounded[1]),
                     static_cast<double>(rounded[2])};
  });
}

void CollapseMesh::shorten_ways() noexcept {
  for (std::uint32_t v = 0; v < into_.size(); ++v) {
    const std::uint32_t last = became(v);
    for (std::uint32_t u = v; u != last;) u = std::exchange(into_[u], last);
  }
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
  for (HalfEdge h = 0; h < from_.size(); h += 3) {
    if (is_gone(h)) continue;
    left.triangles.push_back({number[from_[h]], number[from_[h + 1]], number[from_[h + 2]]});
  }
  return left;
}

}  // namespace argil::mesh
