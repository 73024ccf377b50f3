// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "argil/engine/window.h"

#include "window/feet_store.h"
#include "window/tile_feet.h"
#include "window/window_levels.h"

namespace argil {

/// Makes windows of a clay and keeps what of the last one still holds. The lattice of a window's
/// nodes is cut into tiles of 8^3 nodes, and these into blocks of 4^3; what a block's nodes are
/// depends on the clay and the block alone, so that a kept one has the bits of a fresh one.
///
/// How      docs/forces.md, "Windows".
/// Threads  one at a time; allocates. When memory ends, all that was kept is forgotten.
class WindowTiles {
 public:
  /// Writes the nodes `box` of the lattice of request.voxel_mm, z fastest; `request` was checked.
  /// Returns the distance_error_mm.
  double fill(const Clay& clay, const WindowRequest& request, const NodeBox& box,
              std::span<float> out);

 private:
  static constexpr int kSide = TileFrame::kSide;
  static constexpr std::size_t kNodes = 512;
  static constexpr std::size_t kBlocks = 8;  ///< block 4 i + 2 j + k
  static constexpr std::size_t kParts = 8;   ///< of a block, 2^3 nodes each, in the same order

  struct Tile {
    /// By block: what its nodes hold, x slowest.
    std::array<std::array<float, LayerJob::kNodes>, kBlocks> distance;
    /// By block and then by its 2^3 parts: the longest of the ways over the nearest feet. Feet that
    /// are farther from all nodes of a part do not concern them.
    std::array<std::array<float, kParts>, kBlocks> bound{};
    float longest = 0.0F;  ///< no bound of a block is longer
    /// By block: the labels of all clusters that may have a nearest foot.
    std::array<std::uint64_t, kBlocks> labels{};
    std::array<float, kNodes> near;  ///< what the levels say, x slowest
    std::uint8_t made = 0;           ///< blocks that hold
    bool is_read = false;            ///< `near` holds
    bool is_far = false;             ///< nothing is within the band
    int coarsest = 0;                ///< the coarsest level that was read for it
  };

  /// What all tiles have in common.
  struct Lattice {
    LevelChoice levels;
    double voxel_mm = 0.0;
    double depth_mm = 0.0;
    double limit_mm = 0.0;  ///< no node is farther
  };

  /// What the nodes of a block that lie beyond a layer are told.
  struct BlockWork {
    std::uint64_t labels;
    std::array<float, LayerJob::kNodes> bound;
    std::array<float, LayerJob::kNodes> distance;
  };

  void follow(const Clay& clay);
  void set_lattice(const LevelStack& stack, const WindowRequest& request);
  void move_to(const NodeBox& tiles);
  void place_rings();
  void forget_blocks(const std::vector<FeetChange>& changes);
  void forget_blocks_near(Tile& tile, const TileFrame& frame, const FeetRing& ring,
                          const Box3& feet, std::uint64_t labels) const;
  bool concerns(const std::array<float, kParts>& within, std::size_t block,
                const PointBox& feet) const;
  void forget_near(LevelReader& reader);
  bool is_near_touched(const Tile& tile, const TileFrame& frame) const;
  void read_near(LevelReader& reader, const Coord& at, Tile& tile);
  void make_missing(LevelReader& reader, const NodeBox& box);
  void make_blocks(std::vector<RingLayers>& layers, const Coord& at, unsigned blocks, Tile& tile);
  unsigned sides_of(const Tile& tile, std::size_t block) const;
  void ask_layers(std::vector<RingLayers>& layers, std::size_t side, const TileFrame& frame,
                  unsigned blocks);
  void finish_block(std::size_t block, Tile& tile) const;
  double inner_mm(std::size_t ring) const;
  TileFrame frame_of(const Coord& at) const;
  std::size_t index_of(const Coord& at) const;
  double error_mm(LevelReader& reader, const NodeBox& box);
  void write(const NodeBox& box, std::span<float> out);

  std::uint64_t clay_ = 0;
  std::uint64_t revision_ = 0;
  double finest_mm_ = 0.0;
  std::vector<LeafChange> changes_;  ///< of the clay since the last window
  FeetStore feet_;
  Lattice lattice_;
  NodeBox box_{Coord(0, 0, 0), Coord(-1, -1, -1)};  ///< of the tiles
  std::vector<std::unique_ptr<Tile>> tiles_;        ///< z fastest
  std::vector<FeetRing> rings_;                     ///< the finest first
  std::vector<TileFeet> collected_;                 ///< by ring, for the tile in hand
  std::array<std::array<BlockWork, kBlocks>, 2> work_;
  std::vector<float> support_;
  std::vector<float> coarser_;
  ResampleScratch resample_;
};

}  // namespace argil
