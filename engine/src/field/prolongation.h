// SPDX-License-Identifier: GPL-3.0-or-later
// How values of a coarser level become those of a finer one.
#pragma once

#include "field/level_stack.h"
#include "field/upsample.h"

namespace argil {

/// The values on the level `coarser` of the 5^3 nodes that span a leaf of the next finer level,
/// interpolated where it has no leaf.
CoarseNodes coarse_nodes(const LevelStack& stack, int coarser, const Coord& origin);

/// False when side * value >= bound at these nodes of a level and between them; `side` is 1 or -1,
/// `bound` above 0. Nothing is interpolated, so that it may be true with none below.
bool may_be_below(const LevelStack& stack, int level, const openvdb::CoordBBox& nodes, float side,
                  float bound);
/// The same of the nodes that coarse_nodes() has.
bool may_coarse_be_below(const LevelStack& stack, int coarser, const Coord& origin, float side,
                         float bound);

/// Whether side * value < bound at one of those nodes.
bool any_coarse_below(const LevelStack& stack, int coarser, const Coord& origin, float side,
                      float bound);

/// The 8^3 values of a leaf that `level` does not store: interpolated from the coarser levels and
/// clamped to the band of `level`.
void prolong_leaf(const LevelStack& stack, int level, const Coord& origin, LeafValues& out);

}  // namespace argil
