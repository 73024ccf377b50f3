// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rows/rows.h"
#include "tool/posed_tool.h"

namespace argil {

/// Where a tool pulls, how strongly.
enum class PullLaw {
  falloff,       ///< its falloff, about the middle of the dab's path
  swept_height,  ///< the same from the dab's path, times the full height of a layer in mm
};

/// How high the layer of a tool stands at full pull.
double layer_height_mm(const PosedTool& tool) noexcept;

/// How a tool pulls at points that count from `origin_mm` in voxels.
PullJob pull_job(const PosedTool& tool, PullLaw law, const Vec3& origin_mm, double voxel_mm);

}  // namespace argil
