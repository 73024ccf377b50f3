// SPDX-License-Identifier: GPL-3.0-or-later
// How what was displaced becomes a measured distance again.
#pragma once

#include <span>

#include "dab_plan.h"

namespace argil {

/// Ends an edit that displaced all levels: the coarser ones get the restriction, and what moved is
/// remembered as not settled.
void finish_displaced(EditTarget& target, Edit& edit);

/// Solves what moved too far since it was last solved, and what tools with these bounds do not
/// reach any more: without bounds all.
void settle(EditTarget& target, std::span<const Box3> tools_mm);

}  // namespace argil
