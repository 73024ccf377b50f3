// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "argil/engine/tool.h"

#include "edit/edit.h"

namespace argil {

/// Applies one dab and its images, or several that are joined: groups of `images`.
void apply_dab(EditTarget& target, const Tool& tool, std::span<const Dab> dabs, std::size_t images);

/// Applies all of an anchored action's path so far, groups of `images` dabs, to the levels as they
/// were before the stroke; or a piece of one that can be carried. What that moves is solved at once
/// where the target has no queue.
void apply_path(EditTarget& target, const Tool& tool, std::span<const Dab> path,
                std::size_t images);

}  // namespace argil
