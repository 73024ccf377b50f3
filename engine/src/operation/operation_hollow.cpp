// SPDX-License-Identifier: GPL-3.0-or-later
// Hollow: the difference with a cavity, and round holes into it. The cavity is the clay moved
// inward by the wall and a voxel more, then outward by that voxel: a plain offset runs out into
// films thinner than a voxel, full of holes, where what is inside tapers to a wall.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "clay/clay_access.h"
#include "edit/prune.h"
#include "field/parallel.h"
#include "operation/combine.h"
#include "operation/prepared_operation.h"
#include "operation/rebuild.h"

namespace argil {
namespace {

constexpr double kThinnestWallVoxels = 3.0;
constexpr double kNarrowestDrainVoxels = 2.0;

std::string name_of(std::size_t drain) { return "drains[" + std::to_string(drain) + "]"; }

Result<void> check_drain(const Drain& drain, std::size_t index, double voxel, double most) {
  const double least = kNarrowestDrainVoxels * voxel;
  if (!(drain.radius_mm >= least && drain.radius_mm <= most)) {
    return bad_operation(name_of(index) + ": radius_mm is " + digits(drain.radius_mm) +
                         "; for this clay it must be from " + digits(least) + " to " +
                         digits(most));
  }
  const double size = length(drain.direction);
  if (!is_in_reach(drain.point_mm)) {
    return bad_operation(name_of(index) + ": point_mm is " + digits(drain.point_mm) +
                         "; no coordinate may be beyond " + digits(kMaxReachMm) + " mm");
  }
  if (std::isfinite(size) && size > 0.0) return {};
  return bad_operation(name_of(index) + ": direction is " + digits(drain.direction) +
                       "; must be finite numbers that are not all 0");
}

Result<void> check_hollow(const Clay& clay, const Hollow& hollow) {
  const double voxel = clay.options().voxel_mm;
  const double least = kThinnestWallVoxels * voxel;
  const double most = 0.5 * longest_side_mm(clay);
  if (!(hollow.wall_mm >= least && hollow.wall_mm <= most)) {
    return bad_operation("wall_mm is " + digits(hollow.wall_mm) +
                         "; for this clay it must be from " + digits(least) +
                         " (three voxels; resample finer for less) to " + digits(most));
  }
  for (std::size_t i = 0; i < hollow.drains.size(); ++i) {
    if (auto ok = check_drain(hollow.drains[i], i, voxel, most); !ok) return ok;
  }
  return {};
}

/// A drain's line through the clay and its cavity, in half voxels.
class DrainLine {
 public:
  DrainLine(const Clay& clay, const Clay& cavity, const Drain& drain)
      : clay_(clay),
        cavity_(cavity),
        from_(drain.point_mm),
        axis_(normalized(drain.direction)),
        step_(0.5 * clay.options().voxel_mm) {}

  /// The first point from `begin` to `end` where `solid` says `inside`, but for the first `skipped`
  /// half voxels; infinity when there is none.
  double first(const Clay& solid, bool inside, double begin, double end,
               std::int64_t skipped = 0) const {
    const double step = begin <= end ? step_ : -step_;
    const auto count = static_cast<std::int64_t>(std::abs(end - begin) / step_) + 1;
    for (std::int64_t i = skipped; i <= count; ++i) {
      const double t = begin + static_cast<double>(i) * step;
      if ((solid.distance_at(from_ + t * axis_) < 0.0) == inside) return t;
    }
    return std::numeric_limits<double>::infinity();
  }

  /// The first point within the cavity, looked for in its bounds alone: the line may be long
  /// before.
  double entry() const {
    const Box3 box = cavity_.bounds_mm();
    double begin = 0.0;
    double end = std::numeric_limits<double>::max();
    for (std::size_t a = 0; a < 3; ++a) {
      if (axis_[a] == 0.0) continue;  // outside, the search below finds nothing
      const double one = (box.min[a] - from_[a]) / axis_[a];
      const double other = (box.max[a] - from_[a]) / axis_[a];
      begin = std::max(begin, std::min(one, other));
      end = std::min(end, std::max(one, other));
    }
    if (begin > end) return std::numeric_limits<double>::infinity();
    const auto skipped = static_cast<std::int64_t>(begin / step_) - 1;
    return first(cavity_, true, 0.0, end, std::max<std::int64_t>(skipped, 0));
  }
  const Clay& clay() const noexcept { return clay_; }
  const Clay& cavity() const noexcept { return cavity_; }
  const Vec3& axis() const noexcept { return axis_; }
  Vec3 at(double t) const { return from_ + t * axis_; }

