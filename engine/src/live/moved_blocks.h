// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "argil/engine/clay.h"
#include "argil/engine/display_surface.h"

#include "field/leaf_change.h"
#include "live/drawn_by_leaf.h"

namespace argil {

/// A clay's own drawn blocks while coarser levels of it, in a clay of their own, take a stroke that
/// displaces its surface: each vertex goes to where those levels have the value that they had at
/// the vertex before. What lies finer than they are is carried along, and no seam arises: where a
/// vertex goes depends on its place and the levels alone, so all blocks around it agree.
///
/// Threads      one; inside, TBB.
/// Determinism  the same bits for any number of threads and whatever updates led there.
class MovedBlocks {
 public:
  /// Both clays and `shown` must stay, `before` and `shown` as they are. `now` has the levels of
  /// `before`, `level` in the clay's numbers its finest.
  MovedBlocks(const DisplaySurface& shown, const Clay& before, const Clay& now, int level);

  /// Brings vertices up to date with `now`. `changes`: of it since the last update; nothing: all
  /// may have changed. Returns how many blocks were looked at. Cost  linear in the vertices in and
  /// around leaves that see a change: bench_preview.
  std::int64_t update(const std::optional<std::vector<LeafChange>>& changes, BlockLists& lists);

  DisplayBlock block(const BlockId& id) const;

 private:
  /// The blocks in one leaf.
  struct Moves {
    std::vector<std::vector<DisplayVertex>> vertices;  ///< empty: as the clay has them
    std::vector<LeafKey> reads;  ///< leaves of `now` whose cells they passed, in order
    std::vector<bool> differs;   ///< after an update: from what they were before
    bool is_followed = false;    ///< was looked at by some update
    bool is_to_do = false;
  };

  void choose(const std::vector<LeafChange>& changes);
  void to_do(std::size_t group);

  const DisplaySurface& shown_;
  const Clay& before_;
  const Clay& now_;
  DrawnByLeaf by_leaf_;
  std::vector<Moves> moves_;  ///< by group of by_leaf_
  std::vector<std::size_t> followed_;
  std::vector<std::size_t> jobs_;
};

}  // namespace argil
