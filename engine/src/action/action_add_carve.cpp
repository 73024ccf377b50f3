// SPDX-License-Identifier: GPL-3.0-or-later
// Every level that takes part is stamped with the tool's exact distance by minimum or maximum;
// leaves that the tool covers wholly, or not at all, are not evaluated node by node. Where its
// surface meets the clay's at an angle, leaves of the next finer level hold the edge, and it is
// rounded by a voxel of theirs (edit/edge_rounding.h).
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "action/action.h"
#include "edit/edge_rounding.h"
#include "edit/restriction.h"
#include "field/mask.h"
#include "field/nesting.h"
#include "field/parallel.h"
#include "field/prolongation.h"

namespace argil {
namespace {

enum class Stamp { add, carve };

/// The tool as a mask leaves it: m of its depth smaller, and nothing where m is 1.
void shrink(const LeafMask& leaf_mask, float deepest_mm, LeafValues& distance_mm) {
  assert(leaf_mask.has_any());
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    const auto free = static_cast<float>(leaf_mask.free_fraction(n));
    if (free == 0.0F) {
      distance_mm[n] = std::numeric_limits<float>::infinity();
    } else {
      distance_mm[n] += (1.0F - free) * deepest_mm;
    }
  }
}

/// Of several tools what one of them does to a whole leaf at most.
Cover cover_of(const Coord& origin, double voxel_mm, double band_mm,
               std::span<const PosedTool> path) {
  Cover most = Cover::none;
  for (const PosedTool& tool : path) {
    const Cover cover = argil::cover_of(origin, voxel_mm, band_mm, tool);
    if (cover == Cover::all) return Cover::all;
    if (cover == Cover::some) most = Cover::some;
  }
  return most;
}

/// The distance of a leaf's nodes to the union of the tools, each shifted by a mask.
void distances_to(std::span<const PosedTool> path, const Coord& origin, double voxel_mm,
                  const LeafMask& leaf_mask, LeafValues& out) {
  LeafValues next;
  for (std::size_t i = 0; i < path.size(); ++i) {
    LeafValues& to = i == 0 ? out : next;
    path[i].shrunk_distances(origin, voxel_mm, to);
    if (leaf_mask.has_any()) shrink(leaf_mask, static_cast<float>(path[i].deepest_mm()), to);
    if (i == 0) continue;
    for (std::size_t n = 0; n < kLeafNodes; ++n) out[n] = std::min(out[n], next[n]);
  }
}

/// How a dab is written.
struct StampJob {
  std::span<const PosedTool> path;
  Stamp stamp;
  double edge_radius_mm;

  float side() const noexcept { return stamp == Stamp::add ? -1.0F : 1.0F; }
  /// Of the distances of the clay and the shape: the minimum, or the maximum with the complement.
  float combined(float clay, float shape) const noexcept {
    return stamp == Stamp::add ? std::min(clay, shape) : std::max(clay, -shape);
  }
};

/// How far from the shape it changes the clay at most: within a level's band, and where a wide
/// edge ends.
double reach_mm(float band_mm, double edge_radius_mm) {
  return std::max(static_cast<double>(band_mm), 2.0 * edge_radius_mm);
}

/// That of the tool nearest to a point.
Vec3 slope_of(std::span<const PosedTool> path, const Vec3& point_mm) {
  if (path.size() == 1) return path.front().slope(point_mm);
  const PosedTool* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const PosedTool& tool : path) {
    const double distance = tool.shrunk_distance(point_mm);
    if (distance >= least) continue;
    least = distance;
    nearest = &tool;
  }
  return nearest != nullptr ? nearest->slope(point_mm) : Vec3{0.0, 0.0, 1.0};
}

/// Rounds the edge that the shape leaves in a leaf, as far as the mask leaves matter free.
void round_edge_of(const LevelEdit& level, const LeafEdit& leaf, const StampJob& job,
                   const LeafMask& leaf_mask, const LeafValues& shape_mm, LeafValues& now) {
  LeafValues complement;
  for (std::size_t n = 0; n < kLeafNodes; ++n) complement[n] = -shape_mm[n];
  const EdgeLeaf edge{job.side(), complement, level.voxel_mm(), job.edge_radius_mm};
  if (job.edge_radius_mm == 0.0 || !edge.is_near_any(leaf.before())) return;
  HaloBlock clay;
  gather_before(level, leaf.origin, leaf.before(), job.edge_radius_mm, clay);
  const auto slope = [&](std::size_t n) {
    return -slope_of(job.path, node_mm(node_of(leaf.origin, n), level.voxel_mm()));
  };
  if (!leaf_mask.has_any()) return round_edge(edge, clay, slope, now);
  LeafValues rounded = now;
  round_edge(edge, clay, slope, rounded);
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    now[n] += static_cast<float>(leaf_mask.free_fraction(n)) * (rounded[n] - now[n]);
  }
}

