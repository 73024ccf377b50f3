// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "edit.h"

namespace argil {

/// Applies one dab and its images.
void apply_dab(EditTarget& target, const Tool& tool, std::span<const Dab> images);

/// Applies all of an anchored action's way so far, groups of `images` dabs, to the levels as they
/// were before the stroke.
void apply_way(EditTarget& target, const Tool& tool, std::span<const Dab> way, std::size_t images);

}  // namespace argil
