// SPDX-License-Identifier: GPL-3.0-or-later
// One dab of each action, one file each. Pure: levels and tool in, changed leaves out by the
// target; no history, no input handling. `tool_level` is the level the tool's size asks for.
#pragma once

#include <span>
#include <vector>

#include "dab_plan.h"
#include "edit.h"

namespace argil {

/// Union with the tool, or with its complement cut away. Exact distance stays exact outside the
/// union and a lower bound inside, so that no level needs solving. Nothing for a shape that is
/// shrunk below half a voxel of the finest level: no lattice would hold it. A mask m under the tool
/// shrinks it there as a strength of 1 - m would, and then distances are solved anew.
void add_or_carve(EditTarget& target, const PosedTool& tool, int tool_level);

/// Moves the surface outward (strength > 0) by at most 1.5 voxels at a time.
void inflate(EditTarget& target, DabImages images, int tool_level);

/// Draws the surface to the tool's own level averaged twice with (1, 2, 1)/4 along each axis. Finer
/// levels are drawn to the same target, so that a large tool smooths fine detail away at its scale.
void smooth(EditTarget& target, DabImages images, int tool_level);

/// Flatten, scrape and fill: draws the surface to the plane that fits it under the tool.
void flatten(EditTarget& target, DabImages images, int tool_level);

/// Pinch and crease: matter moves towards the axis through the tool along the surface's normal.
void crease(EditTarget& target, DabImages images, int tool_level);

/// Raises the mask by strength times falloff for each quarter radius, or lowers it where the
/// strength is negative; 0 to 1. All images at once, however far apart.
void paint_mask(EditTarget& target, DabImages images);

/// Grab and twist: moves matter along the whole way of a stroke. `way` holds all of its dabs,
/// groups of `images`; the stack must be as it was before the first.
void grab(EditTarget& target, const Tool& tool, std::span<const Dab> way, std::size_t images);
void twist(EditTarget& target, const Tool& tool, std::span<const Dab> way, std::size_t images);

}  // namespace argil
