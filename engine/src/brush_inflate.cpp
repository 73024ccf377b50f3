// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "brush.h"

namespace argil {

void stamp_inflate(LevelEdit& level, const PosedTool& tool, double amount_mm) {
  auto& leaves = level.leaves();
  const double most = 1.5 * level.voxel_mm();
  const double amount = std::clamp(amount_mm, -most, most);
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    rewrite_nodes(leaves[n], level.voxel_mm(), level.band_mm(),
                  [&](const Vec3& point, float before) {
                    return before - static_cast<float>(amount * tool.falloff(point));
                  });
  });
}

}  // namespace argil
