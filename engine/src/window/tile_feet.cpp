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

/// The leaves of a ring whose points of the surface may lie within its reach of the tile,
/// and no farther from it than `most_mm`.
NodeBox leaves_within(const FeetRing& ring, const TileFrame& tile, double most_mm) {
  const double reach =
      tile.half_mm + std::min(ring.reach_mm, most_mm) + kBelowVoxels * ring.voxel_mm;
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
  const Shell shell{static_cast<float>(tile.half_mm + ring.reach_mm),
                    inner_mm > 0.0 ? static_cast<float>(inner_mm) : -kInfinity};
  list(ring, side, tile, shell, static_cast<double>(bound_mm));
  if (leaves_.empty()) return;
  // The nearest leaf tells how far the others are worth a look, whose order stays.
  const auto nearest = std::ranges::min_element(leaves_, {}, &Leaf::square);
  lower(clusters_of(*nearest, half, shell), bound_mm);
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
    bool is_inner = true;
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

/// Each node has a foot within the distance of the farthest corners of a cluster and the tile.
void TileFeet::lower(const Clusters& clusters, float& bound) const {
  const float farthest = std::ranges::min(clusters.farthest);
  bound = std::min(bound, layer_ + std::sqrt(farthest) * kRounding);
}

/// Those clusters of a leaf that may be nearest to some node.
void TileFeet::take(const Leaf& leaf, float half, const Shell& shell, float& bound) {
  const Clusters clusters = clusters_of(leaf, half, shell);
  lower(clusters, bound);
  const float within = std::max(bound - layer_, 0.0F);
  const float most = within * within * kRounding;
  std::size_t n = 0;
  while (n < ClusterBoxes::kClusters) {
    const std::size_t begin = n;
    while (n < ClusterBoxes::kClusters && clusters.nearest[n] <= most) ++n;
    if (n == begin) {
      ++n;
      continue;
    }
    const auto to = static_cast<std::size_t>(count_);
    append(leaf, begin, n);
    for (std::size_t cluster = begin; cluster < n; ++cluster) {
      if ((clusters.cut >> cluster & 1U) == 0) continue;
      const auto from = static_cast<std::size_t>(leaf.layer->first[begin]);
      cut(to + static_cast<std::size_t>(leaf.layer->first[cluster]) - from,
          to + static_cast<std::size_t>(leaf.layer->first[cluster + 1]) - from, shell.inner);
    }
  }
}

/// How near and far each cluster is, and how its points of the surface lie to the shell: largest
/// differences along the axes, negative where no axis leads out.
TileFeet::Clusters TileFeet::clusters_of(const Leaf& leaf, float half, const Shell& shell) {
  constexpr std::size_t kClusters = ClusterBoxes::kClusters;
  using Each = std::array<float, kClusters>;
  const ClusterBoxes& feet = leaf.layer->feet;
  const ClusterBoxes& surface = leaf.layer->surface;
  Clusters clusters;
  clusters.nearest.fill(0.0F);
  clusters.farthest.fill(0.0F);
  Each beyond_outer;
  Each beyond_inner;
  Each before_inner;
  beyond_outer.fill(-kInfinity);
  beyond_inner.fill(-kInfinity);
  before_inner.fill(-kInfinity);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float offset = leaf.offset[axis];
    for (std::size_t n = 0; n < kClusters; ++n) {
      const float low = feet.low[axis][n] + offset;
      const float high = feet.high[axis][n] + offset;
      const float off = std::max(std::max(-half - high, low - half), 0.0F);
      const float most = std::max(std::abs(low), std::abs(high)) + half;
      clusters.nearest[n] += off * off;
      clusters.farthest[n] += most * most;
    }
    for (std::size_t n = 0; n < kClusters; ++n) {
      const float low = surface.low[axis][n] + offset;
      const float high = surface.high[axis][n] + offset;
      const float near = std::max(low, -high);  // of its nearest side to the centre
      const float far = std::max(-low, high);   // of the other
      beyond_outer[n] = std::max(beyond_outer[n], near - shell.outer);
      beyond_inner[n] = std::max(beyond_inner[n], near - shell.inner);
      before_inner[n] = std::max(before_inner[n], far - shell.inner);
    }
  }
  for (std::size_t n = 0; n < kClusters; ++n) {
    const bool is_left_out = beyond_outer[n] > 0.0F || before_inner[n] < 0.0F;
    const bool is_cut = beyond_inner[n] < 0.0F;
    if (is_left_out) clusters.nearest[n] = kInfinity;
    if (is_left_out || is_cut) clusters.farthest[n] = kInfinity;
    clusters.cut |= (is_cut ? 1U : 0U) << n;
  }
  return clusters;
}

void TileFeet::append(const Leaf& leaf, std::size_t first_cluster, std::size_t end_cluster) {
  const auto begin = static_cast<std::size_t>(leaf.layer->first[first_cluster]);
  const auto size = static_cast<std::size_t>(leaf.layer->first[end_cluster]) - begin;
  const auto to = static_cast<std::size_t>(count_);
  if (values_.front().size() < to + size) {
    for (auto& values : values_) values.resize(2 * (to + size));
  }
  for (int which = 0; which < LayerFeet::kFields; ++which) {
    const float* from = leaf.layer->field(which) + begin;
    float* out = field(which) + to;
    if (which <= LayerFeet::kZ) {
      const float offset = leaf.offset[static_cast<std::size_t>(which)];
      for (std::size_t n = 0; n < size; ++n) out[n] = from[n] + offset;
    } else {
      std::copy_n(from, size, out);
    }
  }
  count_ += static_cast<int>(size);
}

/// Puts feet that are left out where they are nearest to nothing.
void TileFeet::cut(std::size_t begin, std::size_t end, float inner) {
  for (std::size_t n = begin; n < end; ++n) {
    bool is_inner = true;
    for (int axis = 0; axis < 3; ++axis) {
      const float below = field(axis)[n] - layer_ * field(LayerFeet::kNormalX + axis)[n];
      is_inner = is_inner && std::abs(below) < inner;
    }
    if (is_inner) field(LayerFeet::kX)[n] = kNowhere;
  }
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
