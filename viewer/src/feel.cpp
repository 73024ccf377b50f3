// SPDX-License-Identifier: GPL-3.0-or-later
#include "feel.h"

#include <algorithm>

#include "argil/engine/window.h"
#include "argil/haptics/lattice_force.h"

namespace argil::viewer {
namespace {

/// Radii of what can be felt (RigOptions::tool).
constexpr double kLeastFeltMm = 0.2;
constexpr double kMostFeltMm = 50.0;
/// A window of a larger tool, in the clay's coarsest voxels, no longer pays; nor does a lattice
/// with fewer nodes across resolve a tool (as `argil force` has both).
constexpr double kMostVoxels = 64.0;
constexpr double kLeastAcross = 4.0;

}  // namespace

haptics::ForceTool felt_tool(const Brush& brush, double radius_mm) {
  haptics::ForceTool tool;
  const Shape shape = shape_of(brush);
  tool.shape = shape == Shape::box       ? haptics::ToolShape::box
               : shape == Shape::capsule ? haptics::ToolShape::capsule
                                         : haptics::ToolShape::ellipsoid;
  tool.radii_mm = radii_of(brush, std::clamp(radius_mm, kLeastFeltMm, kMostFeltMm));
  tool.radii_mm.z = std::clamp(tool.radii_mm.z, kLeastFeltMm, kMostFeltMm);
  return tool;
}

Vec3 pressed_place(const haptics::ForceTool& tool, const SurfaceHit& hit, double press_mm) {
  return hit.point_mm - (press_mm - tool.radii_mm.x) * hit.normal;
}

std::optional<Workshop::Felt> feel(const Clay& clay, const SurfaceHit& hit,
                                   const Workshop::Touch& touch) {
  haptics::ForceTool tool = touch.tool;
  tool.position_mm = pressed_place(tool, hit, touch.press_mm);
  const haptics::Lattice lattice = haptics::choose_lattice(tool);
  const double most = kMostVoxels * clay.level_stats().back().voxel_mm;
  if (lattice.across < kLeastAcross) return std::nullopt;
  if (std::max({tool.radii_mm.x, tool.radii_mm.y, tool.radii_mm.z}) > most) return std::nullopt;
  constexpr double kMarginMm = 0.0;  // it does not move on
  const auto window = read_window(
      clay,
      {tool.position_mm, lattice.voxel_mm, haptics::window_reach_mm(tool, lattice, kMarginMm),
       haptics::window_depth_mm(tool, touch.material, lattice)},
      Extension::march);
  if (!window) return std::nullopt;
  const haptics::LatticeForce force(tool, touch.material, haptics::ForceLaw::energy,
                                    lattice.voxel_mm);
  const haptics::ForceResult result = force.evaluate(window.value().view, tool);
  return Workshop::Felt{tool.position_mm, tool.radii_mm.x, result.contact_n};
}

}  // namespace argil::viewer
