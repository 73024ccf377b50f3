// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "argil/core/progress.h"
#include "argil/engine/operation.h"

#include "edit/edit.h"
#include "operation/solid.h"

namespace argil {

enum class Combined {
  done,
  empty,        ///< nothing would be left; nothing was written
  interrupted,  ///< nothing was written
};

/// Combines the clay with a solid, as dabs do with the shape of a tool: the minimum or maximum of
/// the two distances, on every level that the result needs. Leaves where that is the clay itself
/// keep their bits.
///
/// Where both surfaces pass a node within a twentieth of a voxel, what a single layer of nodes
/// would leave between them (touching or coincident surfaces) is closed, or taken away.
///
/// Errors       throws bad_alloc, with nothing written.
/// Determinism  same bits for any number of threads.
/// Cost         linear in the leaves that change and the leaves of the solid.
Combined combine(EditTarget& target, const Solid& solid, CombineKind kind,
                 const Progress& progress);

/// Whether some node of the levels lies inside.
bool has_inside(const LevelStack& stack);

}  // namespace argil
