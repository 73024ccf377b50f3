// SPDX-License-Identifier: GPL-3.0-or-later
// Pruning: leaves that the next coarser level describes as well go. The coarsening criterion says
// when that is so, prune() applies it to the leaves that an edit touched, prune_level() to a level
// while a stack is built, Edit::prune() to an edit that is not committed yet. drop_bandless() asks
// no criterion: its leaves have no surface to describe.
#pragma once

#include "edit/coarsening_criterion.h"
#include "edit/edit.h"

namespace argil {

/// Drops the leaves among `touched`, and those of the next finer level around them, that no finer
/// leaf requires and the criterion does not keep: an edit may have left them unneeded by their own
/// values, by those of the coarser level or by what went next door.
///
/// Returns      whether a leaf came or went.
/// Errors       throws OverLimit or bad_alloc with nothing written.
/// Determinism  the same bits for any number of threads.
bool prune(EditTarget& target, const LeafList& touched);

/// The same of all leaves of one level below the coarsest, in a stack that is being built: the
/// finer levels are final.
void prune_level(LevelStack& stack, int level, double tolerance_mm);

/// Drops the leaves of a level, in a stack that is being built, that hold nothing but "far" and
/// that no finer leaf requires: their finer leaves went with the levels that were taken away.
void drop_bandless(LevelStack& stack, int level);

}  // namespace argil
