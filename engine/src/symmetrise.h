// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "edit.h"
#include "history.h"
#include "lattice_symmetry.h"

namespace argil {

/// Makes a clay symmetric to the bit: of all images of a place, the one that stands for them gives
/// the others its leaves and values. What an edit leaves on two sides differs by the rounding of
/// sums and by rows of nodes, since a mirror plane leads through nodes and leaves of eight nodes
/// are not mirrored onto leaves. The sink hears of every leaf that changes.
///
/// Values move within the tolerance of their levels where the clay was symmetric but for that; a
/// node where its level ends, which only one of two images stores, becomes what the coarser level
/// says, which stores both.
void symmetrise_all(EditTarget& target, const LatticeSymmetry& symmetry);

/// The same of what a step touched, which was done alike on all sides, if all of that was symmetric
/// before: within 1.5 voxels of the surface no value differed from that of an image by more
/// than two tolerances, and the mask is the same. Else nothing, and false.
bool symmetrise(EditTarget& target, const LatticeSymmetry& symmetry, const UndoStep& step);

}  // namespace argil
