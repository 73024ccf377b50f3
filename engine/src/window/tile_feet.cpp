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
/// How far a ring reaches, in its voxels: the finest far enough that most of what a tool of eight
/// nodes across asks is told by it (WindowForceError.IsSmallOnRoughness).
constexpr double kFirstRing = 12.0;
constexpr double kOtherRings = 8.0;

/// How far a foot may lie off the nodes of its leaf, in voxels.
constexpr double kFootOff = kBelowVoxels - kLayerVoxels;

/// The leaves of a ring whose points of the surface may lie within its reach of the tile, and whose
/// feet are no farther from it than `most_mm`.
NodeBox leaves_within(const FeetRing& ring, const TileFrame& tile, double most_mm) {
  const double of_surface = ring.reach_mm + kBelowVoxels * ring.voxel_mm;
  const double of_feet = most_mm + kFootOff * ring.voxel_mm;
  const double reach = tile.half_mm + std::min(of_surface, of_feet);
  const NodeBox nodes = covering_nodes(tile.center_mm, reach, ring.voxel_mm);
  return {Coord::maxComponent(nodes.low >> 3, ring.leaves.low),
          Coord::minComponent(nodes.high >> 3, ring.leaves.high)};
}

/// The leaves around a tile that are the first to be asked.
NodeBox first_leaves(const FeetRing& ring, const TileFrame& tile) {
  const NodeBox nodes = covering_nodes(tile.center_mm, tile.half_mm, ring.voxel_mm);
  return {nodes.low >> 3, nodes.high >> 3};
}

NodeBox common(const NodeBox& a, const NodeBox& b) noexcept {
  return {Coord::maxComponent(a.low, b.low), Coord::minComponent(a.high, b.high)};
}

/// Calls visit(node) for each node of a box that is not in the other, z fastest.
template <class Visit>
void for_each_outside(const NodeBox& box, const NodeBox& other, const Visit& visit) {
  for (int x = box.low.x(); x <= box.high.x(); ++x) {
    for (int y = box.low.y(); y <= box.high.y(); ++y) {
      const bool is_row_in =
          x >= other.low.x() && x <= other.high.x() && y >= other.low.y() && y <= other.high.y();
      for (int z = box.low.z(); z <= box.high.z(); ++z) {
        if (is_row_in && z >= other.low.z() && z <= other.high.z()) {
          z = other.high.z();
          continue;
        }
        visit(Coord(x, y, z));
      }
    }
  }
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

RingLayers::RingLayers(const FeetRing& ring, FeetStore& store, LevelReader& reader)
    : ring_(&ring), store_(&store), reader_(&reader), known_(ring.leaves.count()) {}

const LeafLayers* RingLayers::at(const Coord& leaf) {
  auto& known = known_[index_of(leaf)];
  if (!known) known = store_->layers(*reader_, {ring_->level, leaf << 3, ring_->is_average});
  return *known;
}

/// Leaves are asked from the tile outwards, shell by shell, so that those are never found which
/// nearer ones show to be too far. Their order depends on where they and the tile are alone.
void TileFeet::collect(RingLayers& layers, std::size_t side, const TileFrame& tile, double inner_mm,
                       float& bound_mm) {
  const FeetRing& ring = layers.ring();
  level_ = ring.level;
  side_ = side;
  layer_ = static_cast<float>(kLayerVoxels * ring.voxel_mm);
  patch_ = static_cast<float>(kPatchVoxels * ring.voxel_mm);
  clusters_.clear();
  cut_.clear();
  cut_values_.clear();
  const auto half = static_cast<float>(tile.half_mm);
  // A way over a foot is no shorter than that to the surface below it.
  if (static_cast<double>(bound_mm) < inner_mm - tile.half_mm) return;
  const Shell shell{static_cast<float>(tile.half_mm + ring.reach_mm),
                    inner_mm > 0.0 ? static_cast<float>(inner_mm) : -kInfinity};
  NodeBox former{Coord(0, 0, 0), Coord(-1, -1, -1)};
  for (NodeBox leaves = first_leaves(ring, tile);; leaves = leaves.grown(1)) {
    const NodeBox within =
        leaves_within(ring, tile, std::max(static_cast<double>(bound_mm - layer_), 0.0));
    list(layers, side, tile, shell, common(leaves, within), former, bound_mm);
    if (!leaves_.empty()) {
      // The nearest leaf tells how far the others are worth a look, whose order stays.
      lower(measure(*std::ranges::min_element(leaves_, {}, &Leaf::square), half, shell), bound_mm);
      for (const Leaf& leaf : leaves_) {
        const float most = std::max(bound_mm - layer_, 0.0F);
        if (leaf.square <= most * most * kRounding) take(leaf, half, shell, bound_mm);
      }
    }
    if (leaves.has(within.low) && leaves.has(within.high)) break;
    former = leaves;
  }
  for (const auto& [cluster, at] : cut_) {
    clusters_.cluster(cluster).values = cut_values_.data() + at;
  }
  clusters_.close();
}

/// Those of some leaves that have feet of that side for the shell, without the `former` ones.
void TileFeet::list(RingLayers& layers, std::size_t side, const TileFrame& tile, const Shell& shell,
                    const NodeBox& leaves, const NodeBox& former, float bound) {
  const FeetRing& ring = layers.ring();
  const auto half = static_cast<float>(tile.half_mm);
  const auto off = static_cast<float>(kFootOff * ring.voxel_mm);
  const float most = std::max(bound - layer_, 0.0F);
  PointBox nodes;  // and how far from them feet may be
  nodes.low.fill(-off);
  nodes.high.fill(static_cast<float>((kLeafSide - 1) * ring.voxel_mm) + off);
  leaves_.clear();
  for_each_outside(leaves, former, [&](const Coord& at) {
    if (layers.is_known_empty(at)) return;
    const Vec3 offset = node_mm(at << 3, ring.voxel_mm) - tile.center_mm;
    const std::array<float, 3> from = {static_cast<float>(offset.x), static_cast<float>(offset.y),
                                       static_cast<float>(offset.z)};
    if (square_of(nodes, from, half) > most * most * kRounding) return;
    const LeafLayers* found = layers.at(at);
    if (found == nullptr || (*found)[side].is_empty()) return;
    list_leaf({&(*found)[side], at << 3, from, 0.0F}, shell, half);
  });
}

void TileFeet::list_leaf(const Leaf& leaf, const Shell& shell, float half) {
  const PointBox& surface = leaf.layer->all_surface;
  bool is_out = false;
  bool is_inner = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float low = surface.low[axis] + leaf.offset[axis];
    const float high = surface.high[axis] + leaf.offset[axis];
    is_out |= low > shell.outer || high < -shell.outer;
    is_inner &= low > -shell.inner && high < shell.inner;
  }
  if (is_out || is_inner) return;
  leaves_.push_back(leaf);
  leaves_.back().square = square_of(leaf.layer->all_feet, leaf.offset, half);
}

