// SPDX-License-Identifier: GPL-3.0-or-later
// The surface goes a fraction of its way at each step, and the tools ride on it: what lay under a
// tool's middle stays there, so that the falloff is that of where the surface was at the start.
#include <algorithm>
#include <cmath>
#include <vector>

#include "action/action.h"
#include "action/dab.h"
#include "brush/displace.h"
#include "brush/local_plane.h"
#include "field/parallel.h"

namespace argil {
namespace {

/// A dab that leaves something, and where it goes with the surface in all.
struct RidingDab {
  Dab dab;
  Vec3 rise_mm;
};

/// `side` is 1 where the surface is raised, -1 where it is lowered. A tool with no surface under
/// its middle stays where it is.
std::vector<RidingDab> riding_dabs(const LevelStack& stack, const Tool& tool,
                                   std::span<const Dab> path, int tool_level, double side) {
  std::vector<RidingDab> dabs;
  for (const Dab& dab : path) {
    if (layer_height_mm(PosedTool(tool, dab)) > 0.0) dabs.push_back({dab, {}});
  }
  for_each_leaf(dabs.size(), [&](std::size_t n) {
    const PosedTool posed(tool, dabs[n].dab);
    const openvdb::CoordBBox box = reached_nodes(posed.bounds_mm(), stack.voxel_mm(tool_level));
    const auto plane = plane_under(local_field(stack, tool_level, box), posed);
    if (plane) dabs[n].rise_mm = side * layer_height_mm(posed) * plane->normal;
  });
  return dabs;
}

/// The tools where they are when the surface has gone this fraction of its way.
std::vector<PosedTool> tools_at(const Tool& tool, const std::vector<RidingDab>& dabs,
                                double fraction) {
  std::vector<PosedTool> tools;
  for (const RidingDab& riding : dabs) {
    Dab dab = riding.dab;
    dab.from.position_mm += fraction * riding.rise_mm;
    dab.at.position_mm += fraction * riding.rise_mm;
    tools.emplace_back(tool, dab);
  }
  return tools;
}

}  // namespace

void actions::layer(EditTarget& target, const Tool& tool, std::span<const Dab> path, std::size_t) {
  const LevelStack& stack = target.stack;
  const int tool_level = level_of_tool(stack, smallest_radius(tool));
  const double side = tool.strength < 0.0 ? -1.0 : 1.0;
  const std::vector<RidingDab> dabs = riding_dabs(stack, tool, path, tool_level, side);
  if (dabs.empty()) return;
  int steps = 1;
  for (int step = 0; step < steps; ++step) {
    const std::vector<PosedTool> tools = tools_at(tool, dabs, 1.0 * step / steps);
    Edit edit(target);
    const int finest = plan_displaced(edit, stack, tools, tool_level);
    if (step == 0) {
      double most_mm = 0.0;
      for (const PosedTool& each : tools) most_mm = std::max(most_mm, layer_height_mm(each));
      steps = steps_of(most_mm, stack.voxel_mm(finest));
    }
    const EvenLaw law(side / steps);  // of the height that the pull is
    for (int n = 0; n < edit.count(); ++n) {
      displace(edit.level(n), tools, law, PullLaw::swept_height);
    }
    commit_displaced(target, edit);
    std::vector<Box3> reached;
    for (const PosedTool& each : tools) reached.push_back(each.bounds_mm());
    flush_queue(target, reached);
  }
}

}  // namespace argil
