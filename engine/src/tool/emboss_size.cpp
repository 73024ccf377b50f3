// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/emboss_size.h"

#include <algorithm>
#include <cmath>

#include "argil/engine/alpha_image.h"

namespace argil {

double emboss_ratio(const Tool& tool) noexcept {
  constexpr double kUsualRatio = 0.25;  // as high as a layer
  if (tool.amplitude_mm <= 0.0) return kUsualRatio;
  return std::min(1.0, tool.amplitude_mm / smallest_radius(tool));
}

double emboss_reach(const Tool& tool) noexcept {
  const double corner = (1.0 - tool.tip_roundness) * std::sqrt(2.0) + tool.tip_roundness;
  return std::sqrt(corner * corner + kEmbossDepth * kEmbossDepth) + emboss_ratio(tool);
}

double emboss_tile_mm(const Tool& tool) noexcept {
  return tool.tile_mm > 0.0 ? tool.tile_mm : 2.0 * std::min(tool.radii_mm.x, tool.radii_mm.y);
}

double emboss_pixel_mm(const Tool& tool) noexcept {
  const double radius = std::min(tool.radii_mm.x, tool.radii_mm.y);
  const double rim = 0.25 * tool.tip_roundness * radius;
  if (tool.alpha == nullptr) return rim;
  const double pixels = std::max(tool.alpha->width(), tool.alpha->height());
  return (tool.alpha_mode == AlphaMode::tiled ? emboss_tile_mm(tool) : 2.0 * radius) / pixels;
}

}  // namespace argil