/// Each node has a foot within the distance of the farthest corners of a cluster and the tile.
void TileFeet::lower(const ClusterSquares& clusters, float& bound) const {
  const float farthest = *std::ranges::min_element(clusters.farthest);
  bound = std::min(bound, layer_ + std::sqrt(farthest) * kRounding);
}

ClusterSquares TileFeet::measure(const Leaf& leaf, float half, const Shell& shell) {
  ClusterSquares squares;
  row_loops().measure_clusters({&leaf.layer->feet,
                                &leaf.layer->surface,
                                {leaf.offset[0], leaf.offset[1], leaf.offset[2]},
                                half,
                                shell.outer,
                                shell.inner},
                               squares);
  return squares;
}

/// Those clusters of a leaf that may be nearest to some node.
void TileFeet::take(const Leaf& leaf, float half, const Shell& shell, float& bound) {
  const ClusterSquares clusters = measure(leaf, half, shell);
  lower(clusters, bound);
  const float within = std::max(bound - layer_, 0.0F);
  const float most = within * within * kRounding;
  for (std::size_t n = 0; n < ClusterBoxes::kClusters; ++n) {
    if (!(clusters.nearest[n] <= most)) continue;
    append(leaf, n);
    if ((clusters.cut >> n & 1U) != 0) cut_last(shell.inner);
  }
}

void TileFeet::append(const Leaf& leaf, std::size_t cluster) {
  const LayerFeet& layer = *leaf.layer;
  const int begin = layer.first[cluster];
  clusters_.append({layer.values.data() + begin,
                    layer.count(),
                    layer.first[cluster + 1] - begin,
                    label_of(level_, leaf.origin, side_, cluster),
                    {leaf.offset[0], leaf.offset[1], leaf.offset[2]}},
                   layer.feet, cluster);
}

/// Puts feet of the last cluster that are left out where they are nearest to nothing.
void TileFeet::cut_last(float inner) {
  LayerCluster& cluster = clusters_.cluster(clusters_.size() - 1);
  const auto count = static_cast<std::size_t>(cluster.count);
  const std::size_t at = cut_values_.size();
  bool is_cut = false;
  for (int field = 0; field < LayerFeet::kFields; ++field) {
    const float* from = cluster.values + static_cast<std::ptrdiff_t>(field) * cluster.stride;
    cut_values_.insert(cut_values_.end(), from, from + count);
  }
  for (std::size_t n = at; n < at + count; ++n) {
    bool is_inner = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float below = cut_values_[n + axis * count] + cluster.offset[axis] -
                          layer_ * cut_values_[n + (3 + axis) * count];
      is_inner = is_inner && std::abs(below) < inner;
    }
    if (is_inner) cut_values_[n] = kNowhere;
    is_cut |= is_inner;
  }
  if (!is_cut) {
    cut_values_.resize(at);
    return;
  }
  clusters_.set_last_unsure();
  cluster.stride = cluster.count;
  cut_.emplace_back(clusters_.size() - 1, at);
}

LayerJob TileFeet::job_for(const std::array<float, 3>& first, float step, std::uint64_t& labels) {
  return clusters_.job_for(first, step, layer_, patch_, labels);
}

}  // namespace argil
