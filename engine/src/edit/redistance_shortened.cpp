// SPDX-License-Identifier: GPL-3.0-or-later
// Beyond the ends of what an offset shrank, values run along the medial axis of what was there
// before and rise too slowly; from there they reach the nodes beside. Both lie within a band's
// width of a node where the upwind gradient is too small, so that much is solved again, together.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "edit/distance_sweeps.h"
#include "edit/leaf_set.h"
#include "edit/redistance.h"
#include "field/halo.h"
#include "field/parallel.h"

namespace argil {
namespace {

/// Less is too slow. Beside a corner upwind differences of a distance say .59, and the solution
/// there is 1.2 times the distance: what is solved counts only where it is far more than that.
constexpr float kLeastSlope = 0.8F;
constexpr float kLeastGain = 1.3F;

/// Of one side of the surface; all nodes are tested against the same.
struct ShortSide {
  bool is_outside;
  float voxel_mm;
  float band_mm;

  bool holds(float value) const noexcept { return is_outside ? value > 0.0F : value < 0.0F; }
  /// Whether a node is to be told by others: it is within the band and none beside it is across
  /// the surface, or missing.
  bool is_told(const float* at) const noexcept {
    if (!holds(*at) || std::abs(*at) >= band_mm) return false;
    for (const int stride : kHaloStride) {
      if (!holds(at[stride]) || !holds(at[-stride])) return false;
    }
    return true;
  }
  bool is_too_slow(const float* at) const noexcept {
    if (!is_told(at)) return false;
    float squares = 0.0F;
    for (const int stride : kHaloStride) {
      const float nearest = std::min(std::abs(at[stride]), std::abs(at[-stride]));
      const float rise = std::max(0.0F, std::abs(*at) - nearest) / voxel_mm;
      squares += rise * rise;
    }
    return squares < kLeastSlope * kLeastSlope;
  }
};

/// Calls visit(n, at) for the nodes of a leaf in the middle of a block.
template <class Visit>
void for_each_own(const HaloBlock& block, const Visit& visit) {
  for (int n = 0; n < kLeafNodes; ++n) {
    visit(n, &block.value[HaloBlock::index(n >> 6, n >> 3 & 7, n & 7)]);
  }
}

bool has_too_slow(const LevelStack& stack, const ShortSide& side, int level, const Coord& origin) {
  HaloBlock block;
  gather_halo(stack, level, origin, block);
  bool found = false;
  for_each_own(block, [&](int, const float* at) { found = found || side.is_too_slow(at); });
  return found;
}

/// The leaves of a level within a band's width of one with such a node.
std::vector<Coord> leaves_to_solve(const LevelStack& stack, const ShortSide& side, int level) {
  const std::vector<Coord> origins = stack.sorted_origins(level);
  std::vector<std::uint8_t> is_found(origins.size(), 0);
  for_each_leaf(origins.size(), [&](std::size_t n) {
    is_found[n] = has_too_slow(stack, side, level, origins[n]) ? 1 : 0;
  });
  LeafSet near(stack.count());
  for (std::size_t n = 0; n < origins.size(); ++n) {
    if (is_found[n] == 0) continue;
    openvdb::CoordBBox reached(origins[n], origins[n].offsetBy(kLeafSide - 1));
    reached.expand(kReach);
    for_each_leaf_origin(reached, [&](const Coord& origin) {
      if (stack.has_leaf(level, origin)) near.insert(level, origin);
    });
  }
  return near.sorted(level);
}

/// Takes back what was solved but gained too little.
void keep_gains(const ShortSide& side, const SweptLeaf& swept) {
  LeafEdit& leaf = *swept.leaf;
  if (!leaf.is_written()) return;
  float* now = leaf.write();
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    const unsigned solved = swept.dirty[n / 8] & ~static_cast<unsigned>(leaf.restricted[n / 8]);
    if ((solved >> n % 8 & 1U) == 0) continue;
    const float before = leaf.before()[n];
    const float gain = std::abs(now[n]) - std::abs(before);
    const bool is_far_more = std::abs(now[n]) > kLeastGain * std::abs(before);
    if (!is_far_more || gain < 0.1F * side.voxel_mm) now[n] = before;
  }
}

void solve_short(LevelEdit& edit, const ShortSide& side, const std::vector<Coord>& origins) {
  std::vector<SweptLeaf> swept(origins.size());
  for_each_leaf(origins.size(), [&](std::size_t n) {
    LeafEdit& leaf = *edit.find(origins[n]);
    HaloBlock block;
    gather_halo(edit.stack(), edit.level(), origins[n], block);
    set_own(leaf.now(), block);  // restricted by now
    swept[n].leaf = &leaf;
    for_each_own(block, [&](int node, const float* at) {
      if (!side.is_told(at)) return;
      swept[n].dirty[static_cast<std::size_t>(node) / 8] |=
          static_cast<std::uint8_t>(1U << node % 8);
    });
  });
  sweep_distances(edit, swept);
  for_each_leaf(swept.size(), [&](std::size_t n) { keep_gains(side, swept[n]); });
  edit.mark_changes();
}

}  // namespace

bool redistance_shortened(LevelStack& stack, bool is_outside, const Progress& progress) {
  EditMemory memory;
  EditTarget target{stack, memory, 0.0, [](const LeafChange&, const float*, float) {},
                    std::numeric_limits<std::int64_t>::max()};
  const auto side_of = [&](int level) {
    return ShortSide{is_outside, static_cast<float>(stack.voxel_mm(level)), stack.band_mm(level)};
  };
  Edit edit(target);
  std::vector<std::vector<Coord>> due(static_cast<std::size_t>(stack.count()));
  bool is_any_due = false;
  for (int level = 0; level < stack.count(); ++level) {
    if (progress && !progress("redistance", 0.5 * level / stack.count())) return false;
    auto& of_level = due[static_cast<std::size_t>(level)];
    of_level = leaves_to_solve(stack, side_of(level), level);
    for (const Coord& origin : of_level) edit.want(level, origin);
    is_any_due = is_any_due || !of_level.empty();
  }
  if (!is_any_due) return true;
  edit.load();
  for (int level = 0; level < edit.count(); ++level) {
    if (progress && !progress("redistance", 0.5 + 0.5 * level / stack.count())) return false;
    if (level > 0) edit.restrict_to(level, RestrictedLeaves::all);
    solve_short(edit.level(level), side_of(level), due[static_cast<std::size_t>(level)]);
  }
  edit.drop_empty();
  edit.commit();
  return true;
}

}  // namespace argil
