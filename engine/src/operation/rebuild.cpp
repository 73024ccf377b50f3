// SPDX-License-Identifier: GPL-3.0-or-later
// Level after level from the coarsest, each leaf measured before it is known whether it is needed.
#include "operation/rebuild.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <utility>
#include <vector>

#include <openvdb/tools/SignedFloodFill.h>

#include "clay/clay_access.h"
#include "edit/build_levels.h"
#include "edit/level_edit.h"
#include "edit/prune.h"
#include "edit/redistance.h"
#include "field/nesting.h"
#include "field/parallel.h"
#include "field/prolongation.h"
#include "operation/solid.h"

namespace argil {
namespace {

using Origins = std::vector<Coord>;

/// Around the placed surface: around each node inside the ball that its distance says is inside,
/// which at the surface's ends touches it.
Box3 surface_bounds(const LevelStack& stack, const Placement& placement) {
  Box3 box;
  for (int level = 0; level < stack.count(); ++level) {
    const double voxel = stack.voxel_mm(level);
    const auto most = static_cast<float>(-voxel);
    for (auto leaf = stack.grid(level).tree().cbeginLeaf(); leaf; ++leaf) {
      const float* values = values_of(*leaf);
      for (int n = 0; n < kLeafNodes; ++n) {
        if (!(values[n] < 0.0F && values[n] >= most)) continue;
        const Coord node = leaf->origin().offsetBy(n >> 6, n >> 3 & 7, n & 7);
        const Vec3 at = rotate(placement.orientation, node_mm(node, voxel)) + placement.position_mm;
        const double reach = -static_cast<double>(values[n]);
        box.include(at - Vec3{reach, reach, reach});
        box.include(at + Vec3{reach, reach, reach});
      }
    }
  }
  return box;
}

/// Builds the levels.
class Rebuilder {
 public:
  Rebuilder(const PlacedClay& source, const RebuildTarget& target, const Progress& progress)
      : source_(source),
        target_(target),
        progress_(progress),
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
  enum class Keep { banded, needed };
  const MovedLevel* moved(int level);
  bool fill(int level, const Origins& origins, Keep keep);
  bool balance();
  void drop_empty(int level);

  const PlacedClay& source_;
  const RebuildTarget& target_;
  const Progress& progress_;
  double tolerance_mm_;
  std::unique_ptr<LevelStack> stack_;
  std::vector<std::unique_ptr<MovedLevel>> moved_;  ///< of the levels that were filled
  std::vector<LeafValues> values_;  ///< of leaves filled at once: memory for them is asked for once
};

Result<Box3> Rebuilder::checked_bounds() const {
  Box3 box = surface_bounds(levels_of(source_.clay), source_.placement);
  if (box.empty()) return box;
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

/// Kept, since balance() may fill a level again. Null: asked to stop.
const MovedLevel* Rebuilder::moved(int level) {
  assert(static_cast<std::size_t>(level) < moved_.size());
  auto& kept = moved_[static_cast<std::size_t>(level)];
  if (kept != nullptr) return kept.get();
  const double voxel = stack_->voxel_mm(level);
  auto feet = placed_feet(levels_of(source_.clay), MovedLevel::wanted(source_, voxel), progress_);
  if (feet) kept = std::make_unique<MovedLevel>(source_, voxel, std::move(*feet));
  return kept.get();
}

/// Measures the leaves and keeps those asked for. False: asked to stop.
bool Rebuilder::fill(int level, const Origins& origins, Keep keep) {
  assert(stack_->is_level(level));
  if (origins.empty()) return true;
  const MovedLevel* const moved = this->moved(level);
  if (moved == nullptr) return false;
  constexpr std::size_t kLeavesAtOnce = 4096;
  const float band = stack_->band_mm(level);
  for (std::size_t begin = 0; begin < origins.size(); begin += kLeavesAtOnce) {
    const double done = static_cast<double>(begin) / static_cast<double>(origins.size());
    if (progress_ && !progress_("distance", done)) return false;
    const std::size_t count = std::min(kLeavesAtOnce, origins.size() - begin);
    values_.resize(std::max(values_.size(), count));
    std::vector<std::uint8_t> kept(count, 0);
    for_each_leaf(count, [&](std::size_t n) {
      const Coord& origin = origins[begin + n];
      bool has_detail = false;
      if (!moved->fill(origin, values_[n], has_detail)) return;
      if (!has_band(values_[n].data(), band)) return;
      const bool is_kept =
          keep == Keep::banded || has_detail ||
          coarser_misses(values_[n].data(), coarse_nodes(*stack_, level + 1, origin),
                         coarsening_criterion(*stack_, level, tolerance_mm_));
      kept[n] = is_kept ? 1 : 0;
    });
    for (std::size_t n = 0; n < count; ++n) {
      if (kept[n] != 0) stack_->set_leaf(level, origins[begin + n], values_[n].data());
    }
  }
  return true;
}

/// Adds the coarser leaves that finer ones require.
bool Rebuilder::balance() {
  moved_[0].reset();  // the most of them, and nothing is finer
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
  moved_.clear();
  return true;
}

/// What was solved again may lie beyond the band, all of a leaf.
void Rebuilder::drop_empty(int level) {
  const float band = stack_->band_mm(level);
  for (const Coord& origin : stack_->sorted_origins(level)) {
    if (!is_empty(*stack_, level, origin)) continue;
    const float value = values_of(*stack_->leaf(level, origin))[0];
    stack_->erase_leaf(level, origin, value < 0.0F ? -band : band);
  }
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
  moved_.resize(static_cast<std::size_t>(levels));
  if (box.value().empty()) return std::move(stack_);
  const int top = stack_->top();
  if (!fill(top, top_origins(box.value()), Keep::banded)) return interrupted;
  openvdb::tools::signedFloodFill(stack_->grid(top).tree());
  for (int level = top - 1; level >= 0; --level) {
    if (!fill(level, octants(level), Keep::needed)) return interrupted;
  }
  if (!balance()) return interrupted;
  values_ = {};
  const bool is_a_distance = source_.offset_mm == 0.0;
  if (!is_a_distance && !redistance_shortened(*stack_, source_.offset_mm < 0.0, progress_)) {
    return interrupted;
  }
  restrict_all(*stack_);
  for (int level = 0; level < top; ++level) {
    prune_level(*stack_, level, tolerance_of(target_.options));
  }
  for (int level = 0; level <= top; ++level) drop_empty(level);
  return std::move(stack_);
}

}  // namespace

Result<std::unique_ptr<LevelStack>> rebuild(const PlacedClay& source, const RebuildTarget& target,
                                            const Progress& progress) {
  assert(std::isfinite(source.offset_mm) && is_finite(source.placement.position_mm));
  return Rebuilder(source, target, progress).run();
}

}  // namespace argil
