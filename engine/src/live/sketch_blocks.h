// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "argil/engine/clay.h"
#include "argil/engine/display_surface.h"

#include "field/leaf_change.h"
#include "field/leaf_map.h"
#include "live/drawn_by_leaf.h"
#include "live/seam.h"
#include "surface/block_surface.h"

namespace argil {

/// A clay's drawn blocks, and in their place, where a stroke makes new surface, those of coarser
/// levels of it that take the stroke in a clay of their own. A block of the clay is drawn as long
/// as no value near the surface in it differs; between both a seam closes what is drawn.
///
/// Threads      one; inside, TBB.
/// Determinism  the same bits for any number of threads.
class SketchBlocks {
 public:
  /// All must stay, `before` and `shown` as they are. `now` is as `before` yet, `level` in the
  /// clay's numbers its finest; `shown` hides no leaf of it.
  SketchBlocks(const DisplaySurface& shown, const Clay& before, const Clay& now, int level);

  /// Brings blocks and seam up to date with `now`. `changes`: of it since the last update; nothing:
  /// all may have changed, and all is drawn from it from now on. Returns how many blocks were
  /// extracted.
  std::int64_t update(const std::optional<std::vector<LeafChange>>& changes, BlockLists& lists);

  DisplayBlock block(const BlockId& id) const;

 private:
  using Edges = std::vector<BorderEdge>;
  /// A bit for each of the eight of a leaf: 4 i + 2 j + k.
  using Octants = std::uint8_t;
  static constexpr Octants kAllOctants = 0xff;
  /// A block of the sketch.
  struct Drawn {
    Edges border;
    Octants octants = kAllOctants;
    SeamMesh part;  ///< what is drawn where it is not all
  };

  BlockId name_of(const LeafKey& at) const;
  DisplayBlock sketched(const BlockId& id) const;
  DisplayBlock shown_as(const BlockId& id, const Drawn& drawn) const;
  void take_places(const std::vector<LeafChange>& changes, BlockLists& lists);
  void take(const LeafKey& at, Octants octants, std::vector<BlockId>& given);
  void take_all(BlockLists& lists);
  void draw(const std::vector<LeafKey>& places, BlockLists& lists);
  void erase(const BlockId& id, BlockLists& lists);
  void close(BlockLists& lists);
  Octants taken_of(const LeafKey& at) const;

  const DisplaySurface& shown_;
  const Clay& before_;
  const Clay& now_;
  DrawnByLeaf by_leaf_;
  BlocksOf<DrawnBlock> blocks_;
  std::vector<LeafMap<Octants>> taken_;  ///< what is drawn of the sketch, by level
  std::vector<LeafKey> fresh_;           ///< leaves that gave more in the update at hand
  bool has_all_ = false;
  std::map<BlockId, Drawn> drawn_;
  Border of_sketch_;
  Border of_clay_;
  SeamMesh seam_;
};

}  // namespace argil
