// SPDX-License-Identifier: GPL-3.0-or-later
// Leaves in the order of a curve that keeps neighbours together, each eight under a branch.
#include "feet/feet_tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace argil {
namespace {

constexpr std::size_t kChildren = ClusterBoxes::kClusters;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Wider than what rounding does to a square of a distance.
constexpr float kRounding = 1.0F + 4e-6F;
/// Boxes are wider than what they are around by what rounding may do to places in them, by size.
constexpr float kBoxRounding = 1e-6F;

Vec3 sum_of(const Vec3& at, const std::array<float, 3>& off) noexcept {
  return at + Vec3{static_cast<double>(off[0]), static_cast<double>(off[1]),
                   static_cast<double>(off[2])};
}

/// Every third bit, from the lowest on, of the 21 lowest.
std::uint64_t spread_bits(std::uint64_t n) noexcept {
  n &= 0x1fffff;
  n = (n | n << 32) & 0x1f00000000ffff;
  n = (n | n << 16) & 0x1f0000ff0000ff;
  n = (n | n << 8) & 0x100f00f00f00f00f;
  n = (n | n << 4) & 0x10c30c30c30c30c3;
  return (n | n << 2) & 0x1249249249249249;
}

/// Where places lie along Morton's curve through cells of some size.
class MortonOrder {
 public:
  MortonOrder(const Vec3& low, double cell_mm) : low_(low), per_mm_(1.0 / cell_mm) {}
  std::uint64_t at(const Vec3& place) const noexcept {
    const Vec3 cell = (place - low_) * per_mm_;
    const auto bits = [](double along) {
      return spread_bits(static_cast<std::uint64_t>(std::max(along, 0.0)));
    };
    return bits(cell.x) << 2 | bits(cell.y) << 1 | bits(cell.z);
  }

 private:
  Vec3 low_;
  double per_mm_;
};

void sort_along_curve(std::vector<PlacedFeet>& feet, double cell_mm) {
  Box3 box;
  for (const PlacedFeet& each : feet) box.include(each.origin_mm);
  const MortonOrder order(box.min, cell_mm);
  std::vector<std::pair<std::uint64_t, std::size_t>> keys(feet.size());
  for (std::size_t n = 0; n < feet.size(); ++n) keys[n] = {order.at(feet[n].origin_mm), n};
  std::sort(keys.begin(), keys.end());
  std::vector<PlacedFeet> sorted;
  sorted.reserve(feet.size());
  for (const auto& [key, n] : keys) sorted.push_back(std::move(feet[n]));
  feet = std::move(sorted);
}

}  // namespace

/// A part of the tree while it grows.
struct FeetTree::Part {
  Box3 box_mm;
  float apart = 0.0F;
};

struct FeetTree::Search {
  Vec3 center_mm;
  float half;
  float least_mm;
  Found& found;
};

FeetTree::FeetTree(std::vector<PlacedFeet> feet, const LevelStack& stack) : feet_(std::move(feet)) {
  if (feet_.empty()) return;
  for (int level = 0; level < stack.count(); ++level) {
    apart_mm_.push_back(static_cast<float>(stack.voxel_mm(level)));
  }
  const int finest = std::ranges::min_element(feet_, {}, &PlacedFeet::level)->level;
  sort_along_curve(feet_, kLeafSide * stack.voxel_mm(finest));
  std::vector<Part> parts;
  parts.reserve(feet_.size());
  for (const PlacedFeet& each : feet_) parts.push_back(part_of(each));
  std::size_t first = 0;  // of the branches that are the parts
  bool has_leaves = true;
  do {
    std::vector<Part> above;
    const std::size_t next = branches_.size();
    for (std::size_t begin = 0; begin < parts.size(); begin += kChildren) {
      Branch branch = branch_over(parts, begin);
      branch.first = first + begin;
      branch.has_leaves = has_leaves;
      Part whole;
      for (std::size_t n = begin; n < std::min(begin + kChildren, parts.size()); ++n) {
        whole.box_mm.include(parts[n].box_mm.min);
        whole.box_mm.include(parts[n].box_mm.max);
        whole.apart = std::max(whole.apart, parts[n].apart);
      }
      branches_.push_back(branch);
      above.push_back(whole);
    }
    parts = std::move(above);
    first = next;
    has_leaves = false;
  } while (parts.size() > 1);
}

FeetTree::Part FeetTree::part_of(const PlacedFeet& feet) const {
  Part part;
  part.box_mm.include(sum_of(feet.origin_mm, feet.layer.all_surface.low));
  part.box_mm.include(sum_of(feet.origin_mm, feet.layer.all_surface.high));
  part.apart = apart_mm_[static_cast<std::size_t>(feet.level)];
  return part;
}

