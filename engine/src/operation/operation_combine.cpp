// SPDX-License-Identifier: GPL-3.0-or-later
// Cut and combine: a plane or another solid on the lattice of the clay.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "argil/engine/import.h"

#include "clay/clay_access.h"
#include "edit/build_levels.h"
#include "operation/prepared_operation.h"
#include "operation/rebuild.h"

namespace argil {
namespace {

/// The most voxels of the coarsest level that a union may span: all its leaves take part.
constexpr double kLongestUnion = 256.0;

/// False for zero, NaN and infinity.
bool has_length(const Quat& q) {
  const double square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  return std::isfinite(square) && square > 0.0;
}

Result<void> check_combine(const Combine& with) {
  if ((with.clay != nullptr) == (with.mesh != nullptr)) {
    return bad_operation("a combination takes another clay or a mesh; give one of them");
  }
  if (!is_in_reach(with.placement.position_mm)) {
    return bad_operation("position_mm is " + digits(with.placement.position_mm) +
                         "; no coordinate may be beyond " + digits(kMaxReachMm) + " mm");
  }
  if (has_length(with.placement.orientation)) return {};
  return bad_operation("orientation has no direction; give a quaternion of any length but zero");
}

/// A copy with coarser levels on top, up to `count`.
std::unique_ptr<LevelStack> with_levels(const LevelStack& from, int count) {
  assert(count >= 1);
  auto stack = std::make_unique<LevelStack>(from.voxel_mm(0), std::max(count, from.count()));
  for (int level = 0; level < from.count(); ++level) {
    stack->grid(level).setTree(from.grid(level).tree().copy());
  }
  for (int level = from.top(); level < stack->top(); ++level) build_above(*stack, level);
  return stack;
}

/// The other clay on the lattice of this one; none when it serves as it is.
Result<std::optional<Clay>> on_lattice(const Clay& clay, const Clay& other,
                                       const Placement& placement, const Progress& progress) {
  const bool same_lattice =
      other.options().voxel_mm == clay.options().voxel_mm && stays_in_place(placement);
  if (same_lattice && other.level_count() >= clay.level_count()) return std::optional<Clay>();
  if (same_lattice) {
    return std::optional<Clay>(
        clay_of_levels(with_levels(levels_of(other), clay.level_count()), other.options()));
  }
  auto levels = rebuild({other, placement, 0.0}, {clay.options(), clay.level_count()}, progress);
  if (!levels) return levels.error();
  return std::optional<Clay>(clay_of_levels(std::move(levels).value(), clay.options()));
}

/// The mesh where it is put, as clay of the same voxels.
Result<Clay> imported(const Clay& clay, const Combine& with, const Progress& progress) {
  TriangleMesh mesh = *with.mesh;
  mesh.normals.clear();
  for (Vec3& p : mesh.positions) {
    p = rotate(normalized(with.placement.orientation), p) + with.placement.position_mm;
  }
  auto made = import_mesh(mesh, clay.options(), progress);
  if (!made) return made.error();
  return std::move(made.value().clay);
}

/// Asked before anything is built on a lattice that could not hold it.
Result<void> check_length(const Clay& clay, const Box3& other_mm) {
  const double most = kLongestUnion * levels_of(clay).voxel_mm(levels_of(clay).top());
  Box3 box = clay.bounds_mm();
  box.include(other_mm.min);
  box.include(other_mm.max);
  const Vec3 size = box.size();
  const double longest = std::max({size.x, size.y, size.z});
  if (longest <= most) return {};
  return bad_operation("with the other solid the clay would be " + digits(longest) +
                       " mm long, and its coarsest level holds " + digits(most) +
                       " mm; move the other nearer, or combine the smaller with the larger");
}

Box3 placed_bounds(const Box3& box, const Placement& placement) {
  Box3 out;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{(corner & 4) != 0 ? box.max.x : box.min.x,
                 (corner & 2) != 0 ? box.max.y : box.min.y,
                 (corner & 1) != 0 ? box.max.z : box.min.z};
    out.include(rotate(placement.orientation, p) + placement.position_mm);
  }
  return out;
}

std::string empty_text(CombineKind kind) {
  if (kind == CombineKind::intersect) {
    return "nothing would be left: the two solids do not overlap; move the other one";
  }
  return "nothing would be left: the other solid covers the whole clay; move it, or make it "
         "smaller";
}

}  // namespace

Result<PreparedOperation> prepare(const Clay& clay, const Cut& cut, const Progress&) {
  const double size = length(cut.normal);
  if (!is_in_reach(cut.point_mm)) {
    return bad_operation("point_mm is " + digits(cut.point_mm) + "; no coordinate may be beyond " +
                         digits(kMaxReachMm) + " mm");
  }
  if (!(std::isfinite(size) && size > 0.0)) {
    return bad_operation("normal is " + digits(cut.normal) +
                         "; must be a direction of any length but zero");
  }
  const Vec3 out = cut.normal * ((cut.keeps_front ? -1.0 : 1.0) / size);
  PreparedOperation prepared;
  prepared.steps.push_back(
      {CombineKind::intersect, std::make_unique<PlaneSolid>(levels_of(clay), cut.point_mm, out)});
  prepared.if_empty =
      "nothing would be left: the whole clay lies on the side of the plane that is taken away; "
      "move the plane, or keep its other side";
  return prepared;
}

Result<PreparedOperation> prepare(const Clay& clay, const Combine& with, const Progress& progress) {
  if (auto ok = check_combine(with); !ok) return ok.error();
  Placement placement{with.placement.position_mm, normalized(with.placement.orientation)};
  std::optional<Clay> other;
  if (with.mesh != nullptr) {
    auto made = imported(clay, with, progress);
    if (!made) return made.error();
    other = std::move(made).value();
    placement = {};
  }
  const Clay& given = other ? *other : *with.clay;
  if (!given.bounds_mm().empty() && with.kind == CombineKind::unite) {
    const Box3 box = placed_bounds(given.bounds_mm(), placement);
    if (auto ok = check_length(clay, box); !ok) return ok.error();
  }
  auto built = on_lattice(clay, given, placement, progress);
  if (!built) return built.error();
  if (built.value()) other = std::move(*built.value());

  PreparedOperation prepared;
  const LevelStack& levels = other ? levels_of(*other) : levels_of(*with.clay);
  prepared.steps.push_back(
      {with.kind, std::make_unique<StackSolid>(levels, levels_of(clay).top())});
  prepared.if_empty = empty_text(with.kind);
  if (other) prepared.others.push_back(std::move(*other));
  return prepared;
}

}  // namespace argil
