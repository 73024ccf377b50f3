// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/mask_reach.h"

#include <cassert>
#include <cmath>

#include "field/mask.h"

namespace argil {
namespace {

/// Leaves whose middle lies nearer to the surface than this many finest voxels count node by node:
/// from the middle to a corner are 14.
constexpr double kNearVoxels = 24.0;

}  // namespace

bool is_near_surface(const LevelStack& stack, const Coord& mask_origin) {
  assert(is_leaf_origin(mask_origin));
  const double near = kNearVoxels * stack.voxel_mm(0);
  // Where the coarsest level does not look that far, nothing is known to be far.
  if (static_cast<double>(stack.band_mm(stack.top())) < near) return true;
  const Coord middle = mask_origin.offsetBy(kLeafSide / 2);
  static_assert(kMaskVoxels == 2);
  const float distance = stack.node_value(0, middle << 1);
  return std::abs(static_cast<double>(distance)) < near;
}

}  // namespace argil
