// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>

#include "dab_plan.h"

namespace argil {

/// How far the distance grows at a place on the surface, in mm (negative: matter is put on).
/// `pull` is the image's falloff there and what the mask leaves of it.
using MoveLaw = std::function<double(std::size_t image, const Vec3& place_mm, double pull)>;

/// Moves the surface of a level along its normals: every node within the band changes by what the
/// law says of the place of the surface that is nearest to it, at most kVoxelsPerStep, so that a
/// distance stays one but for the square of the step. Returns the farthest, in mm, that a node
/// would have moved without that limit.
///
/// Source  extension velocities (Adalsteinsson, Sethian 1999), by the closest point instead of a
///         march: nothing is solved.
float displace(LevelEdit& level, DabImages images, const MoveLaw& law);

/// One of `steps` equal shares of going a part of the way to a target.
inline double part_of_way(double part, int steps) {
  return steps == 1 ? part : 1.0 - std::pow(1.0 - part, 1.0 / steps);
}

/// Displaces all levels in as many steps as the way needs, at most kMostSteps: what is left is
/// moved by the next dabs. `law_of(edit, steps)` makes the law of one of `steps` equal shares from
/// the clay as it stands.
inline constexpr int kMostSteps = 8;
void displace_in_steps(EditTarget& target, DabImages images, int tool_level,
                       const std::function<MoveLaw(Edit& edit, int steps)>& law_of);

}  // namespace argil
