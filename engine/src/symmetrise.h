// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "edit.h"
#include "history.h"
#include "lattice_symmetry.h"

namespace argil {

/// Makes clay symmetric to the bit: of all images of a place, the one that stands for them gives
/// the others its leaves and values. What an edit leaves on two sides differs by the rounding of
/// sums and by rows of nodes, since a mirror plane leads through nodes and leaves of eight nodes
/// are not mirrored onto leaves.
///
/// `places` (level, place), images and the coarser places above are added. The sink hears of every
/// leaf that changes. Values move within the tolerance of their levels where the clay was symmetric
/// but for that; a node at the border of its level, which only one of two images stores, becomes
/// what the coarser level says, which stores both.
void symmetrise(EditTarget& target, const LatticeSymmetry& symmetry,
                const std::vector<std::pair<int, Coord>>& places);

/// Whether the clay was symmetric at these places and their images before the step, and is held
/// symmetrically: within 1.5 voxels of the surface no value differs from that of the node that
/// stands for it by more than two tolerances. Then what the step did there, being symmetric too,
/// may be made so to the bit.
bool was_symmetric(const EditTarget& target, const LatticeSymmetry& symmetry, const UndoStep& step);

}  // namespace argil
