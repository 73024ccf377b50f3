// SPDX-License-Identifier: GPL-3.0-or-later
// What a clay is made of and what can be asked of it without changing it.
#include "argil/engine/clay.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <sstream>

#include "clay/clay_access.h"
#include "clay/clay_hash.h"
#include "clay/clay_state.h"
#include "edit/build_levels.h"
#include "field/level_stack.h"

namespace argil {
namespace {

bool holds(const Box3& box, const Vec3& point) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (point[a] < box.min[a] || point[a] > box.max[a]) return false;
  }
  return true;
}

/// How far a clay may reach from the origin: a few leaves less than there are nodes, since bands
/// and strokes reach beyond the surface.
double most_reach_mm(double voxel_mm) { return std::min((kMaxNode - 64) * voxel_mm, kMaxReachMm); }

Result<void> validate_size(double size_mm, const ClayOptions& options, const char* name) {
  const double most = most_reach_mm(options.voxel_mm);
  if (std::isfinite(size_mm) && size_mm >= 8.0 * options.voxel_mm && size_mm <= most) return {};
  std::ostringstream message;
  message << name << " is " << size_mm << " mm; with a voxel of " << options.voxel_mm
          << " mm it must be from " << 8.0 * options.voxel_mm << " to " << most << " mm";
  return Error{ErrorKind::bad_input, message.str()};
}

/// Each comparison is false for NaN, so that NaN is refused with the rest.
Result<void> validate_bounds(const Box3& bounds_mm, const ClayOptions& options) {
  const double least = 8.0 * options.voxel_mm;
  const double most = most_reach_mm(options.voxel_mm);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = bounds_mm.min[axis];
    const double high = bounds_mm.max[axis];
    if (high - low >= least && low >= -most && high <= most) continue;  // false for NaN
    std::ostringstream message;
    message << "bounds_mm reaches from " << low << " to " << high << " mm along axis " << axis
            << "; with a voxel of " << options.voxel_mm << " mm it must be at least " << least
            << " mm wide and stay within " << most << " mm of the origin";
    return Error{ErrorKind::bad_input, message.str()};
  }
  return {};
}

}  // namespace

Result<void> validate_options(const ClayOptions& options) {
  const double edge = options.edge_radius_mm.value_or(0.0);
  std::ostringstream message;
  if (!(options.voxel_mm >= kLeastVoxelMm && options.voxel_mm <= kMostVoxelMm)) {  // also for NaN
    message << "voxel_mm is " << options.voxel_mm << "; must be from " << kLeastVoxelMm << " to "
            << kMostVoxelMm << "; choose another, or scale the model";
  } else if (!(options.tolerance_voxels >= 0.01 && options.tolerance_voxels <= 0.5)) {
    message << "tolerance_voxels is " << options.tolerance_voxels << "; must be from 0.01 to 0.5";
  } else if (!(edge >= 0.0 && edge <= kMostEdgeRadiusMm)) {
    message << "edge_radius_mm is " << edge << "; must be from 0 to " << kMostEdgeRadiusMm;
  } else {
    return {};
  }
  return Error{ErrorKind::bad_input, message.str()};
}

Clay::Clay(std::unique_ptr<State> state) : state_(std::move(state)) {}
Clay::Clay(Clay&&) noexcept = default;
Clay& Clay::operator=(Clay&&) noexcept = default;
Clay::~Clay() = default;

Clay Clay::from_levels(std::unique_ptr<LevelStack> levels, const ClayOptions& options) {
  return Clay(std::make_unique<State>(std::move(levels), options));
}

Result<Clay> Clay::ball(double radius_mm, const ClayOptions& options) {
  if (auto ok = validate_options(options); !ok) return ok.error();
  if (auto ok = validate_size(radius_mm, options, "radius_mm"); !ok) return ok.error();
  Box3 box;
  box.include(Vec3{-radius_mm, -radius_mm, -radius_mm});
  box.include(Vec3{radius_mm, radius_mm, radius_mm});
  return from_distance([=](const Vec3& p) { return length(p) - radius_mm; }, box, options);
}

Result<Clay> Clay::block(const Vec3& size_mm, const ClayOptions& options) {
  if (auto ok = validate_options(options); !ok) return ok.error();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (auto ok = validate_size(size_mm[axis], options, "size_mm"); !ok) return ok.error();
  }
  const Vec3 half = size_mm * 0.5;
  const auto distance = [half](const Vec3& p) {
    const Vec3 d{std::abs(p.x) - half.x, std::abs(p.y) - half.y, std::abs(p.z) - half.z};
    const Vec3 out{std::max(d.x, 0.0), std::max(d.y, 0.0), std::max(d.z, 0.0)};
    return length(out) + std::min(0.0, std::max({d.x, d.y, d.z}));
  };
  Box3 box;
  box.include(-half);
  box.include(half);
  return from_distance(distance, box, options);
}

