// SPDX-License-Identifier: GPL-3.0-or-later
// Blending is linear in the logarithm of the spacing, as tools are scaled.
#include "window/window_levels.h"

#include <cassert>
#include <cmath>

namespace argil {
namespace {

constexpr double kBlendOctaves = 0.25;

}  // namespace

LevelChoice choose_level(double voxel_mm, double finest_voxel_mm, int coarsest_level) noexcept {
  assert(voxel_mm > 0.0 && finest_voxel_mm > 0.0 && coarsest_level >= 0);
  const double ratio = voxel_mm / finest_voxel_mm;
  const int level = std::ilogb(ratio);
  if (level <= 0) return {};
  if (level > coarsest_level) return {coarsest_level, coarsest_level, 0.0};
  const double octaves = std::log2(std::scalbn(ratio, -level));
  if (octaves >= kBlendOctaves) return {level, level, 0.0};
  return {level, level - 1, 1.0 - octaves / kBlendOctaves};
}

}  // namespace argil