 private:
  const Clay& clay_;
  const Clay& cavity_;
  Vec3 from_;
  Vec3 axis_;
  double step_;
};

/// A rod from before the outer surface into the cavity, long enough that its whole end passes the
/// wall also where that is slanted, and short enough to hit nothing else.
Result<Rod> rod_of(const DrainLine& line, const Drain& drain, std::size_t index, double wall) {
  const double back = -(wall + drain.radius_mm);
  const double entry = line.entry();
  if (!std::isfinite(entry)) {
    return bad_operation(name_of(index) + ": the line from " + digits(drain.point_mm) + " along " +
                         digits(drain.direction) +
                         " meets no cavity; aim it at the inside of the clay, or choose a thinner "
                         "wall");
  }
  const double outer = line.first(line.clay(), false, entry, back);
  if (!std::isfinite(outer)) {
    return bad_operation(name_of(index) + ": " + digits(drain.point_mm) +
                         " lies deep in the clay; begin on or before its outer surface");
  }
  const double rim = 2.0 * drain.radius_mm + 2.0 * line.clay().options().voxel_mm;
  const double obstacle = line.first(line.clay(), true, outer, outer - rim);
  const double begin = std::isfinite(obstacle) ? 0.5 * (outer + obstacle) : outer - rim;
  const double leaves = line.first(line.cavity(), false, entry, entry + 2.0 * rim);
  const double end = std::isfinite(leaves) ? 0.5 * (entry + leaves) : entry + rim;
  return Rod{line.at(begin), line.axis(), end - begin, drain.radius_mm};
}

/// Subtracts from all distances. What is beyond the band stays so: nobody knows how far it is.
void grow_levels(LevelStack& stack, float mm) {
  for (int level = 0; level < stack.count(); ++level) {
    const float band = stack.band_mm(level);
    const std::vector<Coord> origins = stack.sorted_origins(level);
    for_each_leaf(origins.size(), [&](std::size_t n) {
      LeafValues values;
      std::copy_n(values_of(*stack.leaf(level, origins[n])), kLeafNodes, values.begin());
      for (float& value : values) {
        if (value < band) value = std::max(value - mm, -band);
      }
      stack.rewrite_leaf(level, origins[n], values.data());
    });
    drop_bandless(stack, level);
  }
}

Result<std::unique_ptr<LevelStack>> cavity_of(const Clay& clay, double wall_mm,
                                              const Progress& progress) {
  const double voxel = clay.options().voxel_mm;
  auto levels =
      rebuild({clay, {}, -(wall_mm + voxel)}, {clay.options(), clay.level_count()}, progress);
  if (!levels) return levels;
  if (!has_inside(*levels.value())) {
    return bad_operation("wall_mm is " + digits(wall_mm) +
                         ", and no part of the clay is two voxels thicker than two such walls; "
                         "choose a thinner wall");
  }
  grow_levels(*levels.value(), static_cast<float>(voxel));
  return levels;
}

}  // namespace

Result<PreparedOperation> prepare(const Clay& clay, const Hollow& hollow,
                                  const Progress& progress) {
  if (auto ok = check_hollow(clay, hollow); !ok) return ok.error();
  auto levels = cavity_of(clay, hollow.wall_mm, progress);
  if (!levels) return levels.error();
  PreparedOperation prepared;
  prepared.others.push_back(clay_of_levels(std::move(levels).value(), clay.options()));
  const Clay& cavity = prepared.others.back();
  prepared.steps.push_back({CombineKind::subtract, std::make_unique<StackSolid>(
                                                       levels_of(cavity), levels_of(clay).top())});
  for (std::size_t i = 0; i < hollow.drains.size(); ++i) {
    const Drain& drain = hollow.drains[i];
    auto rod = rod_of(DrainLine(clay, cavity, drain), drain, i, hollow.wall_mm);
    if (!rod) return rod.error();
    const double tolerance = clay.options().tolerance_voxels * clay.options().voxel_mm;
    prepared.steps.push_back({CombineKind::subtract,
                              std::make_unique<RodSolid>(levels_of(clay), rod.value(), tolerance)});
  }
  prepared.if_empty =
      "nothing would be left: the drains take away the whole wall; make them narrower";
  return prepared;
}

}  // namespace argil
