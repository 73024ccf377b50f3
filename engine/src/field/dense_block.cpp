// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/dense_block.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil {

NodeBox covering_nodes(const Vec3& center_mm, double reach_mm, double voxel_mm) {
  assert(is_finite(center_mm) && reach_mm >= 0.0 && voxel_mm > 0.0);
  NodeBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const double center = center_mm[static_cast<std::size_t>(axis)];
    box.low[axis] = static_cast<int>(std::floor((center - reach_mm) / voxel_mm));
    box.high[axis] = static_cast<int>(std::ceil((center + reach_mm) / voxel_mm));
  }
  return box;
}

NodeBox part_of(const NodeBox& box, const Coord& origin) {
  return {Coord::maxComponent(origin, box.low),
          Coord::minComponent(origin.offsetBy(kLeafSide - 1), box.high)};
}

}  // namespace argil
