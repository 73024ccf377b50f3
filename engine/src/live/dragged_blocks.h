// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "argil/core/vec3.h"
#include "argil/engine/display_surface.h"
#include "argil/engine/stroke.h"
#include "argil/engine/tool.h"

#include "action/drag_push.h"
#include "brush/motion.h"
#include "field/mask.h"
#include "live/drawn_by_leaf.h"

namespace argil {

/// A clay's own drawn blocks while a stroke drags its matter along (grab, twist): each vertex goes
/// where the matter under it goes, dab by dab, by the same map that the clay is moved by when the
/// stroke ends. All detail stays, and no seam arises: where a vertex goes depends on its place and
/// the stroke alone, so all blocks around it agree.
///
/// Accuracy     places to 1/1000 of what each dab moves them by; normals by differences of the map.
///              Matter that is pressed into other matter is drawn going through it, out of sight.
/// Threads      one; inside, TBB.
/// Determinism  the same bits for any number of threads and whatever updates led there.
class DraggedBlocks {
 public:
  /// `shown` must stay as it is, and `mask`, which may be null, where it is. `tool`: of an action
  /// that drag_push_of() knows.
  DraggedBlocks(const DisplaySurface& shown, const Tool& tool, const StrokeStyle& style,
                const Mask* mask);

  /// The hand went on, as for Clay::extend_stroke; and the stroke is over.
  void feed(std::span<const StrokeSample> samples);
  void finish();

  /// Takes vertices along the dabs since the last update. Returns how many blocks they met. Cost
  /// 0.3 us for each of their vertices and each dab.
  std::int64_t update(BlockLists& lists);

  DisplayBlock block(const BlockId& id) const;

 private:
  struct Point {
    Vec3 place_mm;
    Vec3 normal;
  };
  struct Moved {
    BlockId id;
    Box3 bounds_mm;             ///< of its vertices as they are now
    std::vector<Point> points;  ///< empty: no dab has met it yet
    std::vector<DisplayVertex> vertices;
    bool differs = false;  ///< since the last update
  };

  void drag(const Motion& motion, Moved& block) const;

  const DisplaySurface& shown_;
  Tool tool_;
  const Mask* mask_;
  std::unique_ptr<const Push> push_;
  DabFeeder feeder_;
  std::vector<Dab> waiting_;
  std::vector<Moved> blocks_;
  std::map<BlockId, std::size_t> numbers_;
};

}  // namespace argil
