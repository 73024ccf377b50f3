// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include "argil/core/triangle_mesh.h"

#include "leaf_change.h"
#include "level_stack.h"
#include "place_map.h"
#include "surface_block.h"

namespace argil {

/// The surface of a LevelStack, block by block: what Surface is for a Clay.
///
/// Threads      one; nobody may write the stack during a call. Inside, TBB.
/// Determinism  the same blocks and the same welded mesh, bit for bit, for any number of threads
///              and whatever updates led there: SurfaceUpdate.EqualsARebuildBitForBit.
class BlockSurface {
 public:
  using Path = BlockExtractor::Path;
  /// `path` other than fastest is for tests.
  explicit BlockSurface(Path path = Path::fastest) : path_(path) {}

  /// Extracts everything anew. Returns the number of blocks extracted.
  std::int64_t rebuild_all(const LevelStack& stack);

  /// Extracts what can see one of the changed nodes. `changes` must name every leaf that differs
  /// from the stack as last given; order and repeats do not matter. The stack must be nested and
  /// balanced: a block reads its own level, the next finer and the next coarser one, no others.
  /// Returns the number of blocks extracted.
  /// Cost  linear in the blocks within reach of the changes; a coarse change makes the finer blocks
  ///       that read coarser values compare the insides of their nodes, about a tenth of
  ///       extracting.
  std::int64_t update(const LevelStack& stack, std::span<const LeafChange> changes);

  std::int64_t triangle_count() const noexcept { return triangles_; }

  /// What the blocks of each level see of some changes.
  using Marks = std::vector<PlaceMap<std::uint8_t>>;

  /// One mesh: vertices in order of level, place and making, merged by lattice edge.
  TriangleMesh weld() const;

 private:
  using Blocks = std::unordered_map<LeafPlace, SurfaceBlock, LeafPlaceHash>;

  struct Job {
    LeafPlace where;
    bool only_if_signs_changed = false;
    SurfaceBlock* block = nullptr;  ///< the one there is
  };
  using Extractors = tbb::enumerable_thread_specific<BlockExtractor>;
  /// What is to be done at a place that sees this (Seen) of the changes.
  std::optional<Job> job_at(const LevelStack& stack, const LeafPlace& where, int seen);
  std::int64_t run(const LevelStack& stack, std::span<const Job> jobs);
  Extractors& extractors_for(const LevelStack& stack);

  Path path_;
  Blocks blocks_;
  std::unique_ptr<Extractors> extractors_;  ///< kept: their scratch is large
  const LevelStack* extractors_of_ = nullptr;
  std::int64_t triangles_ = 0;
};

}  // namespace argil
