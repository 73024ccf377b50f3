// SPDX-License-Identifier: GPL-3.0-or-later
// The criterion compares a leaf with what interpolation makes of the next coarser level, at the
// nodes within three voxels of the surface: beyond, both say "far" and differ for no reason that
// shows.
#include "edit/prune.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include <tbb/parallel_for.h>

#include "field/leaf_finder.h"
#include "field/nesting.h"
#include "field/prolongation.h"

namespace argil {

/// What was touched and the finer leaves in and beside it: dropping a coarse neighbour or changing
/// a coarse value may leave those unneeded.
bool prune(EditTarget& target, const LeafList& touched) {
  const LevelStack& stack = target.stack;
  Edit edit(target);
  bool any = false;
  for (const auto& [level, touched_origin] : touched) {
    if (stack.has_leaf(level, touched_origin)) {
      edit.want(level, touched_origin);
      any = true;
    }
    const int finer = level - 1;
    if (finer < 0) continue;
    LeafFinder stored(stack, finer);
    const Coord first = (touched_origin << 1).offsetBy(-kLeafSide);
    const openvdb::CoordBBox around(first, first.offsetBy(4 * kLeafSide - 1));
    for_each_leaf_origin(around, [&, finer](const Coord& origin) {
      if (stored.leaf(origin) == nullptr) return;
      edit.want(finer, origin);
      any = true;
    });
  }
  if (!any) return false;
  edit.load();
  edit.prune();
  return edit.commit();
}

void prune_level(LevelStack& stack, int level, double tolerance_mm) {
  assert(level >= 0 && level < stack.top());
  const std::vector<Coord> origins = stack.sorted_origins(level);
  std::vector<std::uint8_t> stays(origins.size(), 1);
  const CoarseningCriterion allows = coarsening_criterion(stack, level, tolerance_mm);
  tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t n) {
    if (level > 0 && required_by_finer(origins[n], [&](const Coord& fine) {
          return stack.has_leaf(level - 1, fine);
        })) {
      return;
    }
    const float* values = values_of(*stack.leaf(level, origins[n]));
    stays[n] = coarser_misses(values, coarse_nodes(stack, level + 1, origins[n]), allows);
  });
  for (std::size_t n = 0; n < origins.size(); ++n) {
    if (stays[n] != 0) continue;
    const float value = values_of(*stack.leaf(level, origins[n]))[0];
    const float band = stack.band_mm(level);
    stack.erase_leaf(level, origins[n], value < 0.0F ? -band : band);
  }
}

void drop_bandless(LevelStack& stack, int level) {
  assert(stack.is_level(level));
  const float band = stack.band_mm(level);
  for (const Coord& origin : stack.sorted_origins(level)) {
    const float* values = values_of(*stack.leaf(level, origin));
    if (has_band(values, band)) continue;
    if (level > 0 && required_by_finer(origin, [&](const Coord& fine) {
          return stack.has_leaf(level - 1, fine);
        })) {
      continue;
    }
    stack.erase_leaf(level, origin, values[0] < 0.0F ? -band : band);
  }
}

}  // namespace argil
