// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <variant>

#include "argil/core/progress.h"
#include "argil/core/result.h"

namespace argil {

class Clay;

/// Moves the mask's borders along the surface: what was masked a half, and every other share, is
/// found `by_mm` farther out. Soft borders stay as soft as they were.
struct MaskGrow {
  /// From a twentieth of the clay's voxel to its longest side; the negative of that shrinks: it
  /// grows what is free.
  double by_mm = 0.0;
};

/// Masks by how the surface is curved, in the place of what was masked before.
///
/// Where the sum of the two curvatures, averaged within `radius_mm` and counted positive where the
/// surface is hollow, is K, the mask is factor * radius_mm * K, at least 0 and at most 1: with a
/// factor of 1 the bottom of a groove with the radius `radius_mm` is held whole, that of one four
/// times as wide a quarter.
struct MaskCavity {
  /// The size of what is found: 2 voxels of the clay to 4 of its coarsest level.
  double radius_mm = 0.0;
  /// -100 to 100, not 0. A negative one masks what stands out instead: ridges and knobs.
  double factor = 1.0;
  /// Masks all but the cavities: 1 less what it would be, in all of space.
  bool is_inverted = false;
};

/// What is done to a mask with a look at the surface; what needs none is a MaskEdit.
using MaskFilter = std::variant<MaskGrow, MaskCavity>;

/// Whether its numbers are such that there is a clay for which they are in range.
/// Errors  bad_input naming the number, its value and its range.
Result<void> validate_filter(const MaskFilter& filter);

/// Does it. One undo step, also where nothing changes.
///
/// Errors   bad_input as validate_filter, for a number that is out of range for this clay, or while
///          a stroke is open; memory, interrupted: the mask is as it was.
/// Accuracy MaskGrow: the way from a place to the border is taken along the arc that leaves the
///          surface at both ends at the angle that the straight line has to it there, which is
///          exact on planes and balls, off by the third power of way times curvature elsewhere,
///          and up to a fifth short round a sharp edge of 90 degrees. The border lies where it
///          should to .35 of the finest voxel, to .6 where the way is longer than the surface's
///          radius (MaskGrows.*). Two sides of a gap are neighbours where it is narrower than 7
///          finest voxels. MaskCavity: to .07 of the formula for a radius of 5 voxels and forms of
///          at least twice that (MaskCavities.*). Smooth clay that is stored coarsely is known to
///          its tolerance alone: up to 6 times factor * tolerance / radius.
/// Reach    both see the surface: within ten finest voxels of it all nodes change, farther away
///          MaskGrow leaves what was there and MaskCavity frees it.
/// Cost     MaskGrow: the nodes between the former border and the new one. MaskCavity: 17 values of
///          the field for each node near the surface.
/// Determinism  same bits for any number of threads.
Result<void> filter_mask(Clay& clay, const MaskFilter& filter, const Progress& progress = {});

}  // namespace argil
