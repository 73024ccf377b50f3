// SPDX-License-Identifier: GPL-3.0-or-later
// The source's surface as triangles, and for each leaf looked at the exact distance of its nodes to
// them. The side of a node is that of its neighbour where no surface can pass between the two,
// which saves most of the questions.
#include "operation/rebuild.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>
#include <unordered_map>
#include <vector>

#include <openvdb/tools/SignedFloodFill.h>

#include "argil/engine/mesh_distance.h"
#include "argil/engine/surface.h"

#include "clay/clay_access.h"
#include "edit/build_levels.h"
#include "edit/level_edit.h"
#include "edit/prune.h"
#include "field/nesting.h"
#include "field/parallel.h"
#include "field/prolongation.h"
#include "operation/solid.h"

namespace argil {
namespace {

using Origins = std::vector<Coord>;

Vec3 placed(const Placement& placement, const Vec3& p) {
  return rotate(placement.orientation, p) + placement.position_mm;
}

Vec3 taken_back(const Placement& placement, const Vec3& p) {
  return rotate(conjugate(placement.orientation), p - placement.position_mm);
}

/// How fine the leaves of a clay are around a point.
class DetailMap {
 public:
  explicit DetailMap(const LevelStack& stack) : stack_(stack) {
    finest_.resize(static_cast<std::size_t>(stack.count()));
    for (int level = 0; level < stack.count(); ++level) {
      auto& here = finest_[static_cast<std::size_t>(level)];
      for (const Coord& origin : stack.sorted_origins(level)) here.emplace(origin, level);
      if (level == 0) continue;
      for (const auto& [origin, finest] : finest_[static_cast<std::size_t>(level) - 1]) {
        const auto parent = here.find(leaf_origin(coarser(origin)));
        if (parent != here.end()) parent->second = std::min(parent->second, finest);
      }
    }
  }

  /// Whether leaves with voxels below `voxel_mm` may lie within `reach_mm` of a point: never false
  /// when one does.
  bool finer_than(double voxel_mm, const Vec3& place_mm, double reach_mm) const {
    int wanted = stack_.top();
    while (wanted >= 0 && stack_.voxel_mm(wanted) >= voxel_mm) --wanted;
    if (wanted < 0) return false;
    int level = wanted;
    while (level < stack_.top() && kLeafSide * stack_.voxel_mm(level) < reach_mm) ++level;
    const double h = stack_.voxel_mm(level);
    const Vec3 reach{reach_mm, reach_mm, reach_mm};
    const auto& leaves = finest_[static_cast<std::size_t>(level)];
    bool found = false;
    for_each_leaf_origin(nodes_covering({place_mm - reach, place_mm + reach}, h),
                         [&](const Coord& origin) {
                           if (found) return;
                           const auto at = leaves.find(origin);
                           found = at != leaves.end() && at->second <= wanted;
                         });
    return found;
  }

 private:
  const LevelStack& stack_;
  std::vector<std::unordered_map<Coord, int>> finest_;  ///< the finest level at or below a leaf
};

/// The distance to a placed clay's surface, less the offset.
class SourceDistance {
 public:
  explicit SourceDistance(const RebuildSource& source)
      : source_(source), mesh_(placed_surface(source)), closest_(mesh_.positions, mesh_.triangles) {
    for (const Vec3& p : mesh_.positions) bounds_.include(p);
  }

  /// Of the surface before the offset.
  const Box3& bounds() const noexcept { return bounds_; }
  bool is_empty() const noexcept { return mesh_.triangles.empty(); }

  /// Whether no node of a leaf lies within the band.
  bool is_far(const Vec3& middle, double half_diagonal, double band, std::uint32_t& hint) const {
    const double reach = half_diagonal + band + std::abs(source_.offset_mm);
    const auto found = closest_.closest(middle, reach, hint);
    if (found.triangle == kNoTriangle) return true;
    hint = found.triangle;
    const double distance = is_inside(middle) ? -found.distance : found.distance;
    return std::abs(distance - source_.offset_mm) > half_diagonal + band;
  }

  void fill(const Coord& origin, double voxel, std::uint32_t hint, LeafValues& out) const;

 private:
  static TriangleMesh placed_surface(const RebuildSource& source) {
    TriangleMesh mesh = extract_surface(source.clay);
    mesh.normals.clear();
    for (Vec3& p : mesh.positions) p = placed(source.placement, p);
    return mesh;
  }
  bool is_inside(const Vec3& p) const {
    return source_.clay.distance_at(taken_back(source_.placement, p)) < 0.0;
  }

