// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing that is left out here could be nearest to a node of the tile, so that a node's distance
// does not depend on what else is asked for.
#include "window/tile_feet.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace argil {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Wider than what rounding does to a square of a distance.
constexpr float kRounding = 1.0F + 4e-6F;
/// How far around its foot a bent patch is believed, in voxels from one foot to the next.
constexpr double kPatch = 0.75;
/// How far a ring reaches, in its voxels: the finest far enough that most of what a tool of eight
/// nodes across asks is told by it (WindowForceError.IsSmallOnRoughness).
constexpr double kFirstRing = 12.0;
constexpr double kOtherRings = 8.0;
/// A leaf's points of the surface are at most this far from its nodes, in voxels: the layer's
/// distance, and what a foot may lie off its node.
constexpr double kBelow = kLayerVoxels + 1.0;

/// The leaves of a ring whose points of the surface may lie within its reach of the tile,
/// and no farther from it than `most_mm`.
NodeBox leaves_within(const FeetRing& ring, const TileFrame& tile, double most_mm) {
  const double reach = tile.half_mm + std::min(ring.reach_mm, most_mm) + kBelow * ring.voxel_mm;
  const NodeBox nodes = covering_nodes(tile.center_mm, reach, ring.voxel_mm);
  return {Coord::maxComponent(nodes.low >> 3, ring.leaves.low),
          Coord::minComponent(nodes.high >> 3, ring.leaves.high)};
}

/// The square of how near a box is to a cube of half side `half` around the origin.
float square_of(const PointBox& box, const std::array<float, 3>& offset, float half) noexcept {
  float square = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float below = -half - (box.high[axis] + offset[axis]);
    const float above = box.low[axis] + offset[axis] - half;
    const float off = std::max(std::max(below, above), 0.0F);
    square += off * off;
  }
  return square;
}

}  // namespace

double farthest_mm(const LevelStack& stack, const LevelChoice& levels,
                   const WindowRequest& request) noexcept {
  return request.depth_mm + 2.0 * stack.voxel_mm(levels.finer_level);
}

std::vector<FeetRing> rings_for(const LevelStack& stack, const LevelChoice& levels,
                                const WindowRequest& request) {
  const double farthest = farthest_mm(stack, levels, request);
  std::vector<FeetRing> rings;
  for (int level = levels.finer_level;; ++level) {
    FeetRing ring;
    ring.level = level;
    ring.voxel_mm = stack.voxel_mm(level);
    ring.is_average = !rings.empty();
    const double reach = (ring.is_average ? kOtherRings : kFirstRing) * ring.voxel_mm;
    const bool is_last = level == stack.top() || reach >= farthest;
    ring.reach_mm = is_last ? farthest : reach;
    rings.push_back(std::move(ring));
    if (is_last) return rings;
  }
}

void TileFeet::collect(const FeetRing& ring, std::size_t side, const TileFrame& tile,
                       double inner_mm, float& bound_mm) {
  layer_ = static_cast<float>(kLayerVoxels * ring.voxel_mm);
  patch_ = static_cast<float>(kPatch * ring.voxel_mm);
  count_ = 0;
  const auto half = static_cast<float>(tile.half_mm);
  // A way over a foot is no shorter than that to the surface below it.
  if (static_cast<double>(bound_mm) < inner_mm - tile.half_mm) return;
  const Shell shell{static_cast<float>(tile.half_mm + ring.reach_mm), static_cast<float>(inner_mm)};
  list(ring, side, tile, shell, static_cast<double>(bound_mm));
  if (leaves_.empty()) return;
  // The nearest leaf tells how far the others are worth a look, whose order stays.
  const auto nearest = std::ranges::min_element(leaves_, {}, &Leaf::square);
  const Clusters first = clusters_of(*nearest, half, shell);
  bound_mm = std::min(bound_mm, layer_ + std::sqrt(farthest_of(*nearest, first, half)) * kRounding);
  for (const Leaf& leaf : leaves_) {
    const float within = std::max(bound_mm - layer_, 0.0F);
    if (leaf.square <= within * within * kRounding) take(leaf, half, shell, bound_mm);
  }
}

/// The leaves that have feet of that side for the shell.
void TileFeet::list(const FeetRing& ring, std::size_t side, const TileFrame& tile,
                    const Shell& shell, double most_mm) {
  const auto half = static_cast<float>(tile.half_mm);
  const std::array<int, 3> n = ring.leaves.sides();
  leaves_.clear();
  for_each_node(leaves_within(ring, tile, most_mm), [&](const Coord& at) {
    const Coord from = at - ring.leaves.low;
    const auto index = static_cast<std::size_t>((from.x() * n[1] + from.y()) * n[2] + from.z());
    const LeafLayers* layers = ring.layers[index];
    if (layers == nullptr || (*layers)[side].is_empty()) return;
    Leaf leaf{&(*layers)[side], {}, 0.0F};
    const Vec3 offset = node_mm(at << 3, ring.voxel_mm) - tile.center_mm;
    bool is_out = false;
    bool is_inner = shell.inner > 0.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      leaf.offset[axis] = static_cast<float>(offset[axis]);
      const float low = leaf.layer->all_surface.low[axis] + leaf.offset[axis];
      const float high = leaf.layer->all_surface.high[axis] + leaf.offset[axis];
      is_out |= low > shell.outer || high < -shell.outer;
      is_inner &= low > -shell.inner && high < shell.inner;
    }
    if (is_out || is_inner) return;
    leaf.square = square_of(leaf.layer->all_feet, leaf.offset, half);
    leaves_.push_back(leaf);
  });
}

