// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "argil/engine/tool.h"

#include "edit/edit.h"

namespace argil {

/// Applies one dab and its images, or several that are joined: groups of `images`.
void apply_dab(EditTarget& target, const Tool& tool, std::span<const Dab> dabs, std::size_t images);

/// Whether a piece of an anchored action's path may be applied to what the pieces before left: that
/// comes near to what the whole does, but for detail, which each piece resamples.
bool can_be_carried(Action action) noexcept;

/// Applies all of an anchored action's path so far, groups of `images` dabs, to the levels as they
/// were before the stroke; or a piece of one that can be carried. What that moves is solved at once
/// where the target has no queue.
void apply_path(EditTarget& target, const Tool& tool, std::span<const Dab> path,
                std::size_t images);

}  // namespace argil
