// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/touch.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "argil/engine/window.h"
#include "argil/haptics/force/lattice_force.h"

namespace argil::viewer {
namespace {

/// Limits of what a window serves, the same as those of `argil force`: a larger tool, in the clay's
/// coarsest voxels, would cost more than it shows, and a lattice with fewer nodes across does not
/// resolve a tool.
constexpr double kMostVoxels = 64.0;
constexpr double kLeastAcross = 4.0;

}  // namespace

Vec3 pressed_position(const haptics::ForceTool& tool, const SurfaceHit& hit, double press_mm) {
  return hit.point_mm - (press_mm - tool.radii_mm.x) * hit.normal;
}

std::optional<FeltForce> feel(const Clay& clay, const SurfaceHit& hit, const Touch& touch) {
  assert(std::isfinite(touch.press_mm));
  haptics::ForceTool tool = touch.tool;
  tool.position_mm = pressed_position(tool, hit, touch.press_mm);
  const haptics::Lattice lattice = haptics::choose_lattice(tool);
  const double most = kMostVoxels * clay.level_stats().back().voxel_mm;
  if (lattice.across < kLeastAcross) return std::nullopt;
  if (std::max({tool.radii_mm.x, tool.radii_mm.y, tool.radii_mm.z}) > most) return std::nullopt;
  constexpr double kMarginMm = 0.0;  // it does not move on
  const auto window = read_window(
      clay,
      {tool.position_mm, lattice.voxel_mm, haptics::window_reach_mm(tool, lattice, kMarginMm),
       haptics::window_depth_mm(tool, touch.material, lattice)},
      Extension::layers);
  if (!window) return std::nullopt;
  const haptics::LatticeForce force(tool, touch.material, haptics::ForceLaw::energy,
                                    lattice.voxel_mm);
  const haptics::ForceResult result = force.evaluate(window.value().view, tool);
  return FeltForce{tool.position_mm, tool.radii_mm.x, result.contact_n};
}

std::optional<FeltForce> steadied(const std::optional<FeltForce>& now,
                                  const std::optional<FeltForce>& before, double pixel_mm,
                                  double arrow_mm_per_n) noexcept {
  if (!now || !before || now->radius_mm != before->radius_mm) return now;
  const double half = 0.5 * pixel_mm;
  const bool is_still = length(now->tool_mm - before->tool_mm) < half &&
                        arrow_mm_per_n * length(now->force_n - before->force_n) < half;
  return is_still ? before : now;
}

}  // namespace argil::viewer