  const RebuildSource& source_;
  TriangleMesh mesh_;
  MeshDistance closest_;
  Box3 bounds_;
};

void SourceDistance::fill(const Coord& origin, double voxel, std::uint32_t hint,
                          LeafValues& out) const {
  assert(is_leaf_origin(origin) && voxel > 0.0);
  const double band = kHalfWidthVoxels * voxel;
  const double reach = band + std::abs(source_.offset_mm);
  const double step = voxel * (1.0 + 1e-6);
  struct Known {
    double distance = 0.0;
    bool inside = false;
  };
  // No surface passes between nodes whose distances sum to more than what lies between them. Nearer
  // than a voxel the field's side may be another than that of its triangles: such a node's side is
  // asked, and not handed on.
  const double clear = source_.clay.options().voxel_mm;
  const auto known = [&](const Vec3& p, const Known* beside) {
    const auto found = closest_.closest(p, reach, hint);
    if (found.triangle != kNoTriangle) hint = found.triangle;
    const bool follows = beside != nullptr && beside->distance > clear && found.distance > clear &&
                         beside->distance + found.distance > step;
    return Known{found.distance, follows ? beside->inside : is_inside(p)};
  };
  Known first_of_plane;
  Known first_of_row;
  Known last;
  for (int n = 0; n < kLeafNodes; ++n) {
    const Coord node = origin.offsetBy(n >> 6, (n >> 3) & 7, n & 7);
    const Known* beside = &last;
    if (n % 8 == 0) beside = n % 64 == 0 ? &first_of_plane : &first_of_row;
    last = known(node_mm(node, voxel), n == 0 ? nullptr : beside);
    if (n % 8 == 0) first_of_row = last;
    if (n % 64 == 0) first_of_plane = last;
    const double value = (last.inside ? -last.distance : last.distance) - source_.offset_mm;
    out[static_cast<std::size_t>(n)] = static_cast<float>(std::clamp(value, -band, band));
  }
}

/// Builds the levels.
class Rebuilder {
 public:
  Rebuilder(const RebuildSource& source, const RebuildTarget& target, const Progress& progress)
      : source_(source),
        target_(target),
        progress_(progress),
        detail_(levels_of(source.clay)),
        distance_(source),
        tolerance_mm_(std::max(tolerance_of(target.options), tolerance_of(source.clay.options()))) {
  }

  Result<std::unique_ptr<LevelStack>> run();

 private:
  static double tolerance_of(const ClayOptions& options) {
    return options.tolerance_voxels * options.voxel_mm;
  }
  Result<Box3> checked_bounds() const;
  Origins top_origins(const Box3& box) const;
  Origins octants(int level) const;
  bool is_kept(int level, const Coord& origin, const LeafValues& values) const;
  enum class Keep { banded, needed };
  bool fill(int level, const Origins& origins, Keep keep);
  bool balance();

