// SPDX-License-Identifier: GPL-3.0-or-later
// What edits of a mask that follow the surface share.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "argil/core/pace.h"
#include "argil/engine/field_sampler.h"
#include "argil/engine/mask_filter.h"

#include "field/mask.h"

namespace argil {

/// A point of the surface and the outward unit normal there.
struct SurfacePlace {
  Vec3 at;
  Vec3 normal;
};

/// Where Newton's rule leads from a point along the gradient: to within a fiftieth of `near_mm` of
/// the surface, or nothing.
std::optional<SurfacePlace> surface_near(FieldSampler& field, const Vec3& from, double near_mm);

/// The leaves of the mask in which every node counts (is_near_surface), sorted.
std::vector<Coord> mask_leaves_near_surface(const LevelStack& stack);

/// A leaf of a mask and what becomes of it.
struct MaskLeaf {
  Coord origin;
  LeafValues values;
  bool is_changed = false;
};

/// Puts what `work` makes of each leaf into `mask`, a few thousand at a time so that no more wait
/// beside it. `work` is called from several threads; `origins` has no repeats.
void change_mask_leaves(const std::vector<Coord>& origins, Mask& mask, std::int64_t free_bytes,
                        const Pace& pace, const std::function<void(MaskLeaf&)>& work);

/// The mask after it; null for one of nothing. Numbers must be in range for the clay. Throws
/// Interrupted and OverLimit.
std::shared_ptr<Mask> grown_mask(const Clay& clay, const Mask& before, const MaskGrow& grow,
                                 std::int64_t free_bytes, const Pace& pace);
std::shared_ptr<Mask> cavity_mask(const Clay& clay, const MaskCavity& cavity,
                                  std::int64_t free_bytes, const Pace& pace);

}  // namespace argil
