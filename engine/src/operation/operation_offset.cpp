// SPDX-License-Identifier: GPL-3.0-or-later
// Offset and resample: all levels rebuilt, or moved up and down the stack.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "clay/clay_access.h"
#include "edit/build_levels.h"
#include "edit/prune.h"
#include "edit/redistance.h"
#include "operation/combine.h"
#include "operation/prepared_operation.h"
#include "operation/rebuild.h"

namespace argil {
namespace {

/// New levels in place of all, as good as those that strokes leave.
Result<PreparedOperation> replaced_by(std::unique_ptr<LevelStack> levels,
                                      const ClayOptions& options, const std::string& if_empty,
                                      const Progress& progress) {
  if (!has_inside(*levels)) return bad_operation(if_empty);
  const double tolerance = options.tolerance_voxels * options.voxel_mm;
  if (!redistance_levels(*levels, tolerance, progress)) return operation_interrupted();
  PreparedOperation prepared;
  prepared.levels = FormerLevels{std::move(levels), options};
  return prepared;
}

/// By how many levels a voxel is coarser than another, when that is a whole number.
std::optional<int> levels_between(double from_mm, double to_mm) {
  constexpr int kMost = 60;
  for (int k = -kMost; k <= kMost; ++k) {
    const double exact = std::ldexp(from_mm, k);
    if (std::abs(to_mm - exact) <= 1e-9 * exact) return k;
  }
  return std::nullopt;
}

/// The levels from `by` on, or with `-by` empty ones below.
std::unique_ptr<LevelStack> moved_levels(const LevelStack& from, int by,
                                         const ClayOptions& options) {
  assert(by < from.count());
  auto stack = std::make_unique<LevelStack>(options.voxel_mm, from.count() - by);
  for (int level = std::max(0, -by); level < stack->count(); ++level) {
    stack->grid(level).setTree(from.grid(level + by).tree().copy());
  }
  if (by <= 0) return stack;
  const double tolerance = options.tolerance_voxels * options.voxel_mm;
  for (int level = 0; level < stack->count(); ++level) {
    drop_bandless(*stack, level);
    if (level < stack->top()) prune_level(*stack, level, tolerance);
  }
  return stack;
}

Result<void> check_offset(const Clay& clay, double distance) {
  const double least = 0.05 * clay.options().voxel_mm;
  const double most = longest_side_mm(clay);
  const double size = std::abs(distance);
  if (size >= least && size <= most) return {};
  return bad_operation("distance_mm is " + digits(distance) + "; for this clay it must be from " +
                       digits(least) + " (a twentieth of its voxel) to " + digits(most) +
                       " (its longest side), or the negative of that");
}

Result<void> check_resample(const Clay& clay, double voxel) {
  const double now = clay.options().voxel_mm;
  const Box3 box = clay.bounds_mm();
  double reach = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    reach = std::max({reach, std::abs(box.min[axis]), std::abs(box.max[axis])});
  }
  const double top = levels_of(clay).voxel_mm(levels_of(clay).top());
  const double least =
      std::max({kLeastVoxelMm, reach / (kMaxNode - 64), std::ldexp(top, 1 - kMostLevels)});
  const double most = std::min(kMostVoxelMm, top);
  if (!(voxel >= least && voxel <= most * (1.0 + 1e-9))) {
    return bad_operation("voxel_mm is " + digits(voxel) + "; for this clay it must be from " +
                         digits(least) + " to " + digits(most));
  }
  if (std::abs(voxel - now) > 1e-9 * now) return {};
  return bad_operation("voxel_mm is " + digits(voxel) +
                       ", which the clay has already; choose another");
}

}  // namespace

Result<PreparedOperation> prepare(const Clay& clay, const Offset& offset,
                                  const Progress& progress) {
  if (auto ok = check_offset(clay, offset.distance_mm); !ok) return ok.error();
  auto levels = rebuild({clay, {}, offset.distance_mm}, {clay.options(), 0}, progress);
  if (!levels) return levels.error();
  return replaced_by(std::move(levels).value(), clay.options(),
                     "nothing would be left: no part of the clay is thicker than twice " +
                         digits(-offset.distance_mm) + " mm; choose a smaller distance",
                     progress);
}

Result<PreparedOperation> prepare(const Clay& clay, const Resample& to, const Progress& progress) {
  if (auto ok = check_resample(clay, to.voxel_mm); !ok) return ok.error();
  const std::string if_empty = "nothing would be left: the whole clay is thinner than voxels of " +
                               digits(to.voxel_mm) + " mm can hold; choose a smaller voxel";
  ClayOptions options = clay.options();
  if (const auto by = levels_between(options.voxel_mm, to.voxel_mm)) {
    options.voxel_mm = std::ldexp(options.voxel_mm, *by);
    if (auto ok = validate_options(options); !ok) return ok.error();  // by the last digit
    if (progress && !progress("levels", 0.0)) return operation_interrupted();
    return replaced_by(moved_levels(levels_of(clay), *by, options), options, if_empty, progress);
  }
  options.voxel_mm = std::clamp(to.voxel_mm, kLeastVoxelMm, kMostVoxelMm);
  auto levels = rebuild({clay, {}, 0.0}, {options, 0}, progress);
  if (!levels) return levels.error();
  return replaced_by(std::move(levels).value(), options, if_empty, progress);
}

}  // namespace argil
