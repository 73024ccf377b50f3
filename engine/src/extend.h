// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "fast_march.h"
#include "level_edit.h"
#include "vdb.h"

namespace argil {

/// Nodes farther than this from every changed node keep their bits: a band reaches no farther.
inline constexpr int kReach = kHalfWidthVoxels + 1;

enum class Seeds {
  keep,       ///< nodes next to the surface keep their values unless off by more than a factor 2
  normalise,  ///< they are measured anew, as far as an end of a cut lattice edge of theirs changed:
              ///< the others' distance is no better for being measured again
};

/// Makes one level a distance again after an edit moved or bent its surface: nodes within kReach of
/// a changed node (now != before, or any node of a leaf with `renew`) are solved outward from the
/// nodes next to a sign change and the restricted ones, which stay; every other node keeps its
/// bits. Signs are those of `now`. Writes only leaves of `edit`.
///
/// Accuracy     that of fast_march; seeds by value / |gradient| where the field is smooth (second
///              differences below a quarter of the gradient), else by 1/d^2 = sum over axes of
///              1/cut^2: exact for planes, off by h^2 / 2R otherwise.
/// Determinism  chunks are solved independently from one state: same bits for any thread count.
void extend(LevelEdit& edit, Seeds seeds);

/// Measures every node of the leaves with `renew` anew, seeds included, from what stands around
/// each: for leaves that are a distance nearly, and whose neighbours are. Accuracy and determinism
/// as extend().
void renew(LevelEdit& edit);

/// The distance of node `n` of the block to the surface, from the cuts on the lattice edges to its
/// six neighbours; signed like the node. Zero when no neighbour has the other sign.
float cut_distance(const MarchBlock& block, std::size_t n, int i, int j, int k);

}  // namespace argil