Result<Clay> Clay::from_distance(const std::function<double(const Vec3&)>& distance_mm,
                                 const Box3& bounds_mm, const ClayOptions& options) {
  if (auto ok = validate_options(options); !ok) return ok.error();
  if (auto ok = validate_bounds(bounds_mm, options); !ok) return ok.error();
  if (!distance_mm) return Error{ErrorKind::bad_input, "no formula for the distance was given"};
  std::atomic<bool> finite{true};
  const auto checked = [&](const Vec3& point_mm) {
    const double distance = distance_mm(point_mm);
    if (std::isfinite(distance)) return distance;
    finite.store(false, std::memory_order_relaxed);
    return 0.0;
  };
  try {
    auto stack = stack_from_distance(checked, bounds_mm, options);
    if (!finite.load()) {
      return Error{
          ErrorKind::bad_input,
          "the distance is not a finite number somewhere within the bounds; mend the formula"};
    }
    Clay clay = from_levels(std::move(stack), options);
    clay.state_->make_symmetric();
    return clay;
  } catch (const std::bad_alloc&) {
    return out_of_memory("make the clay");
  }
}

const ClayOptions& Clay::options() const noexcept { return state_->options; }
int Clay::level_count() const noexcept { return state_->levels->count(); }
const LevelStack& Clay::levels() const noexcept { return *state_->levels; }

std::vector<LevelStats> Clay::level_stats() const {
  std::vector<LevelStats> stats;
  for (int level = 0; level < level_count(); ++level) {
    const auto& tree = levels().grid(level).tree();
    stats.push_back(
        {level, levels().voxel_mm(level), static_cast<std::int64_t>(tree.activeVoxelCount()),
         static_cast<std::int64_t>(tree.leafCount()), static_cast<std::int64_t>(tree.memUsage())});
  }
  return stats;
}

std::uint64_t Clay::hash() const { return hash_of_levels(levels()); }

/// The finest level that stores the cell answers; beyond what integers can address all is air.
double Clay::distance_at(const Vec3& point_mm) const {
  const LevelStack& stack = levels();
  for (int level = 0; level < stack.count(); ++level) {
    const double h = stack.voxel_mm(level);
    const Vec3 at = point_mm / h;
    const Vec3 low{std::floor(at.x), std::floor(at.y), std::floor(at.z)};
    if (!(std::abs(low.x) < 1e9 && std::abs(low.y) < 1e9 && std::abs(low.z) < 1e9)) break;
    const Coord node(static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(low.z));
    if (level < stack.top() && !stack.has_leaf(level, node)) continue;
    const Vec3 t = at - low;
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const int i = corner >> 2;
      const int j = (corner >> 1) & 1;
      const int k = corner & 1;
      const double weight = (i ? t.x : 1.0 - t.x) * (j ? t.y : 1.0 - t.y) * (k ? t.z : 1.0 - t.z);
      sum += weight * static_cast<double>(stack.node_value(level, node.offsetBy(i, j, k)));
    }
    return sum;
  }
  return static_cast<double>(stack.band_mm(stack.top()));
}

Box3 Clay::bounds_mm() const {
  Box3 box;
  for (int level = 0; level < level_count(); ++level) {
    const double h = levels().voxel_mm(level);
    const auto outside = static_cast<float>(h);
    for (auto leaf = levels().grid(level).tree().cbeginLeaf(); leaf; ++leaf) {
      const Coord last = leaf->origin().offsetBy(kLeafSide - 1);
      if (holds(box, node_mm(leaf->origin(), h)) && holds(box, node_mm(last, h))) continue;
      const float* values = values_of(*leaf);
      for (int n = 0; n < kLeafNodes; ++n) {
        if (!(values[n] < outside) || values[n] <= -levels().band_mm(level)) continue;
        box.include(node_mm(leaf->origin().offsetBy(n >> 6, n >> 3 & 7, n & 7), h));
      }
    }
  }
  return box;
}

std::uint64_t ClayAccess::identity(const Clay& clay) noexcept { return clay.state_->identity; }

std::uint64_t ClayAccess::revision(const Clay& clay) noexcept {
  return clay.state_->forgotten + clay.state_->changes.size();
}

std::optional<std::vector<LeafChange>> ClayAccess::changes_since(const Clay& clay,
                                                                 std::uint64_t since) {
  const Clay::State& state = *clay.state_;
  if (since < state.forgotten) return std::nullopt;
  return std::vector<LeafChange>(
      state.changes.begin() + static_cast<std::ptrdiff_t>(since - state.forgotten),
      state.changes.end());
}

}  // namespace argil
