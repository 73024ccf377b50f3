// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cmath>
#include <functional>

#include "brush/dab_plan.h"

namespace argil {

/// How far the distance grows at a point on the surface, in mm (negative: matter is put on).
/// `pull` is the strongest image's there and what the mask leaves of it.
using MoveLaw = std::function<double(std::size_t image, const Vec3& place_mm, double pull)>;

/// How strongly an image pulls at a point: at least 0, and 0 outside its bounds. Nothing for its
/// falloff.
using PullLaw = double (*)(const PosedTool& image, const Vec3& point_mm);

/// Moves the surface of a level along its normals: every node within the band changes by what the
/// law says of the point of the surface that is nearest to it, at most kVoxelsPerStep, so that a
/// distance stays one but for the square of the step. Returns the farthest, in mm, that a node
/// would have moved without that limit.
///
/// Source  extension velocities (Adalsteinsson, Sethian 1999), by the closest point instead of a
///         march: nothing is solved.
float displace(LevelEdit& level, DabImages images, const MoveLaw& law, PullLaw pull = nullptr);

/// The fraction of what is left that each of `steps` steps covers, so that together they cover
/// `part` of the whole.
inline double part_of_step(double part, int steps) {
  assert(steps >= 1);
  return steps == 1 ? part : 1.0 - std::pow(1.0 - part, 1.0 / steps);
}

/// Displaces all levels in as many steps as the displacement needs, at most kMostSteps: what is
/// left is moved by the next dabs. `law_of(edit, steps)` makes the law of one of `steps` steps from
/// the clay as it stands.
inline constexpr int kMostSteps = 8;
void displace_in_steps(EditTarget& target, DabImages images, int tool_level,
                       const std::function<MoveLaw(Edit& edit, int steps)>& law_of);

}  // namespace argil
