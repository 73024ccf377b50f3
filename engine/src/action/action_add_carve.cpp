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
#include <utility>
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
  std::span<const ToolPath> images;
  Stamp stamp;
  double edge_radius_mm;

  float side() const noexcept { return stamp == Stamp::add ? -1.0F : 1.0F; }
  /// Of the distances of the clay and the shape: the minimum, or the maximum with the complement.
  float combined(float clay, float shape) const noexcept {
    return stamp == Stamp::add ? std::min(clay, shape) : std::max(clay, -shape);
  }
  /// Of two results.
  float both(float a, float b) const noexcept {
    return stamp == Stamp::add ? std::min(a, b) : std::max(a, b);
  }
};

/// What one or more of the images do to a whole leaf at most.
Cover cover_of(const Coord& origin, double voxel_mm, double band_mm, const StampJob& job) {
  Cover most = Cover::none;
  for (const ToolPath& path : job.images) {
    const Cover cover = cover_of(origin, voxel_mm, band_mm, path);
    if (cover == Cover::all) return Cover::all;
    if (cover == Cover::some) most = Cover::some;
  }
  return most;
}

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

/// One image at the nodes of a leaf.
struct ImageAtLeaf {
  const ToolPath* path;
  LeafValues shape_mm;
  LeafValues complement_mm;
};

/// A leaf, and the images that reach it.
class StampedLeaf {
 public:
  StampedLeaf(const LevelEdit& level, const LeafEdit& leaf, const StampJob& job, const Mask* mask)
      : level_(level), leaf_(leaf), job_(job), mask_(mask, level.level(), leaf.origin) {}

  /// False where no image does anything.
  bool stamp(LeafValues& now);

 private:
  void add_image(const ToolPath& path);
  void round_with_clay(const ImageAtLeaf& image, LeafValues& now) const;
  Vec3 slope_at(const ImageAtLeaf& image, std::size_t n) const {
    return -slope_of(*image.path, node_mm(node_of(leaf_.origin, n), level_.voxel_mm()));
  }
  EdgeLeaf edge_with(float side, const LeafValues& other) const {
    return {side, other, level_.voxel_mm(), job_.edge_radius_mm};
  }

  const LevelEdit& level_;
  const LeafEdit& leaf_;
  const StampJob& job_;
  LeafMask mask_;
  std::vector<ImageAtLeaf> images_;
};

void StampedLeaf::add_image(const ToolPath& path) {
  ImageAtLeaf& image = images_.emplace_back();
  image.path = &path;
  distances_to(path, leaf_.origin, level_.voxel_mm(), mask_, image.shape_mm);
  for (std::size_t n = 0; n < kLeafNodes; ++n) image.complement_mm[n] = -image.shape_mm[n];
}

/// The edge that an image leaves in the clay, as far as the mask leaves matter free.
void StampedLeaf::round_with_clay(const ImageAtLeaf& image, LeafValues& now) const {
  const EdgeLeaf edge = edge_with(job_.side(), image.complement_mm);
  if (job_.edge_radius_mm == 0.0 || !edge.is_near_any(leaf_.before())) return;
  HaloBlock clay;
  gather_before(level_, leaf_.origin, leaf_.before(), job_.edge_radius_mm, clay);
  LeafValues rounded = now;
  round_edge(
      edge, clay, [&](std::size_t n) { return slope_at(image, n); }, rounded);
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    now[n] = mask_.has_any()
                 ? now[n] + static_cast<float>(mask_.free_fraction(n)) * (rounded[n] - now[n])
                 : rounded[n];
  }
}

bool StampedLeaf::stamp(LeafValues& now) {
  const float band = level_.band_mm();
  const double reach = reach_mm(band, job_.edge_radius_mm);
  for (const ToolPath& path : job_.images) {
    const Cover cover = cover_of(leaf_.origin, level_.voxel_mm(), reach, path);
    if (cover == Cover::all && !mask_.has_any()) {
      now.fill(std::clamp(job_.combined(0.0F, -2.0F * band), -band, band));
      return true;
    }
    if (cover != Cover::none) add_image(path);
  }
  if (images_.empty()) return false;
  std::copy_n(leaf_.before(), kLeafNodes, now.begin());
  for (const ImageAtLeaf& image : images_) {
    LeafValues one;
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      one[n] = job_.combined(leaf_.before()[n], image.shape_mm[n]);
    }
    round_with_clay(image, one);
    for (std::size_t n = 0; n < kLeafNodes; ++n) now[n] = job_.both(now[n], one[n]);
  }
  clamp_to(band, now);
  return true;
}

/// Every node of a level with the tools' distance, at most shifted by a mask.
void stamp_level(LevelEdit& level, const StampJob& job, const Mask* mask) {
  auto& leaves = level.leaves();
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    LeafValues now;
    if (StampedLeaf(level, leaves[n], job, mask).stamp(now)) leaves[n].write_all(now);
  });
}

