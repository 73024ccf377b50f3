// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/felt_window.h"

#include <algorithm>
#include <string>

#include "common/output.h"
#include "common/tool_option.h"

namespace argil::cli {
namespace {

double smallest_radius_mm(const haptics::ForceTool& tool) {
  return std::min({tool.radii_mm.x, tool.radii_mm.y, tool.radii_mm.z});
}

Result<void> check_tool(const Clay& clay, const haptics::ForceTool& tool,
                        const haptics::Lattice& lattice, const FeltWords& words) {
  constexpr double kMostVoxels = 64.0;
  constexpr double kLeastAcross = 4.0;
  const double most = kMostVoxels * clay.level_stats().back().voxel_mm;
  const double radius = largest_radius_mm(tool);
  if (radius > most) {
    return Error{ErrorKind::bad_input, std::string(words.tool) + " has a radius of " +
                                           number(radius) +
                                           " mm; for a clay of this size at most " + number(most)};
  }
  if (lattice.across < kLeastAcross) {
    return Error{ErrorKind::bad_input,
                 std::string(words.tool) + " is too long or flat: its smallest radius of " +
                     number(smallest_radius_mm(tool)) + " mm would get " + number(lattice.across) +
                     " samples across; use " + words.fine + " or radii nearer to each other"};
  }
  return {};
}

}  // namespace

haptics::Lattice felt_lattice(const Clay& clay, const haptics::ForceTool& tool, FeltMethod method) {
  const double finest = clay.options().voxel_mm;
  if (method == FeltMethod::point) return {finest, 1.0, 0.0};
  if (method == FeltMethod::fine) return {finest, 0.0, 2.0 * smallest_radius_mm(tool) / finest};
  return haptics::choose_lattice(tool);
}

Result<FieldWindow> felt_window(const Clay& clay, const haptics::ForceTool& tool,
                                const haptics::ForceMaterial& material, FeltMethod method,
                                double margin_mm, const FeltWords& words) {
  const haptics::Lattice lattice = felt_lattice(clay, tool, method);
  if (method == FeltMethod::point) {
    constexpr double kBorderVoxels = 2.0;  // for the gradient
    const double radius = largest_radius_mm(tool);
    return read_window(
        clay,
        {tool.position_mm, lattice.voxel_mm,
         haptics::kKernelSupport * radius + kBorderVoxels * lattice.voxel_mm + margin_mm,
         2.0 * radius + material.skin_mm},
        Extension::layers);
  }
  if (method == FeltMethod::lod) {
    if (auto fits = check_tool(clay, tool, lattice, words); !fits) return fits.error();
  }
  const WindowRequest request{tool.position_mm, lattice.voxel_mm,
                              haptics::window_reach_mm(tool, lattice, margin_mm),
                              haptics::window_depth_mm(tool, material, lattice)};
  return read_window(clay, request,
                     method == FeltMethod::fine ? Extension::exact : Extension::layers);
}

}  // namespace argil::cli
