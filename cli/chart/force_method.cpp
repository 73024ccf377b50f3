// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart/force_method.h"

#include <algorithm>
#include <cmath>

#include "argil/haptics/lattice_force.h"

#include "chart/scene.h"
#include "tool_option.h"

namespace argil::cli::chart {

std::vector<Method> all_methods() {
  using haptics::ForceLaw;
  std::vector<Method> methods{{"point", "point", Way::point, ForceLaw::blanch, 0}};
  for (const int n : {96, 288, 768}) {
    methods.push_back(
        {"stencil_" + std::to_string(n), "stencil", Way::stencil, ForceLaw::blanch, n});
  }
  for (const int n : {4, 6, 8, 12, 16, 24, 32}) {
    methods.push_back({"blanch_" + std::to_string(n), "blanch", Way::sum, ForceLaw::blanch, n});
  }
  for (const int n : {4, 6, 8, 12, 16, 24, 32}) {
    methods.push_back({"energy_" + std::to_string(n), "energy", Way::sum, ForceLaw::energy, n});
  }
  methods.push_back({"lod", "lod", Way::lattice, ForceLaw::energy, 0});
  methods.push_back({"lod_blanch", "lod_blanch", Way::lattice, ForceLaw::blanch, 0});
  methods.push_back({"fine", "fine", Way::fine, ForceLaw::energy, 0});
  return methods;
}

double spacing_mm(const Method& method, const haptics::ForceTool& tool) {
  const Vec3& r = tool.radii_mm;
  if (method.way == Way::lattice) return haptics::choose_lattice(tool).voxel_mm;
  if (method.way == Way::sum) return 2.0 * std::cbrt(r.x * r.y * r.z) / method.size;
  return kVoxelMm;
}

bool is_measured(const Method& method, const haptics::ForceTool& tool) {
  constexpr double kMostMarched = 70.0;   // a window of more takes a second to read
  constexpr double kMostSampled = 110.0;  // about 10^6 nodes
  if (method.way == Way::point || method.way == Way::stencil) return true;
  const double side = 2.0 * haptics::kKernelSupport * largest_radius_mm(tool);
  return side / spacing_mm(method, tool) <= (method.way == Way::fine ? kMostSampled : kMostMarched);
}

}  // namespace argil::cli::chart
