// SPDX-License-Identifier: GPL-3.0-or-later
// Cut away is what the tool sweeps above a plane, which the surface under the first dab says. All
// dabs are cut at once, since what the first left says no more where the plane was.
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "action/action.h"
#include "action/dab.h"
#include "brush/local_plane.h"
#include "edit/edge_rounding.h"
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
                                        double reach_mm) {
  const double half = 0.5 * (kLeafSide - 1) * voxel_mm;
  const Vec3 middle = node_mm(origin, voxel_mm) + Vec3{half, half, half};
  std::vector<const PosedTool*> near;
  if (cut.plane.distance(middle) < -(2.0 * half + reach_mm)) return near;
  for (const PosedTool& tool : cut.path) {
    if (cover_of(origin, voxel_mm, reach_mm, tool) != Cover::none) near.push_back(&tool);
  }
  return near;
}

/// How all cuts are written.
struct TrimJob {
  const std::vector<PlanarCut>& cuts;
  double edge_radius_mm;
};

/// How far from a cut it changes the clay at most: within a level's band, and where a wide edge
/// ends.
double reach_of(float band_mm, const TrimJob& job) {
  return std::max(static_cast<double>(band_mm), 2.0 * job.edge_radius_mm);
}

/// One cut at the nodes of a leaf: the distance of what it leaves, and how that rises.
class CutAtLeaf {
 public:
  CutAtLeaf(const PlanarCut& cut, std::vector<const PosedTool*> near, const Coord& origin,
            double voxel_mm)
      : cut_(cut), near_(std::move(near)), origin_(origin), voxel_mm_(voxel_mm) {}

  /// Exact beside the plane and beside the tools' sides, a lower bound where both meet. A mask
  /// shrinks the tools, as their strength does; the plane stays.
  void left(const LeafMask& mask, LeafValues& out) const {
    LeafValues to_tools;
    to_tools.fill(std::numeric_limits<float>::max());
    double deepest = 0.0;
    for (const PosedTool* tool : near_) {
      LeafValues to_tool;
      tool->shrunk_distances(origin_, voxel_mm_, to_tool);
      deepest = std::max(deepest, tool->deepest_mm());
      for (std::size_t n = 0; n < kLeafNodes; ++n) to_tools[n] = std::min(to_tools[n], to_tool[n]);
    }
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      const double free = mask.free_fraction(n);
      const double in_tools = -static_cast<double>(to_tools[n]) - (1.0 - free) * deepest;
      out[n] = free > 0.0 ? static_cast<float>(std::min(in_tools, above_plane(n)))
                          : -std::numeric_limits<float>::infinity();
    }
  }

  Vec3 slope(std::size_t n) const {
    const Vec3 at = point(n);
    const auto nearest =
        *std::min_element(near_.begin(), near_.end(), [&](const PosedTool* a, const PosedTool* b) {
          return a->shrunk_distance(at) < b->shrunk_distance(at);
        });
    const bool is_plane = above_plane(n) < -nearest->shrunk_distance(at);
    return is_plane ? cut_.plane.normal : -nearest->slope(at);
  }

 private:
  Vec3 point(std::size_t n) const { return node_mm(node_of(origin_, n), voxel_mm_); }
  double above_plane(std::size_t n) const { return cut_.plane.distance(point(n)); }

  const PlanarCut& cut_;
  std::vector<const PosedTool*> near_;
  Coord origin_;
  double voxel_mm_;
};

void cut_leaf(LeafEdit& leaf, const LevelEdit& level, const TrimJob& job, const LeafMask& mask) {
  const double voxel = level.voxel_mm();
  const float band = level.band_mm();
  LeafValues now;
  std::copy_n(leaf.before(), kLeafNodes, now.begin());
  for (const PlanarCut& cut : job.cuts) {
    auto near = near_leaf(cut, leaf.origin, voxel, reach_of(band, job));
    if (near.empty()) continue;
    const CutAtLeaf at_leaf(cut, std::move(near), leaf.origin, voxel);
    LeafValues left;
    at_leaf.left(mask, left);
    LeafValues trimmed;
    for (std::size_t n = 0; n < kLeafNodes; ++n) trimmed[n] = std::max(leaf.before()[n], left[n]);
    const EdgeLeaf edge{1.0F, left, voxel, job.edge_radius_mm};
    if (job.edge_radius_mm > 0.0 && edge.is_near_any(leaf.before())) {
      HaloBlock clay;
      gather_before(level, leaf.origin, leaf.before(), job.edge_radius_mm, clay);
      round_edge(
          edge, clay, [&](std::size_t n) { return at_leaf.slope(n); }, trimmed);
    }
    for (std::size_t n = 0; n < kLeafNodes; ++n) now[n] = std::max(now[n], trimmed[n]);
  }
  clamp_to(band, now);
  leaf.write_all(now);
}

void cut_level(LevelEdit& level, const TrimJob& job, const Mask* mask) {
  std::vector<LeafEdit>& leaves = level.leaves();
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    cut_leaf(leaves[n], level, job, LeafMask(mask, level.level(), leaves[n].origin));
  });
}

/// Whether cutting changes anything in a leaf: not where there is no leaf because all is air.
bool is_cut(const LevelStack& stack, int level, const Coord& origin, const TrimJob& job) {
  const double reach = reach_of(stack.band_mm(level), job);
  const double voxel = stack.voxel_mm(level);
  if (std::all_of(job.cuts.begin(), job.cuts.end(), [&](const PlanarCut& cut) {
        return near_leaf(cut, origin, voxel, reach).empty();
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
  const int tool_level = level_of_shape(stack, tool, smallest_radius(tool));
  const TrimJob job{cuts,
                    edge_radius(stack, tool_level, target.edge_radius_mm, smallest_radius(tool))};
  const double beyond = reach_of(0.0F, job);
  const Mask* mask = nullptr;
  Edit edit(target);
  for (const PlanarCut& cut : cuts) {
    Box3 bounds = bounds_of(cut.path);
    bounds.min -= Vec3{beyond, beyond, beyond};
    bounds.max += Vec3{beyond, beyond, beyond};
    if (stack.mask() != nullptr && !stack.mask()->is_zero_in(bounds)) mask = stack.mask();
    want_reached(edit, stack, bounds, tool_level,
                 [&](int level, const Coord& origin) { return is_cut(stack, level, origin, job); });
  }
  edit.load();
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    cut_level(level, job, mask);
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