  const RebuildSource& source_;
  const RebuildTarget& target_;
  const Progress& progress_;
  DetailMap detail_;
  SourceDistance distance_;
  double tolerance_mm_;
  std::unique_ptr<LevelStack> stack_;
};

Result<Box3> Rebuilder::checked_bounds() const {
  Box3 box = distance_.bounds();
  const double grow = std::max(0.0, source_.offset_mm);
  box.min -= Vec3{grow, grow, grow};
  box.max += Vec3{grow, grow, grow};
  const double most = (kMaxNode - 64) * target_.options.voxel_mm;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double reach = std::max(std::abs(box.min[axis]), std::abs(box.max[axis]));
    if (reach <= most) continue;
    std::ostringstream message;
    message << "the result reaches " << reach << " mm from the origin, and voxels of "
            << target_.options.voxel_mm << " mm can address " << most
            << " mm; use a larger voxel or a smaller distance";
    return Error{ErrorKind::bad_input, message.str()};
  }
  return box;
}

Origins Rebuilder::top_origins(const Box3& box) const {
  openvdb::CoordBBox nodes = nodes_covering(box, stack_->voxel_mm(stack_->top()));
  nodes.expand(kHalfWidthVoxels + 1);
  Origins origins;
  for_each_leaf_origin(nodes, [&](const Coord& origin) { origins.push_back(origin); });
  return origins;
}

Origins Rebuilder::octants(int level) const {
  Origins origins;
  for (const Coord& parent : stack_->sorted_origins(level + 1)) {
    for_each_leaf_origin({parent << 1, (parent << 1).offsetBy(2 * kLeafSide - 1)},
                         [&](const Coord& origin) { origins.push_back(origin); });
  }
  return origins;
}

bool Rebuilder::is_kept(int level, const Coord& origin, const LeafValues& values) const {
  assert(level < stack_->top());
  const double voxel = stack_->voxel_mm(level);
  const double half = 0.5 * kLeafSide * voxel;
  const Vec3 middle = node_mm(origin, voxel) + Vec3{half, half, half};
  const double reach = (half + voxel) * std::sqrt(3.0) + std::abs(source_.offset_mm);
  if (detail_.finer_than(1.999 * voxel, taken_back(source_.placement, middle), reach)) return true;
  return coarser_misses(values.data(), coarse_nodes(*stack_, level + 1, origin),
                        coarsening_criterion(*stack_, level, tolerance_mm_));
}

/// Measures the leaves and keeps those asked for. False: asked to stop.
bool Rebuilder::fill(int level, const Origins& origins, Keep keep) {
  assert(stack_->is_level(level));
  constexpr std::size_t kLeavesAtOnce = 2048;
  const double voxel = stack_->voxel_mm(level);
  const double band = kHalfWidthVoxels * voxel;
  const double half = 0.5 * (kLeafSide - 1) * voxel;
  for (std::size_t begin = 0; begin < origins.size(); begin += kLeavesAtOnce) {
    const double done = static_cast<double>(begin) / static_cast<double>(origins.size());
    if (progress_ && !progress_("distance", done)) return false;
    const std::size_t count = std::min(kLeavesAtOnce, origins.size() - begin);
    std::vector<LeafValues> values(count);
    std::vector<std::uint8_t> kept(count, 0);
    for_each_leaf(count, [&](std::size_t n) {
      const Coord& origin = origins[begin + n];
      const Vec3 middle = node_mm(origin, voxel) + Vec3{half, half, half};
      std::uint32_t hint = kNoTriangle;
      if (distance_.is_far(middle, half * std::sqrt(3.0), band, hint)) return;
      distance_.fill(origin, voxel, hint, values[n]);
      if (!has_band(values[n].data(), stack_->band_mm(level))) return;
      kept[n] = keep == Keep::banded || is_kept(level, origin, values[n]) ? 1 : 0;
    });
    for (std::size_t n = 0; n < count; ++n) {
      if (kept[n] != 0) stack_->set_leaf(level, origins[begin + n], values[n].data());
    }
  }
  return true;
}

/// Adds the coarser leaves that finer ones require.
bool Rebuilder::balance() {
  for (int level = 0; level < stack_->top(); ++level) {
    Origins required;
    for (const Coord& origin : stack_->sorted_origins(level)) {
      for_each_required_parent(origin, [&](const Coord& coarse) {
        if (!stack_->has_leaf(level + 1, coarse)) required.push_back(coarse);
      });
    }
    std::sort(required.begin(), required.end());
    required.erase(std::unique(required.begin(), required.end()), required.end());
    if (!fill(level + 1, required, Keep::banded)) return false;
  }
  return true;
}

Result<std::unique_ptr<LevelStack>> Rebuilder::run() {
  const Error interrupted{ErrorKind::interrupted, "interrupted; the clay is as it was"};
  const auto box = checked_bounds();
  if (!box) return box.error();
  const Vec3 size = box.value().size();
  const double voxel = target_.options.voxel_mm;
  const int levels =
      target_.levels > 0 ? target_.levels : levels_for(std::max({size.x, size.y, size.z}), voxel);
  stack_ = std::make_unique<LevelStack>(voxel, levels);
  if (distance_.is_empty()) return std::move(stack_);
  const int top = stack_->top();
  if (!fill(top, top_origins(box.value()), Keep::banded)) return interrupted;
  openvdb::tools::signedFloodFill(stack_->grid(top).tree());
  for (int level = top - 1; level >= 0; --level) {
    if (!fill(level, octants(level), Keep::needed)) return interrupted;
  }
  if (!balance()) return interrupted;
  restrict_all(*stack_);
  for (int level = 0; level < top; ++level) {
    prune_level(*stack_, level, tolerance_of(target_.options));
  }
  return std::move(stack_);
}

}  // namespace

Result<std::unique_ptr<LevelStack>> rebuild(const RebuildSource& source,
                                            const RebuildTarget& target, const Progress& progress) {
  assert(std::isfinite(source.offset_mm) && is_finite(source.placement.position_mm));
  if (progress && !progress("surface", 0.0)) {
    return Error{ErrorKind::interrupted, "interrupted; the clay is as it was"};
  }
  return Rebuilder(source, target, progress).run();
}

}  // namespace argil