/// Whether adding or carving changes anything in a leaf: not beyond the tool's band, and not where
/// there is no leaf because all of it is clay already, or air.
bool is_touched(const LevelStack& stack, int level, const Coord& origin, const StampJob& job) {
  const double reach = reach_mm(stack.band_mm(level), job.edge_radius_mm);
  if (cover_of(origin, stack.voxel_mm(level), reach, job) == Cover::none) return false;
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

/// A surface near a leaf, taken for a plane.
struct NearPlane {
  double distance_mm;
  Vec3 normal;
};

/// Whether two planes cross at an angle within reach of the place that their distances are from.
bool cross_within(const NearPlane& a, const NearPlane& b, double reach_mm) {
  constexpr double kLeastAngle = 0.94;  // cosine of 20 degrees: flatter ones need no finer leaves
  const double cosine = dot(a.normal, b.normal);
  if (!(std::abs(cosine) <= kLeastAngle)) return false;
  const double square = (a.distance_mm * a.distance_mm + b.distance_mm * b.distance_mm -
                         2.0 * cosine * a.distance_mm * b.distance_mm) /
                        ((1.0 - cosine) * (1.0 + cosine));
  return square <= reach_mm * reach_mm;
}

/// Whether the surfaces of the clay and of an image cross in or beside a leaf.
bool is_at_edge(const LevelStack& stack, int level, const Coord& origin, const StampJob& job) {
  const double voxel = stack.voxel_mm(level);
  const Coord middle = origin.offsetBy(kLeafSide / 2);
  const Vec3 middle_mm = node_mm(middle, voxel);
  const double reach = (0.5 * std::sqrt(3.0) * kLeafSide + 2.0) * voxel;
  const auto is_near = [&](const ToolPath& path) {
    return std::abs(distance_to(path, middle_mm)) <= reach;
  };
  if (std::none_of(job.images.begin(), job.images.end(), is_near)) return false;
  const auto distance = static_cast<double>(distance_beyond_band(stack, level, middle));
  if (std::abs(distance) > reach) return false;
  const NearPlane clay{distance, normal_at(stack, level, middle)};
  return std::any_of(job.images.begin(), job.images.end(), [&](const ToolPath& path) {
    if (!is_near(path)) return false;
    const NearPlane shape{distance_to(path, middle_mm), slope_of(path, middle_mm)};
    return cross_within(clay, shape, reach);
  });
}

/// Wants the leaves of the level below the tool's that an edge of one image passes.
void want_edges(Edit& edit, const LevelStack& stack, const StampJob& job, const ToolPath& path,
                int tool_level) {
  const int level = tool_level - 1;
  const double voxel = stack.voxel_mm(tool_level);
  const double near = (0.5 * std::sqrt(3.0) * kLeafSide + 2.0) * voxel;
  const std::vector<Coord> coarse = origins_in(reached_nodes(bounds_of(path), voxel));
  std::vector<std::uint8_t> octants(coarse.size());
  for_each_leaf(coarse.size(), [&](std::size_t n) {
    // From the middle of its cells, which mirror images share.
    const Vec3 middle = node_mm(coarse[n].offsetBy(kLeafSide / 2), voxel);
    if (std::abs(distance_to(path, middle)) > near) return;
    if (!may_have_band(stack, tool_level, coarse[n])) return;
    for (int octant = 0; octant < 8; ++octant) {
      if (is_at_edge(stack, level, octant_origin(coarse[n], octant), job)) {
        octants[n] = static_cast<std::uint8_t>(octants[n] | 1U << octant);
      }
    }
  });
  for (std::size_t n = 0; n < coarse.size(); ++n) {
    for (int octant = 0; octant < 8; ++octant) {
      if ((octants[n] >> octant & 1) != 0) edit.want(level, octant_origin(coarse[n], octant));
    }
  }
}

/// Where an image and its edges change the clay.
Box3 reached_by(const ToolPath& path, double edge_radius_mm) {
  Box3 bounds = bounds_of(path);
  const double beyond = reach_mm(0.0F, edge_radius_mm);
  bounds.min -= Vec3{beyond, beyond, beyond};
  bounds.max += Vec3{beyond, beyond, beyond};
  return bounds;
}

/// Wants the leaves that the images change, and finer ones along their edges.
void want_stamped(Edit& edit, const LevelStack& stack, const StampJob& job, int tool_level,
                  bool is_masked) {
  for (const ToolPath& path : job.images) {
    want_reached(edit, stack, reached_by(path, job.edge_radius_mm), tool_level,
                 [&](int level, const Coord& origin) {
                   return is_masked || is_touched(stack, level, origin, job);
                 });
    if (tool_level == 0 || is_fine_enough(stack, tool_level, job.edge_radius_mm)) continue;
    want_edges(edit, stack, job, path, tool_level);
  }
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
void add_or_carve(EditTarget& target, std::span<const ToolPath> all, int tool_level, Stamp stamp) {
  assert(target.stack.is_level(tool_level));
  const LevelStack& stack = target.stack;
  // No lattice has a node in a smaller one but by chance.
  std::vector<ToolPath> images;
  double smallest_mm = std::numeric_limits<double>::infinity();
  for (const ToolPath& given : all) {
    ToolPath path;
    for (const PosedTool& tool : given) {
      if (tool.shrunk_radius_mm() < 0.5 * stack.voxel_mm(0)) continue;
      smallest_mm = std::min(smallest_mm, tool.shrunk_radius_mm());
      path.push_back(tool);
    }
    if (!path.empty()) images.push_back(std::move(path));
  }
  if (images.empty()) return;
  const StampJob job{images, stamp,
                     edge_radius(stack, tool_level, target.edge_radius_mm, smallest_mm)};
  const Mask* mask = stack.mask();
  const bool is_masked =
      mask != nullptr && std::any_of(images.begin(), images.end(), [&](const ToolPath& path) {
        return !mask->is_zero_in(reached_by(path, job.edge_radius_mm));
      });
  if (is_masked) return add_or_carve_masked(target, job, tool_level);
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

void actions::add(EditTarget& target, std::span<const ToolPath> images, int tool_level) {
  add_or_carve(target, images, tool_level, Stamp::add);
}

void actions::carve(EditTarget& target, std::span<const ToolPath> images, int tool_level) {
  add_or_carve(target, images, tool_level, Stamp::carve);
}

}  // namespace argil
