// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptics/felt_tool.h"

#include <algorithm>
#include <cassert>

namespace argil::viewer {
namespace {

/// Radii of what can be felt (RigOptions::tool).
constexpr double kLeastFeltMm = 0.2;
constexpr double kMostFeltMm = 50.0;

}  // namespace

haptics::ForceTool felt_tool(const Brush& brush, double radius_mm) {
  assert(radius_mm > 0.0);
  haptics::ForceTool tool;
  const Shape shape = shape_of(brush);
  tool.shape = shape == Shape::box       ? haptics::ToolShape::box
               : shape == Shape::capsule ? haptics::ToolShape::capsule
                                         : haptics::ToolShape::ellipsoid;
  tool.radii_mm = radii_of(brush, std::clamp(radius_mm, kLeastFeltMm, kMostFeltMm));
  tool.radii_mm.z = std::clamp(tool.radii_mm.z, kLeastFeltMm, kMostFeltMm);
  return tool;
}

double own_cut_mm(const Brush& brush, double radius_mm) {
  const bool is_cut = brush.action == Action::carve && shape_of(brush) == Shape::ball;
  if (!is_cut || brush.steady_mm > 0.0) return 0.0;
  // What is felt larger than it works must not cut more than it works.
  return std::min(radius_mm, felt_tool(brush, radius_mm).radii_mm.x);
}

}  // namespace argil::viewer
