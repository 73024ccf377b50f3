// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <optional>
#include <utility>
#include <vector>

#include "argil/engine/window.h"

#include "feet/cluster_list.h"
#include "field/level_stack.h"
#include "window/feet_store.h"
#include "window/window_levels.h"

namespace argil {

/// A leaf's points of the surface are at most this far from its nodes, in voxels: the layer's
/// distance, and what a foot may lie off its node at a kink.
inline constexpr double kBelowVoxels = kLayerVoxels + 2.0;

/// A level's leaves around a window and what of the surface they speak for.
struct FeetRing {
  int level = 0;
  bool is_average = false;  ///< stands in for a finer level
  double voxel_mm = 0.0;
  double reach_mm = 0.0;  ///< beyond a tile's nodes, where the next ring begins
  NodeBox leaves{Coord(0, 0, 0), Coord(-1, -1, -1)};  ///< origins / kLeafSide
};

/// Finds the layers of a ring's leaves as they are asked for, and remembers them for one window.
class RingLayers {
 public:
  RingLayers(const FeetRing& ring, FeetStore& store, LevelReader& reader);

  const FeetRing& ring() const noexcept { return *ring_; }

  /// Of a leaf of the ring, by its origin / kLeafSide; null when it has none.
  const LeafLayers* at(const Coord& leaf);

  /// Whether it was asked for and has none.
  bool is_known_empty(const Coord& leaf) const {
    const auto& known = known_[index_of(leaf)];
    return known && *known == nullptr;
  }

 private:
  std::size_t index_of(const Coord& leaf) const {
    assert(ring_->leaves.has(leaf));
    const std::array<int, 3> n = ring_->leaves.sides();
    const Coord from = leaf - ring_->leaves.low;
    return static_cast<std::size_t>((from.x() * n[1] + from.y()) * n[2] + from.z());
  }

  const FeetRing* ring_;
  FeetStore* store_;
  LevelReader* reader_;
  std::vector<std::optional<const LeafLayers*>> known_;  ///< z fastest
};

/// The rings of a request, without leaves: the finest level speaks for the surface within 12 of its
/// voxels around a tile, coarser ones within 8 of theirs, the last as deep as the request goes.
std::vector<FeetRing> rings_for(const LevelStack& stack, const LevelChoice& levels,
                                const WindowRequest& request);

/// No node of a window says that it is farther from the surface.
double farthest_mm(const LevelStack& stack, const LevelChoice& levels,
                   const WindowRequest& request) noexcept;

/// A tile of a window's lattice: 8^3 nodes, in whose frame, in mm from its centre, feet are
/// collected.
struct TileFrame {
  static constexpr int kSide = 8;
  Vec3 center_mm;
  double half_mm = 0.0;  ///< of its nodes' box
};

/// The feet of one layer of one ring that nodes of a tile may be nearest to.
class TileFeet {
 public:
  /// Those of `layers` on one side whose points of the surface lie within the ring's reach of the
  /// tile, but not as near as `inner_mm` to it (negative: all). `bound_mm`: no node of the tile is
  /// farther from the surface; lowered where the ring says so.
  void collect(RingLayers& layers, std::size_t side, const TileFrame& tile, double inner_mm,
               float& bound_mm);

  bool is_empty() const noexcept { return clusters_.is_empty(); }

  /// What a block of the tile, from the node `first`, asks of them; `labels` as LayerJob has them.
  /// Refers to this and to `labels`.
  LayerJob job_for(const std::array<float, 3>& first, float step, std::uint64_t& labels);

 private:
  /// Which points of the surface the ring speaks for, in mm along each axis from the centre.
  struct Shell {
    float outer;
    float inner;  ///< -infinite: none are left out
  };
  struct Leaf {
    const LayerFeet* layer;
    Coord origin;
    std::array<float, 3> offset;
    float square;  ///< of how near any of its feet is to some node of the tile
  };
  void list(RingLayers& layers, std::size_t side, const TileFrame& tile, const Shell& shell,
            const NodeBox& leaves, const NodeBox& former, float bound);
  void list_leaf(const Leaf& leaf, const Shell& shell, float half);
  void take(const Leaf& leaf, float half, const Shell& shell, float& bound);
  static ClusterSquares measure(const Leaf& leaf, float half, const Shell& shell);
  void lower(const ClusterSquares& clusters, float& bound) const;
  void append(const Leaf& leaf, std::size_t cluster);
  void cut_last(float inner);

  int level_ = 0;
  std::size_t side_ = 0;
  float layer_ = 0.0F;
  float patch_ = 0.0F;
  std::vector<Leaf> leaves_;
  ClusterList clusters_;
  /// Clusters that have lost some feet: which, and where in `cut_values_` the rest is.
  std::vector<std::pair<std::size_t, std::size_t>> cut_;
  std::vector<float> cut_values_;
};

}  // namespace argil
