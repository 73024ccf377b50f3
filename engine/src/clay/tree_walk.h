// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "argil/engine/storage.h"

#include "clay/tile_signs.h"
#include "field/vdb.h"

namespace argil {

/// Shows a tree branch by branch, in memory that is used again for the next.
class TreeWalk {
 public:
  /// `signs` of its tiles; null: they are right as they are.
  TreeWalk(const VdbTree& tree, TileSigns* signs, LevelVisitor& to)
      : tree_(&tree), signs_(signs), to_(&to) {}

  void show_tiles_of_root();

  /// With all that is below it.
  void show(const VdbUpperNode& upper);

 private:
  template <class Node>
  StoredBranch branch_of(const Node& node);
  void find_leaves(const VdbLowerNode& lower);

  const VdbTree* tree_;
  TileSigns* signs_;
  LevelVisitor* to_;
  std::array<std::uint64_t, storage::kUpperSlots / 64> children_{};
  std::array<std::uint64_t, storage::kUpperSlots / 64> active_{};
  std::vector<float> values_ = std::vector<float>(storage::kUpperSlots);
  std::vector<LeafView> leaves_;
};

/// All of a tree, as it is.
void show_tree(const VdbTree& tree, LevelVisitor& to);

}  // namespace argil
