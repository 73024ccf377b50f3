// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include "argil/core/progress.h"
#include "argil/core/triangle_mesh.h"

#include "field/leaf_change.h"
#include "field/leaf_map.h"
#include "surface/block_extractor.h"
#include "surface/drawn_block.h"
#include "surface/shown_leaves.h"

namespace argil {

/// Of each level the leaves, there or not, whose block sees one of the changes, as a value or a
/// side of a node that it reads: they have another value than 0. The field between nodes changes in
/// no other leaf's cells.
std::vector<LeafMap<std::uint8_t>> leaves_that_see(const ShownLeaves& leaves,
                                                   std::span<const LeafChange> changes);

/// The surface of a LevelStack, or of the leaves of it that a choice shows, block by block. A Block
/// is what is kept of a SurfaceBlock: that itself to be welded, or a DrawnBlock.
///
/// Threads      one; nobody may write stack or choice during a call. Inside, TBB.
/// Determinism  the same blocks, bit for bit, for any number of threads and whatever updates led
///              there: SurfaceUpdateProperty.EqualsARebuildBitForBit.
template <class Block>
class BlocksOf {
 public:
  using Path = BlockExtractor::Path;
  using Blocks = std::unordered_map<LeafKey, Block, LeafKeyHash>;
  /// `path` other than fastest is for tests.
  explicit BlocksOf(Path path = Path::fastest) : path_(path) {}

  /// Extracts everything. Returns the number of blocks extracted.
  std::int64_t rebuild_all(const ShownLeaves& leaves);
  /// The same; nothing, and no block left, when `progress` stopped it.
  std::optional<std::int64_t> rebuild_all(const ShownLeaves& leaves, const Progress& progress);

  /// Extracts what can see one of the changed nodes. `changes` must name every leaf that differs
  /// from the leaves as last given; order and repeats do not matter. They must be nested and
  /// balanced: a block reads its own level, the next finer and the next coarser one, no others.
  /// Returns the number of blocks extracted.
  /// Cost  linear in the blocks within reach of the changes; a coarse change makes the finer blocks
  ///       that read coarser values compare the insides of their nodes, about a tenth of
  ///       extracting.
  std::int64_t update(const ShownLeaves& leaves, std::span<const LeafChange> changes);

  /// Forgets all blocks.
  void clear();

  /// Instead of rebuild_all: makes only blocks that see a change, from the next update on. All
  /// others are as in the leaves of now, whose surface somebody else has.
  void begin_with_changes(const ShownLeaves& leaves);

  /// Whether some update since then saw to the block of a leaf, or to its leaf's going.
  bool has_seen_to(const LeafKey& at) const {
    const auto level = static_cast<std::size_t>(at.level);
    return level < seen_.size() && seen_[level].get(at.origin) != 0;
  }

  const Blocks& blocks() const noexcept { return blocks_; }
  /// Of a leaf, null where there is none; where it is, it stays for as long as it is there.
  const Block* block(const LeafKey& at) const { return find(at); }
  std::int64_t triangle_count() const noexcept { return triangles_; }

  /// What the last call did to blocks with triangles: those that came or of which Block::assign
  /// said that they changed, and those that went. Empty for a Block without kIsListed.
  const std::vector<LeafKey>& changed() const noexcept { return changed_; }
  const std::vector<LeafKey>& gone() const noexcept { return gone_; }

 private:
  struct Job {
    LeafKey where;
    bool only_if_signs_changed = false;
    Block* block = nullptr;  ///< the one there is
  };
  struct Done {
    bool is_extracted = false;
    bool is_absent = false;
    bool differs = false;
    bool was_drawn = false;
  };
  using Extractors = tbb::enumerable_thread_specific<BlockExtractor>;
  /// What is to be done for a leaf that sees this (SeenChange) of the changes.
  std::optional<Job> job_at(const ShownLeaves& leaves, const LeafKey& where, int seen);
  /// Whether a block that is not there may be one that was not made yet.
  bool is_first_change(const LeafKey& at) const { return !seen_.empty() && !has_seen_to(at); }
  void drop_without_leaf(const ShownLeaves& leaves);
  std::vector<Job> all_jobs(const ShownLeaves& leaves);
  std::int64_t run(const ShownLeaves& leaves, std::span<const Job> jobs) {
    return *run(leaves, jobs, {});
  }
  std::optional<std::int64_t> run(const ShownLeaves& leaves, std::span<const Job> jobs,
                                  const Progress& progress);
  Done work(BlockExtractor& extractor, const Job& job, Block& fresh) const;
  void list(const LeafKey& where, const Done& done, bool is_drawn);
  Extractors& extractors_for(const ShownLeaves& leaves);

  Block* find(const LeafKey& at) const {
    const auto level = static_cast<std::size_t>(at.level);
    return level < index_.size() ? index_[level].get(at.origin) : nullptr;
  }
  Block& insert(const LeafKey& at, Block&& block);
  typename Blocks::iterator erase(typename Blocks::iterator at);

  Path path_;
  Blocks blocks_;
  std::vector<LeafMap<Block*>> index_;  ///< of blocks_, by level: a lookup in a tenth of the time
  std::unique_ptr<Extractors> extractors_;  ///< kept: their scratch is large
  std::optional<ShownLeaves> extractors_of_;
  std::int64_t triangles_ = 0;
  std::vector<LeafKey> changed_;
  std::vector<LeafKey> gone_;
  std::vector<LeafMap<std::uint8_t>> seen_;  ///< by level; empty after rebuild_all
};

/// What Surface is for a Clay.
class BlockSurface : public BlocksOf<SurfaceBlock> {
 public:
  using BlocksOf::BlocksOf;

  /// One mesh: vertices in order of level, origin and making, merged by lattice edge.
  TriangleMesh weld() const { return *weld({}); }
  /// The same; nothing when `progress` stopped it.
  std::optional<TriangleMesh> weld(const Progress& progress) const;
};

extern template class BlocksOf<SurfaceBlock>;
extern template class BlocksOf<DrawnBlock>;

}  // namespace argil
