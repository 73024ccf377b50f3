// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "edit/edit.h"
#include "edit/history.h"
#include "symmetry/lattice_symmetry.h"

namespace argil {

/// Whether a clay is its own image as far as its leaves keep it: within 1.5 voxels of the surface
/// no value differs from that of an image by more than two tolerances, within 3 voxels by more than
/// half a voxel, and the mask is the same.
bool is_symmetric(const EditTarget& target, const LatticeSymmetry& symmetry);

/// Makes a clay symmetric to the bit: of all images of a leaf, the one that stands for them gives
/// the others its leaves and values. What an edit leaves on two sides differs by the rounding of
/// sums and by rows of nodes, since a mirror plane leads through nodes and leaves of eight nodes
/// are not mirrored onto leaves. The sink hears of every leaf that changes.
///
/// Values move within the tolerance of their levels where the clay was symmetric but for that; a
/// node where its level ends, which only one of two images stores, becomes what the coarser level
/// says, which stores both. Whether all invariants hold then is for the caller to see.
///
/// Errors  throws OverLimit half done when what it copies is more than the target's free bytes.
void symmetrise_all(EditTarget& target, const LatticeSymmetry& symmetry);

/// The same of the `touched` leaves of a stroke, which did alike on all sides, if all of that was
/// symmetric before it. Else nothing, and false. `images`: what earlier calls and what followed
/// changed.
bool symmetrise(EditTarget& target, const LatticeSymmetry& symmetry, const UndoStep& stroke,
                const UndoStep& images, const LeafList& touched);

/// The leaves whose invariants depend on some others: these, the ones around them, and those of the
/// next finer and coarser level.
LeafList leaves_that_see(const LevelStack& stack, const LeafList& changed);

}  // namespace argil