/// Every node of a level with the tools' distance, at most shifted by a mask.
void stamp_level(LevelEdit& level, const StampJob& job, const Mask* mask) {
  auto& leaves = level.leaves();
  const double voxel = level.voxel_mm();
  const float band = level.band_mm();
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    LeafEdit& leaf = leaves[n];
    const Cover cover = cover_of(leaf.origin, voxel, reach_mm(band, job.edge_radius_mm), job.path);
    if (cover == Cover::none) return;
    const LeafMask leaf_mask(mask, level.level(), leaf.origin);
    LeafValues now;
    if (cover == Cover::all && !leaf_mask.has_any()) {
      now.fill(std::clamp(job.combined(0.0F, -2.0F * band), -band, band));
    } else {
      LeafValues shape;
      distances_to(job.path, leaf.origin, voxel, leaf_mask, shape);
      const float* before = leaf.before();
      for (std::size_t i = 0; i < kLeafNodes; ++i) now[i] = job.combined(before[i], shape[i]);
      round_edge_of(level, leaf, job, leaf_mask, shape, now);
      clamp_to(band, now);
    }
    leaf.write_all(now);
  });
}

/// Whether adding or carving changes anything in a leaf: not beyond the tool's band, and not where
/// there is no leaf because all of it is clay already, or air.
bool is_touched(const LevelStack& stack, int level, const Coord& origin, const StampJob& job) {
  const double reach = reach_mm(stack.band_mm(level), job.edge_radius_mm);
  if (cover_of(origin, stack.voxel_mm(level), reach, job.path) == Cover::none) return false;
  if (level == stack.top() || stack.has_leaf(level, origin)) return true;
  return any_coarse_below(stack, level + 1, origin, job.side(), stack.band_mm(level));
}

/// Of the nearest of several tools.
double distance_to(std::span<const PosedTool> path, const Vec3& point_mm) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const PosedTool& tool : path) nearest = std::min(nearest, tool.shrunk_distance(point_mm));
  return nearest;
}

/// The normal of the clay at a node, from what is stored there; zero where nothing tells.
Vec3 normal_at(const LevelStack& stack, int level, const Coord& node) {
  constexpr int kStep = 2;  // where only the next coarser level has a leaf, one of its nodes
  Vec3 slope;
  for (int a = 0; a < 3; ++a) {
    Coord low = node;
    Coord high = node;
    low[a] -= kStep;
    high[a] += kStep;
    slope[static_cast<std::size_t>(a)] =
        static_cast<double>(distance_beyond_band(stack, level, high)) -
        static_cast<double>(distance_beyond_band(stack, level, low));
  }
  const double steep = length(slope);
  return steep > 0.0 ? slope / steep : Vec3{};
}

/// Whether the surfaces of the clay and of the shape cross at an angle in or beside a leaf, taken
/// for planes.
bool is_at_edge(const LevelStack& stack, int level, const Coord& origin,
                std::span<const PosedTool> path) {
  constexpr double kLeastAngle = 0.94;  // cosine of 20 degrees: flatter ones need no finer leaves
  const double voxel = stack.voxel_mm(level);
  const Coord middle = origin.offsetBy(kLeafSide / 2);
  const double reach = (0.5 * std::sqrt(3.0) * kLeafSide + 2.0) * voxel;
  const double shape = distance_to(path, node_mm(middle, voxel));
  if (!(std::abs(shape) <= reach)) return false;
  const auto clay = static_cast<double>(distance_beyond_band(stack, level, middle));
  if (!(std::abs(clay) <= reach)) return false;
  const double cosine =
      dot(normal_at(stack, level, middle), slope_of(path, node_mm(middle, voxel)));
  if (!(std::abs(cosine) <= kLeastAngle)) return false;
  const double square = (clay * clay + shape * shape - 2.0 * cosine * clay * shape) /
                        ((1.0 - cosine) * (1.0 + cosine));
  return square <= reach * reach;
}

