// SPDX-License-Identifier: GPL-3.0-or-later
// Cut away is what the tool sweeps above a plane, which the surface under the first dab says. All
// dabs are cut at once, since what the first left says no more where the plane was.
#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "brush/action.h"
#include "brush/dab.h"
#include "brush/local_plane.h"
#include "edit/restriction.h"
#include "field/parallel.h"
#include "field/prolongation.h"

namespace argil {
namespace {

/// One image of all dabs, and the plane of its first.
struct PlanarCut {
  std::vector<PosedTool> path;
  LocalPlane plane;
};

/// The plane is that of the whole tool, however lightly the stroke begins.
std::optional<LocalPlane> plane_at(const LevelStack& stack, const Tool& tool, Dab first) {
  first.from = first.at;
  first.at.pressure = 1.0;
  const PosedTool whole(tool, first);
  const int level = level_of_tool(stack, whole.smallest_radius_mm());
  const openvdb::CoordBBox box = reached_nodes(whole.bounds_mm(), stack.voxel_mm(level));
  std::optional<LocalPlane> plane = plane_under(local_field(stack, level, box), whole);
  if (plane) plane->center_mm += tool.plane_offset * whole.smallest_radius_mm() * plane->normal;
  return plane;
}

/// Images without surface under their first dab cut nothing, nor do tools so shrunk that no lattice
/// would hold them.
std::vector<PlanarCut> cuts_of(const LevelStack& stack, const Tool& tool, std::span<const Dab> path,
                               std::size_t images) {
  std::vector<PlanarCut> cuts;
  for (std::size_t image = 0; image < std::min(images, path.size()); ++image) {
    const std::optional<LocalPlane> plane = plane_at(stack, tool, path[image]);
    if (!plane) continue;
    PlanarCut cut{{}, *plane};
    for (std::size_t n = image; n < path.size(); n += images) {
      PosedTool posed(tool, path[n]);
      if (posed.shrunk_radius_mm() < 0.5 * stack.voxel_mm(0)) continue;
      cut.path.push_back(std::move(posed));
    }
    if (!cut.path.empty()) cuts.push_back(std::move(cut));
  }
  return cuts;
}

/// The tools that come near a leaf.
std::vector<const PosedTool*> near_leaf(const PlanarCut& cut, const Coord& origin, double voxel_mm,
                                        double band_mm) {
  const double half = 0.5 * (kLeafSide - 1) * voxel_mm;
  const Vec3 middle = node_mm(origin, voxel_mm) + Vec3{half, half, half};
  std::vector<const PosedTool*> near;
  if (cut.plane.distance(middle) < -(2.0 * half + band_mm)) return near;
  for (const PosedTool& tool : cut.path) {
    if (cover_of(origin, voxel_mm, band_mm, tool) != Cover::none) near.push_back(&tool);
  }
  return near;
}

/// The nodes of a leaf with all cuts: exact beside the plane and beside the tools' sides, a lower
/// bound where both meet. What is masked is cut by as much less of the tool's depth.
void cut_leaf(LeafEdit& leaf, const LevelEdit& level, const std::vector<PlanarCut>& cuts,
              const LeafMask& mask) {
  const double voxel = level.voxel_mm();
  const float band = level.band_mm();
  LeafValues now;
  std::copy_n(leaf.before(), kLeafNodes, now.begin());
  for (const PlanarCut& cut : cuts) {
    const auto near = near_leaf(cut, leaf.origin, voxel, static_cast<double>(band));
    if (near.empty()) continue;
    LeafValues to_tools;
    to_tools.fill(std::numeric_limits<float>::max());
    double deepest = 0.0;
    for (const PosedTool* tool : near) {
      LeafValues to_tool;
      tool->shrunk_distances(leaf.origin, voxel, to_tool);
      deepest = std::max(deepest, tool->deepest_mm());
      for (std::size_t n = 0; n < kLeafNodes; ++n) to_tools[n] = std::min(to_tools[n], to_tool[n]);
    }
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      const double free = mask.free_fraction(n);
      if (free == 0.0) continue;
      const double above = cut.plane.distance(node_mm(node_of(leaf.origin, n), voxel));
      const auto inside = static_cast<float>(std::min(-static_cast<double>(to_tools[n]), above) -
                                             (1.0 - free) * deepest);
      now[n] = std::clamp(std::max(now[n], inside), -band, band);
    }
  }
  leaf.write_all(now);
}

void cut_level(LevelEdit& level, const std::vector<PlanarCut>& cuts, const Mask* mask) {
  std::vector<LeafEdit>& leaves = level.leaves();
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    cut_leaf(leaves[n], level, cuts, LeafMask(mask, level.level(), leaves[n].origin));
  });
}

/// Whether cutting changes anything in a leaf: not where there is no leaf because all is air.
bool is_cut(const LevelStack& stack, int level, const Coord& origin,
            const std::vector<PlanarCut>& cuts) {
  const double band = stack.band_mm(level);
  const double voxel = stack.voxel_mm(level);
  if (std::all_of(cuts.begin(), cuts.end(), [&](const PlanarCut& cut) {
        return near_leaf(cut, origin, voxel, band).empty();
      })) {
    return false;
  }
  if (level == stack.top() || stack.has_leaf(level, origin)) return true;
  return any_coarse_below(stack, level + 1, origin, 1.0F, stack.band_mm(level));
}

}  // namespace

void actions::trim(EditTarget& target, const Tool& tool, std::span<const Dab> path,
                   std::size_t images) {
  const LevelStack& stack = target.stack;
  const std::vector<PlanarCut> cuts = cuts_of(stack, tool, path, images);
  if (cuts.empty()) return;
  // Its edges are sharp: finer than a ball of its size.
  const int tool_level = level_of_tool(stack, 0.5 * smallest_radius(tool));
  const Mask* mask = nullptr;
  Edit edit(target);
  for (const PlanarCut& cut : cuts) {
    const Box3 bounds = bounds_of(cut.path);
    if (stack.mask() != nullptr && !stack.mask()->is_zero_in(bounds)) mask = stack.mask();
    want_reached(edit, stack, bounds, tool_level, [&](int level, const Coord& origin) {
      return is_cut(stack, level, origin, cuts);
    });
  }
  edit.load();
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    cut_level(level, cuts, mask);
    if (mask != nullptr) continue;
    level.mark_changes();
    if (n == 0) continue;
    restrict_edit(edit.level(n - 1), level, RestrictedLeaves::touched);
    level.mark_changes();
  }
  // What a mask shrinks is no distance any more.
  if (mask != nullptr) {
    solve_stamped(edit);
    edit.drop_empty();
  } else {
    edit.prune();
  }
  edit.commit();
}

}  // namespace argil
