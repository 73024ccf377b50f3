// SPDX-License-Identifier: GPL-3.0-or-later
// Two trees of boxes go down together: the nearer boxes first, none that cannot hold what is nearer
// than what was found.
#include "argil/mesh/part_gaps.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "argil/core/winding_number.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/triangle_geometry.h"

#include "measure/triangle_distance.h"

namespace argil::mesh {
namespace {

double distance2_of(const Box3& a, const Box3& b) noexcept {
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double apart = std::max({0.0, a.min[k] - b.max[k], b.min[k] - a.max[k]});
    sum += apart * apart;
  }
  return sum;
}

bool holds(const Box3& outer, const Box3& inner) noexcept {
  for (std::size_t k = 0; k < 3; ++k) {
    if (inner.min[k] < outer.min[k] || inner.max[k] > outer.max[k]) return false;
  }
  return true;
}

Box3 box_of(const Corners& c) noexcept {
  Box3 box{c[0], c[0]};
  for (std::size_t k = 0; k < 3; ++k) {
    box.min[k] = std::min({c[0][k], c[1][k], c[2][k]});
    box.max[k] = std::max({c[0][k], c[1][k], c[2][k]});
  }
  return box;
}

/// Boxes around halves of the triangles, down to a few.
class BoxTree {
 public:
  struct Node {
    Box3 box;
    std::uint32_t first = 0;  ///< of `order()`
    std::uint32_t count = 0;
    std::uint32_t second = 0;  ///< child; the first follows its parent; 0: a leaf
  };

  explicit BoxTree(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
    assert(!mesh.triangles.empty());
    std::iota(order_.begin(), order_.end(), 0U);
    build(0, static_cast<std::uint32_t>(order_.size()));
  }

  const Node& node(std::uint32_t n) const noexcept { return nodes_[n]; }
  Corners corners(std::uint32_t place) const noexcept { return corners_of(mesh_, order_[place]); }

 private:
  static constexpr std::uint32_t kLeaf = 4;

  double middle_along(std::uint32_t triangle, std::size_t axis) const noexcept {
    return middle(corners_of(mesh_, triangle))[axis];
  }

  void build(std::uint32_t first, std::uint32_t count) {
    const auto own = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, first, count, 0});
    Box3 box;
    Box3 middles;
    for (std::uint32_t place = first; place < first + count; ++place) {
      const Corners c = corners(place);
      for (const Vec3& corner : c) box.include(corner);
      middles.include(middle(c));
    }
    nodes_[own].box = box;
    if (count <= kLeaf) return;
    const Vec3 size = middles.size();
    const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t half = count / 2;
    // By number where they are equal, so that the halves do not depend on the library.
    std::nth_element(order_.begin() + first, order_.begin() + first + half,
                     order_.begin() + first + count, [&](std::uint32_t a, std::uint32_t b) {
                       return std::tuple(middle_along(a, axis), a) <
                              std::tuple(middle_along(b, axis), b);
                     });
    build(first, half);
    nodes_[own].second = static_cast<std::uint32_t>(nodes_.size());
    build(first + half, count - half);
  }

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

/// Looks for where two trees come nearest.
class NearestPair {
 public:
  NearestPair(const BoxTree& a, const BoxTree& b, double reach, const Pace& pace)
      : a_(a), b_(b), pace_(pace) {
    nearest_.distance2 = reach * reach;
  }

  /// Nothing where they are not nearer than the reach.
  std::optional<ClosestPoints> run() {
    visit(0, 0);
    return found_ ? std::optional(nearest_) : std::nullopt;
  }

 private:
  double bound(std::uint32_t a, std::uint32_t b) const noexcept {
    return distance2_of(a_.node(a).box, b_.node(b).box);
  }
  bool may_hold(double bound2) const noexcept { return bound2 < nearest_.distance2; }

  void visit(std::uint32_t a, std::uint32_t b);
  void measure(const BoxTree::Node& a, const BoxTree::Node& b);
  void visit_nearer_first(std::array<std::uint32_t, 2> first, std::array<std::uint32_t, 2> second);

  const BoxTree& a_;
  const BoxTree& b_;
  const Pace& pace_;
  ClosestPoints nearest_;
  bool found_ = false;
  std::uint32_t measured_ = 0;
};

void NearestPair::measure(const BoxTree::Node& a, const BoxTree::Node& b) {
  constexpr std::uint32_t kAskEvery = 1U << 12U;
  if (++measured_ % kAskEvery == 0) pace_.at(0.0);
  for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
    const Corners corners = a_.corners(i);
    const Box3 box = box_of(corners);
    if (!may_hold(distance2_of(box, b.box))) continue;
    for (std::uint32_t j = b.first; j < b.first + b.count; ++j) {
      const Corners other = b_.corners(j);
      if (!may_hold(distance2_of(box, box_of(other)))) continue;
      const ClosestPoints points = closest_points(corners, other);
      if (!(points.distance2 < nearest_.distance2)) continue;
      nearest_ = points;
      found_ = true;
    }
  }
}

