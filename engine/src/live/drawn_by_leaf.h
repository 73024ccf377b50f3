// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "argil/engine/display_surface.h"

#include "field/leaf_change.h"
#include "field/leaf_map.h"

namespace argil {

/// What an update did to blocks, as DisplaySurface lists it; both in order.
struct BlockLists {
  std::vector<BlockId> changed;
  std::vector<BlockId> gone;
};

/// The drawn blocks of a clay by the leaf of a preview that they lie in, which has the clay's
/// levels from one on: all of finer levels by that level's leaf, others by their own.
class DrawnByLeaf {
 public:
  struct Group {
    LeafKey around;
    std::vector<BlockId> blocks;
  };

  /// `shown` must not be updated afterwards. Cost  linear in its blocks.
  DrawnByLeaf(const DisplaySurface& shown, int level);

  /// Levels of leaves are those of the preview; of blocks, the clay's.
  int level() const noexcept { return level_; }
  LeafKey leaf_around(const BlockId& id) const;

  /// One for each leaf that has blocks in it.
  const std::vector<Group>& groups() const noexcept { return groups_; }
  /// The number of a leaf's group, or that of groups() where it has none.
  std::size_t group_of(const LeafKey& at) const;

 private:
  int level_;
  std::vector<LeafMap<std::size_t>> numbers_;  ///< from 1 on, by level of the preview
  std::vector<Group> groups_;
};

}  // namespace argil
