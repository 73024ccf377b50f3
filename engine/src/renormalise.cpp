// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "edit.h"
#include "extend.h"
#include "nesting.h"
#include "restriction.h"
#include "rim.h"

namespace argil {
namespace {

constexpr float kLeastGradient = 0.5F;
constexpr float kLargestGradient = 2.0F;

/// Whether a cell of the finer level meets the node.
bool covered(const LevelStack& stack, int level, const Coord& node) {
  const auto absent = [&](const Coord& place) { return !stack.has_leaf(level - 1, place); };
  return level > 0 && !all_around(node << 1, absent);
}

/// Whether the level ends at the node or at a neighbour of it: the coarser level decides that one.
bool meets_border(const LevelStack& stack, int level, const Coord& node) {
  const auto present = [&](const Coord& place) { return stack.has_leaf(level, place); };
  if (level == stack.top()) return false;
  bool meets = !all_around(node, present);
  for (int axis = 0; axis < 3; ++axis) {
    for (int step = -1; step <= 1; step += 2) {
      Coord beside = node;
      beside[axis] += step;
      meets = meets || !all_around(beside, present);
    }
  }
  return meets;
}

float central_gradient(const std::array<float, 6>& around, float voxel) {
  float square = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float rise = 0.5F * (around[2 * axis + 1] - around[2 * axis]);
    square += rise * rise;
  }
  return std::sqrt(square) / voxel;
}

/// An edit may leave a border node of the leaf next door without its nearer neighbour, and a leaf
/// that it took away lays bare nodes of the one above.
std::set<std::pair<int, Coord>> with_neighbours(const LevelStack& stack, const LeafList& touched) {
  std::set<std::pair<int, Coord>> all;
  for (const auto& [level, place] : touched) {
    all.emplace(level, place);
    if (level < stack.top()) all.emplace(level + 1, place_of(coarser(place)));
    for (int axis = 0; axis < 3; ++axis) {
      for (int step = -kLeafSide; step <= kLeafSide; step += 2 * kLeafSide) {
        Coord near = place;
        near[axis] += step;
        all.emplace(level, near);
      }
    }
  }
  return all;
}

}  // namespace

float upwind_gradient(float here, const std::array<float, 6>& around, float voxel) {
  const float side = here < 0.0F ? -1.0F : 1.0F;
  float square = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float nearer = std::min(side * around[2 * axis], side * around[2 * axis + 1]);
    const float fall = std::max(0.0F, side * here - nearer);
    square += fall * fall;
  }
  return std::sqrt(square) / voxel;
}

bool strays(const LevelStack& stack, int level, const Coord& place, Coord* where) {
  const LeafRim value = with_rim(stack, level, place);
  const auto voxel = static_cast<float>(stack.voxel_mm(level));
  for (int i = 0; i < kLeafSide; ++i) {
    for (int j = 0; j < kLeafSide; ++j) {
      for (int k = 0; k < kLeafSide; ++k) {
        const std::size_t n = rim_index(static_cast<std::size_t>(leaf_offset(Coord(i, j, k))));
        const float here = value[n];
        if (std::abs(here) >= 3.0F * voxel) continue;
        std::array<float, 6> around;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          around[2 * axis] = value[n - kRimStride[axis]];
          around[2 * axis + 1] = value[n + kRimStride[axis]];
        }
        const bool undecided = std::any_of(around.begin(), around.end(), [&](float v) {
          return std::isnan(v) || (v < 0.0F) != (here < 0.0F);
        });
        if (undecided) continue;
        const float upwind = upwind_gradient(here, around, voxel);
        // Beside a sharp corner only the central difference sees it, on a ridge only the upwind
        // one.
        const float gradient = std::max(upwind, central_gradient(around, voxel));
        if (gradient >= kLeastGradient && upwind <= kLargestGradient) continue;
        if (covered(stack, level, place.offsetBy(i, j, k))) continue;
        if (meets_border(stack, level, place.offsetBy(i, j, k))) continue;
        if (where != nullptr) *where = place.offsetBy(i, j, k);
        return true;
      }
    }
  }
  return false;
}

bool renormalise_strayed(EditTarget& target, const LeafList& touched) {
  const LevelStack& stack = target.stack;
  Edit edit(target);
  bool any = false;
  std::vector<std::vector<Coord>> strayed(static_cast<std::size_t>(stack.count()));
  for (const auto& [level, place] : with_neighbours(stack, touched)) {
    if (!stack.has_leaf(level, place) || !strays(stack, level, place)) continue;
    any = true;
    strayed[static_cast<std::size_t>(level)].push_back(place);
    openvdb::CoordBBox reached(place, place.offsetBy(kLeafSide - 1));
    reached.expand(kReach);
    const int n = level;
    for_each_place(reached, [&](const Coord& near) {
      if (stack.has_leaf(n, near)) edit.want(n, near);
    });
  }
  if (!any) return false;
  edit.load();
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    if (n > 0) edit.restrict_to(n, RestrictedLeaves::all);
    for (const Coord& place : strayed[static_cast<std::size_t>(n)]) level.find(place)->renew = true;
    extend(level, Seeds::keep);
  }
  edit.drop_empty();
  edit.commit();
  return true;
}

}  // namespace argil
