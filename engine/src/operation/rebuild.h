// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/engine/operation.h"

#include "field/level_stack.h"
#include "operation/moved_level.h"

namespace argil {

/// The lattice to build on.
struct RebuildTarget {
  ClayOptions options;
  int levels = 0;  ///< 0: as many as the size needs
};

/// Builds new levels from the distance to a clay's surface (MovedLevel). Coarse first, finer where
/// the source holds finer detail in reach, or where interpolation misses the distance by more than
/// the tolerance (the source's in mm, if larger); dropped again where nothing needs it.
///
/// Errors       interrupted by `progress`; bad_input when the result reaches beyond kMaxNode.
///              Throws bad_alloc.
/// Determinism  same bits for any number of threads.
/// Cost         that of MovedLevel for about twice the leaves that are kept.
Result<std::unique_ptr<LevelStack>> rebuild(const PlacedClay& source, const RebuildTarget& target,
                                            const Progress& progress);

}  // namespace argil
