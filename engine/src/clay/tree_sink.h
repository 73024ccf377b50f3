// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "argil/engine/storage.h"

#include "clay/clay_hash.h"
#include "field/vdb.h"

namespace argil {

/// Writes a level or a mask into the tree that holds it.
class TreeSink : public LevelSink {
 public:
  explicit TreeSink(VdbTree& tree) : tree_(tree) {}

  void add_tile(const NodeCoord& origin, float value, bool is_active) override;
  void add_branch(const StoredBranch& branch) override;
  std::vector<float*> add_leaves(std::span<const StoredLeaf> leaves) override;
  void leaf_is_filled(std::size_t) override {}

 protected:
  const std::vector<VdbLeaf*>& leaves() const noexcept { return leaves_; }

 private:
  VdbTree& tree_;
  std::vector<VdbLeaf*> leaves_;  ///< as they were added
};

/// Judges and hashes the leaves of a level as they are filled.
class LevelTreeSink final : public TreeSink {
 public:
  LevelTreeSink(VdbTree& tree, int level)
      : TreeSink(tree), band_(tree.background()), level_(level) {}

  std::vector<float*> add_leaves(std::span<const StoredLeaf> added) override;
  void leaf_is_filled(std::size_t n) override;

  /// False also where a leaf was not filled.
  bool is_sound() const;
  /// In lexicographic order of the leaves' origins.
  LeafHashes sorted_hashes() const;

 private:
  float band_;
  int level_;
  std::vector<char> is_sound_;  ///< of each leaf
  LeafHashes hashes_;           ///< likewise
};

}  // namespace argil