/// The leaves of the level below the tool's that an edge passes.
std::vector<Coord> edge_origins(const LevelStack& stack, int level,
                                std::span<const PosedTool> path) {
  const double voxel = stack.voxel_mm(level + 1);
  const std::vector<Coord> coarse = origins_in(reached_nodes(argil::bounds_of(path), voxel));
  std::vector<std::uint8_t> octants(coarse.size());
  for_each_leaf(coarse.size(), [&](std::size_t n) {
    if (cover_of(coarse[n], voxel, 2.0 * voxel, path) != Cover::some) return;
    if (!may_have_band(stack, level + 1, coarse[n])) return;
    for (int octant = 0; octant < 8; ++octant) {
      if (is_at_edge(stack, level, octant_origin(coarse[n], octant), path)) {
        octants[n] = static_cast<std::uint8_t>(octants[n] | 1U << octant);
      }
    }
  });
  std::vector<Coord> origins;
  for (std::size_t n = 0; n < coarse.size(); ++n) {
    for (int octant = 0; octant < 8; ++octant) {
      if ((octants[n] >> octant & 1) != 0) origins.push_back(octant_origin(coarse[n], octant));
    }
  }
  return origins;
}

/// Where the shape and its edges change the clay.
Box3 bounds_of(const StampJob& job) {
  Box3 bounds = argil::bounds_of(job.path);
  const double beyond = reach_mm(0.0F, job.edge_radius_mm);
  bounds.min -= Vec3{beyond, beyond, beyond};
  bounds.max += Vec3{beyond, beyond, beyond};
  return bounds;
}

/// Wants the leaves that the shape changes, and finer ones along its edge.
void want_stamped(Edit& edit, const LevelStack& stack, const StampJob& job, int tool_level,
                  bool is_masked) {
  want_reached(edit, stack, bounds_of(job), tool_level, [&](int level, const Coord& origin) {
    return is_masked || is_touched(stack, level, origin, job);
  });
  if (tool_level == 0 || is_fine_enough(stack, tool_level, job.edge_radius_mm)) return;
  const int finer = tool_level - 1;
  for (const Coord& origin : edge_origins(stack, finer, job.path)) edit.want(finer, origin);
}

/// What a mask shrinks is no distance any more, so it is redistanced.
void add_or_carve_masked(EditTarget& target, const StampJob& job, int tool_level) {
  const LevelStack& stack = target.stack;
  Edit edit(target);
  want_stamped(edit, stack, job, tool_level, true);
  edit.load();
  for (int n = 0; n < edit.count(); ++n) stamp_level(edit.level(n), job, stack.mask());
  solve_stamped(edit);
  edit.drop_empty();
  edit.commit();
}

/// Union with the tools, or with their complement cut away. Exact distance stays exact outside the
/// union and a lower bound inside, so that no level needs solving: every level is stamped with the
/// exact shape, then coarser nodes get the restriction of the finer. Nothing for a shape that is
/// shrunk below half a voxel of the finest level: no lattice would hold it. A mask m under the tool
/// shrinks it there as a strength of 1 - m would, and then the levels are redistanced.
void add_or_carve(EditTarget& target, std::span<const PosedTool> all, int tool_level, Stamp stamp) {
  assert(target.stack.is_level(tool_level));
  const LevelStack& stack = target.stack;
  // No lattice has a node in a smaller one but by chance.
  std::vector<PosedTool> path;
  double smallest_mm = std::numeric_limits<double>::infinity();
  for (const PosedTool& tool : all) {
    if (tool.shrunk_radius_mm() < 0.5 * stack.voxel_mm(0)) continue;
    smallest_mm = std::min(smallest_mm, tool.shrunk_radius_mm());
    path.push_back(tool);
  }
  if (path.empty()) return;
  const StampJob job{path, stamp,
                     edge_radius(stack, tool_level, target.edge_radius_mm, smallest_mm)};
  if (stack.mask() != nullptr && !stack.mask()->is_zero_in(bounds_of(job))) {
    return add_or_carve_masked(target, job, tool_level);
  }
  Edit edit(target);
  want_stamped(edit, stack, job, tool_level, false);
  edit.load();
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    stamp_level(level, job, nullptr);
    level.mark_changes();
    if (n == 0) continue;
    restrict_edit(edit.level(n - 1), level, RestrictedLeaves::touched);
    level.mark_changes();
  }
  edit.prune();
  edit.commit();
}

}  // namespace

void actions::add(EditTarget& target, ToolPath path, int tool_level) {
  add_or_carve(target, path.pieces, tool_level, Stamp::add);
}

void actions::carve(EditTarget& target, ToolPath path, int tool_level) {
  add_or_carve(target, path.pieces, tool_level, Stamp::carve);
}

}  // namespace argil
