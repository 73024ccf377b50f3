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
  if (common != 2) return false;
  // Of one with three triangles the last neighbour is beside both ends as well: the other of the
  // two.
  const auto across = [this](HalfEdge side) { return to(next_in_triangle(twin_[side])); };
  const HalfEdge to_third = next_in_triangle(h);
  const HalfEdge to_fourth = next_in_triangle(back);
  const std::uint32_t third = to(to_third);
  const std::uint32_t fourth = to(to_fourth);
  return !(across(to_third) == fourth && has_three_triangles(third)) &&
         !(across(to_fourth) == third && has_three_triangles(fourth));
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

CollapseMesh CollapseMesh::compacted(std::vector<std::uint32_t>& number) const {
  CollapseMesh made;
  number.assign(positions_.size(), kGone);
  for (std::uint32_t v = 0; v < positions_.size(); ++v) {
    if (out_[v] == kGone) continue;
    number[v] = static_cast<std::uint32_t>(made.positions_.size());
    made.positions_.push_back(positions_[v]);
  }
  std::vector<std::uint32_t> triangle(from_.size() / 3, kGone);
  std::uint32_t count = 0;
  for (std::size_t t = 0; t < triangle.size(); ++t) {
    if (from_[3 * t] != kGone) triangle[t] = count++;
  }
  const auto new_of = [&](HalfEdge h) { return 3 * triangle[triangle_of(h)] + h % 3; };
  made.from_.reserve(std::size_t{3} * count);
  made.twin_.reserve(std::size_t{3} * count);
  for (HalfEdge h = 0; h < from_.size(); ++h) {
    if (is_gone(h)) continue;
    made.from_.push_back(number[from_[h]]);
    made.twin_.push_back(new_of(twin_[h]));
  }
  for (const HalfEdge h : out_) {
    if (h != kGone) made.out_.push_back(new_of(h));
  }
  made.into_.resize(made.positions_.size());
  std::iota(made.into_.begin(), made.into_.end(), 0U);
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == kGone) number[v] = number[became(v)];
  }
  assert(made.out_.size() == made.positions_.size());
  return made;
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