/// Those clusters of a leaf that may be nearest to some node.
void TileFeet::take(const Leaf& leaf, float half, const Shell& shell, float& bound) {
  const Clusters clusters = clusters_of(leaf, half, shell);
  bound = std::min(bound, layer_ + std::sqrt(farthest_of(leaf, clusters, half)) * kRounding);
  const float within = std::max(bound - layer_, 0.0F);
  for (std::size_t n = 0; n < ClusterBoxes::kClusters; ++n) {
    if (clusters.nearest[n] <= within * within * kRounding) {
      append(leaf, n, clusters.is_cut[n], shell.inner);
    }
  }
}

TileFeet::Clusters TileFeet::clusters_of(const Leaf& leaf, float half, const Shell& shell) {
  const ClusterBoxes& feet = leaf.layer->feet;
  const ClusterBoxes& surface = leaf.layer->surface;
  Clusters clusters;
  for (std::size_t n = 0; n < ClusterBoxes::kClusters; ++n) {
    float square = 0.0F;
    bool is_out = false;
    bool is_inner = shell.inner > 0.0F;
    bool meets_inner = is_inner;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float below = -half - (feet.high[axis][n] + leaf.offset[axis]);
      const float above = feet.low[axis][n] + leaf.offset[axis] - half;
      const float off = std::max(std::max(below, above), 0.0F);
      square += off * off;
      const float low = surface.low[axis][n] + leaf.offset[axis];
      const float high = surface.high[axis][n] + leaf.offset[axis];
      is_out |= low > shell.outer || high < -shell.outer;
      is_inner &= low > -shell.inner && high < shell.inner;
      meets_inner &= low < shell.inner && high > -shell.inner;
    }
    clusters.nearest[n] = is_out || is_inner ? kInfinity : square;
    clusters.is_cut[n] = meets_inner;
  }
  return clusters;
}

/// The square of the distance from the tile's nodes within which each has a foot of the leaf: that
/// of the farthest corners of some cluster and the tile. Infinite when it is not known.
float TileFeet::farthest_of(const Leaf& leaf, const Clusters& clusters, float half) {
  const ClusterBoxes& feet = leaf.layer->feet;
  float least = kInfinity;
  for (std::size_t n = 0; n < ClusterBoxes::kClusters; ++n) {
    if (clusters.nearest[n] == kInfinity || clusters.is_cut[n]) continue;
    float square = 0.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float low = std::abs(feet.low[axis][n] + leaf.offset[axis]);
      const float high = std::abs(feet.high[axis][n] + leaf.offset[axis]);
      const float most = std::max(low, high) + half;
      square += most * most;
    }
    least = std::min(least, square);
  }
  return least;
}

/// Feet that are left out are put where they are nearest to nothing.
void TileFeet::append(const Leaf& leaf, std::size_t cluster, bool is_cut, float inner) {
  const auto begin = static_cast<std::size_t>(leaf.layer->first[cluster]);
  const auto size = static_cast<std::size_t>(leaf.layer->first[cluster + 1]) - begin;
  const auto to = static_cast<std::size_t>(count_);
  for (int which = 0; which < LayerFeet::kFields; ++which) {
    auto& values = values_[static_cast<std::size_t>(which)];
    if (values.size() < to + size) values.resize(2 * (to + size));
    const float* from = leaf.layer->field(which) + begin;
    float* out = values.data() + to;
    const float offset =
        which <= LayerFeet::kZ ? leaf.offset[static_cast<std::size_t>(which)] : 0.0F;
    for (std::size_t n = 0; n < size; ++n) out[n] = from[n] + offset;
  }
  if (is_cut) {
    for (std::size_t n = to; n < to + size; ++n) {
      bool is_inner = true;
      for (int axis = 0; axis < 3; ++axis) {
        const float below = field(axis)[n] - layer_ * field(LayerFeet::kNormalX + axis)[n];
        is_inner &= std::abs(below) < inner;
      }
      if (is_inner) field(LayerFeet::kX)[n] = kNowhere;
    }
  }
  count_ += static_cast<int>(size);
}

LayerJob TileFeet::job_for(const std::array<float, 3>& first, float step) {
  assert(count_ > 0 && count_ % kRowNodes == 0);
  LayerJob job{};
  for (int axis = 0; axis < 3; ++axis) {
    auto& kept = kept_[static_cast<std::size_t>(axis)];
    if (kept.size() < static_cast<std::size_t>(count_))
      kept.resize(static_cast<std::size_t>(count_));
    job.foot[axis] = field(axis);
    job.normal[axis] = field(LayerFeet::kNormalX + axis);
    job.first[axis] = first[static_cast<std::size_t>(axis)];
    job.kept[axis] = kept.data();
  }
  if (which_.size() < static_cast<std::size_t>(count_))
    which_.resize(static_cast<std::size_t>(count_));
  job.which = which_.data();
  job.bend = field(LayerFeet::kBend);
  job.count = count_;
  job.step = step;
  job.layer = layer_;
  job.patch = patch_;
  return job;
}

}  // namespace argil