FeetTree::Branch FeetTree::branch_over(const std::vector<Part>& parts, std::size_t begin) const {
  Branch branch{};
  const std::size_t count = std::min(kChildren, parts.size() - begin);
  Box3 whole;
  for (std::size_t n = 0; n < count; ++n) {
    whole.include(parts[begin + n].box_mm.min);
    whole.include(parts[begin + n].box_mm.max);
  }
  branch.at_mm = 0.5 * (whole.min + whole.max);
  const Vec3 size = whole.size();
  const float slack = kBoxRounding * static_cast<float>(std::max({size.x, size.y, size.z}));
  for (std::size_t n = 0; n < kChildren; ++n) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      branch.boxes.low[axis][n] = kInfinity;
      branch.boxes.high[axis][n] = -kInfinity;
      if (n >= count) continue;
      const Part& part = parts[begin + n];
      branch.boxes.low[axis][n] =
          static_cast<float>(part.box_mm.min[axis] - branch.at_mm[axis]) - slack;
      branch.boxes.high[axis][n] =
          static_cast<float>(part.box_mm.max[axis] - branch.at_mm[axis]) + slack;
    }
    branch.apart[n] = n < count ? parts[begin + n].apart : 0.0F;
  }
  return branch;
}

void FeetTree::collect(const Vec3& center_mm, double half_mm, float least_mm, float most_mm,
                       Found& found) const {
  assert(half_mm >= 0.0 && most_mm >= 0.0F);
  found.lists.resize(std::max(found.lists.size(), apart_mm_.size()));
  for (ClusterList& list : found.lists) list.clear();
  found.bound_mm = most_mm;
  found.finest = Found::kNoLevel;
  found.is_near = false;
  if (is_empty()) return;
  Search search{center_mm, static_cast<float>(half_mm), least_mm, found};
  visit(branches_.back(), search);
  if (found.is_near) {
    for (ClusterList& list : found.lists) list.clear();
    found.finest = Found::kNoLevel;
    return;
  }
  for (ClusterList& list : found.lists) list.close();
}

namespace {

/// Within what distance all places of a cube certainly have some point of the boxes.
float bound_of(const ClusterSquares& squares) noexcept {
  return std::sqrt(*std::ranges::min_element(squares.farthest)) * kRounding;
}

/// Whether a box is farther than `reach`, not less than 0, by more than rounding may have done.
bool is_surely_beyond(float nearest_square, float reach) noexcept {
  return nearest_square > reach * reach * kRounding * kRounding;
}

/// How near and how far boxes are, as RowLoops tells it, with no shell to regard.
ClusterSquares squares_of(const ClusterBoxes& boxes, const Vec3& offset, float half) {
  constexpr float kFar = 1e30F;
  ClusterSquares squares;
  row_loops().measure_clusters(
      {&boxes,
       &boxes,
       {static_cast<float>(offset.x), static_cast<float>(offset.y), static_cast<float>(offset.z)},
       half,
       kFar,
       -kFar},
      squares);
  return squares;
}

}  // namespace

/// Nearer parts first, so that those are rarely entered which they show to be too far. The nearest
/// foot may be for a point of the surface that is farther than the nearest by as much as feet are
/// apart.
void FeetTree::visit(const Branch& branch, Search& search) const {
  Found& found = search.found;
  const ClusterSquares squares =
      squares_of(branch.boxes, branch.at_mm - search.center_mm, search.half);
  found.bound_mm = std::min(found.bound_mm, bound_of(squares));
  std::array<std::size_t, kChildren> order;
  std::array<float, kChildren> nearest;
  std::size_t count = 0;
  for (std::size_t n = 0; n < kChildren; ++n) {
    if (is_surely_beyond(squares.nearest[n], found.bound_mm * kRounding + branch.apart[n])) {
      continue;
    }
    nearest[n] = std::sqrt(squares.nearest[n]) - branch.apart[n];
    std::size_t at = count++;
    for (; at > 0 && nearest[order[at - 1]] > nearest[n]; --at) order[at] = order[at - 1];
    order[at] = n;
  }
  found.is_near = found.is_near || found.bound_mm < search.least_mm;
  for (std::size_t at = 0; at < count; ++at) {
    const std::size_t n = order[at];
    if (found.is_near || !(nearest[n] <= found.bound_mm * kRounding)) return;
    const std::size_t child = branch.first + n;
    if (branch.has_leaves) {
      take(feet_[child], search);
    } else {
      visit(branches_[child], search);
    }
    found.is_near = found.is_near || found.bound_mm < search.least_mm;
  }
}

/// The clusters of a leaf.
void FeetTree::take(const PlacedFeet& feet, Search& search) const {
  Found& found = search.found;
  const LayerFeet& layer = feet.layer;
  const auto level = static_cast<std::size_t>(feet.level);
  const Vec3 offset = feet.origin_mm - search.center_mm;
  const ClusterSquares squares = squares_of(layer.surface, offset, search.half);
  found.bound_mm = std::min(found.bound_mm, bound_of(squares));
  for (std::size_t n = 0; n < kChildren; ++n) {
    const float reach = found.bound_mm * kRounding;
    if (is_surely_beyond(squares.nearest[n], reach + apart_mm_[level])) continue;
    if (!(std::sqrt(squares.nearest[n]) - apart_mm_[level] <= reach)) continue;
    const int begin = layer.first[n];
    found.lists[level].append({layer.values.data() + begin,
                               layer.count(),
                               layer.first[n + 1] - begin,
                               0,
                               {static_cast<float>(offset.x), static_cast<float>(offset.y),
                                static_cast<float>(offset.z)}},
                              layer.feet, n);
    found.finest = std::min(found.finest, feet.level);
  }
}

}  // namespace argil
