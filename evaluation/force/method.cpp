// SPDX-License-Identifier: GPL-3.0-or-later
// The methods that are compared, and which of them can be measured with which tool.
#include "force/method.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "argil/core/window_channel.h"
#include "argil/haptics/force/lattice_force.h"

#include "common/tool_option.h"
#include "scene/scene.h"

namespace argil::evaluation {

std::vector<Method> all_methods() {
  using haptics::ForceLaw;
  std::vector<Method> methods{{"point", "point", Quadrature::point, ForceLaw::blanch, 0}};
  for (const int n : {96, 288, 768}) {
    methods.push_back(
        {"stencil_" + std::to_string(n), "stencil", Quadrature::stencil, ForceLaw::blanch, n});
  }
  for (const int n : {4, 6, 8, 12, 16, 24, 32}) {
    methods.push_back(
        {"blanch_" + std::to_string(n), "blanch", Quadrature::sum, ForceLaw::blanch, n});
  }
  for (const int n : {4, 6, 8, 12, 16, 24, 32}) {
    methods.push_back(
        {"energy_" + std::to_string(n), "energy", Quadrature::sum, ForceLaw::energy, n});
  }
  methods.push_back({"lod", "lod", Quadrature::lattice, ForceLaw::energy, 0});
  methods.push_back({"servo", "servo", Quadrature::chosen, ForceLaw::energy, 0});
  methods.push_back({"lod_blanch", "lod_blanch", Quadrature::lattice, ForceLaw::blanch, 0});
  methods.push_back({"fine", "fine", Quadrature::fine, ForceLaw::energy, 0});
  return methods;
}

double spacing_mm(const Method& method, const haptics::ForceTool& tool) {
  const Vec3& r = tool.radii_mm;
  assert(std::min({r.x, r.y, r.z}) > 0.0);
  if (method.quadrature == Quadrature::lattice || method.quadrature == Quadrature::chosen)
    return haptics::choose_lattice(tool).voxel_mm;
  assert(method.quadrature != Quadrature::sum || method.size > 0);
  // Of the ball of the same volume, so that slender tools get as many nodes.
  if (method.quadrature == Quadrature::sum) return 2.0 * std::cbrt(r.x * r.y * r.z) / method.size;
  return kVoxelMm;
}

bool is_servable(const Method& method, const haptics::ForceTool& tool) {
  if (method.quadrature == Quadrature::point) return true;
  haptics::Lattice lattice;
  lattice.voxel_mm = spacing_mm(method, tool);
  return haptics::window_reach_mm(tool, lattice, 0.0) <= kMostWindowReachVoxels * lattice.voxel_mm;
}

bool is_measured(const Method& method, const haptics::ForceTool& tool) {
  constexpr double kMostMarched = 70.0;   // a window of more takes a second to read
  constexpr double kMostSampled = 110.0;  // about 10^6 nodes
  if (method.quadrature == Quadrature::point || method.quadrature == Quadrature::stencil)
    return true;
  const double side = 2.0 * haptics::kKernelSupport * cli::largest_radius_mm(tool);
  return side / spacing_mm(method, tool) <=
         (method.quadrature == Quadrature::fine ? kMostSampled : kMostMarched);
}

}  // namespace argil::evaluation