void NearestPair::visit_nearer_first(std::array<std::uint32_t, 2> first,
                                     std::array<std::uint32_t, 2> second) {
  if (bound(second[0], second[1]) < bound(first[0], first[1])) std::swap(first, second);
  visit(first[0], first[1]);
  visit(second[0], second[1]);
}

void NearestPair::visit(std::uint32_t a, std::uint32_t b) {
  if (!may_hold(bound(a, b))) return;
  const BoxTree::Node& in_a = a_.node(a);
  const BoxTree::Node& in_b = b_.node(b);
  if (in_a.second == 0 && in_b.second == 0) return measure(in_a, in_b);
  const bool goes_down_a =
      in_b.second == 0 || (in_a.second != 0 && length(in_a.box.size()) >= length(in_b.box.size()));
  if (goes_down_a) {
    visit_nearer_first({a + 1, b}, {in_a.second, b});
  } else {
    visit_nearer_first({a, b + 1}, {a, in_b.second});
  }
}

class PartGapSearch {
 public:
  PartGapSearch(std::span<const TriangleMesh> parts, double reach, const Pace& pace)
      : parts_(parts), reach_(reach), pace_(pace), trees_(parts.size()), windings_(parts.size()) {
    for (const TriangleMesh& part : parts) boxes_.push_back(used_bounds(part));
  }

  std::vector<PartGap> run();

 private:
  const BoxTree& tree(std::size_t part);
  std::optional<PartGap> look_at(std::uint32_t a, std::uint32_t b);
  /// Where a part lies in the solid of another that it does not cross.
  std::optional<Vec3> place_within(std::size_t inner, std::size_t outer);

  std::span<const TriangleMesh> parts_;
  double reach_;
  const Pace& pace_;
  std::vector<Box3> boxes_;
  std::vector<std::optional<BoxTree>> trees_;
  std::vector<std::optional<WindingNumber>> windings_;
};

const BoxTree& PartGapSearch::tree(std::size_t part) {
  if (!trees_[part]) trees_[part].emplace(parts_[part]);
  return *trees_[part];
}

std::optional<Vec3> PartGapSearch::place_within(std::size_t inner, std::size_t outer) {
  constexpr double kInside = 0.5;
  if (!holds(boxes_[outer], boxes_[inner])) return std::nullopt;
  if (!windings_[outer]) windings_[outer].emplace(parts_[outer].positions, parts_[outer].triangles);
  const Vec3 at = parts_[inner].positions[parts_[inner].triangles[0][0]];
  return windings_[outer]->at(at) > kInside ? std::optional(at) : std::nullopt;
}

std::optional<PartGap> PartGapSearch::look_at(std::uint32_t a, std::uint32_t b) {
  if (boxes_[a].empty() || boxes_[b].empty() || !boxes_[a].meets(boxes_[b], reach_)) {
    return std::nullopt;
  }
  PartGap gap{a, b, 0.0, false, {}};
  const auto nearest = NearestPair(tree(a), tree(b), reach_, pace_).run();
  if (nearest) {
    gap.gap_mm = std::sqrt(nearest->distance2);
    gap.at_mm = 0.5 * (nearest->a + nearest->b);
  }
  if (nearest && gap.meet()) return gap;
  std::optional<Vec3> within = place_within(a, b);
  if (!within) within = place_within(b, a);
  if (within) return PartGap{a, b, 0.0, true, *within};
  return nearest ? std::optional(gap) : std::nullopt;
}

std::vector<PartGap> PartGapSearch::run() {
  std::vector<PartGap> gaps;
  for (std::uint32_t a = 0; a < parts_.size(); ++a) {
    pace_.at(static_cast<double>(a) / static_cast<double>(parts_.size()));
    for (std::uint32_t b = a + 1; b < parts_.size(); ++b) {
      if (const auto gap = look_at(a, b)) gaps.push_back(*gap);
    }
  }
  std::stable_sort(gaps.begin(), gaps.end(),
                   [](const PartGap& a, const PartGap& b) { return a.gap_mm < b.gap_mm; });
  return gaps;
}

}  // namespace

std::vector<PartGap> part_gaps(std::span<const TriangleMesh> parts, double reach_mm,
                               const Pace& pace) {
  assert(parts.size() <= kMostParts && reach_mm > 0.0);
  return PartGapSearch(parts, reach_mm, pace).run();
}

}  // namespace argil::mesh
