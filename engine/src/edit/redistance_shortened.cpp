// SPDX-License-Identifier: GPL-3.0-or-later
// Beyond the ends of what an offset shrank, values run along the medial axis of what was there
// before and rise too slowly; from there they reach the nodes beside. Both lie within a band's
// width of a node where the upwind gradient is too small, so that much is solved again, together.
// Coarse levels first: what a level ends at is told by the next coarser one.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

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
constexpr float kLeastGainVoxels = 0.1F;

/// One side of the surface at one level.
struct ShortSide {
  bool is_outside;
  float voxel_mm;
  float band_mm;

  bool is_across(float value) const noexcept { return is_outside ? value <= 0.0F : value >= 0.0F; }
  /// Whether others are to tell a node: it is within the band and none beside it is across the
  /// surface. What is missing is NaN, and across nothing.
  bool is_told(const float* at) const noexcept {
    if (is_across(*at) || std::abs(*at) >= band_mm) return false;
    for (const int stride : kHaloStride) {
      if (is_across(at[stride]) || is_across(at[-stride])) return false;
    }
    return true;
  }
  bool is_too_slow(const float* at) const noexcept {
    if (!is_told(at)) return false;
    float squares = 0.0F;
    for (const int stride : kHaloStride) {
      float nearest = std::abs(*at);
      for (const float beside : {at[stride], at[-stride]}) {
        if (std::abs(beside) < nearest) nearest = std::abs(beside);
      }
      const float rise = (std::abs(*at) - nearest) / voxel_mm;
      squares += rise * rise;
    }
    return squares < kLeastSlope * kLeastSlope;
  }
  /// Whether a solution is so much farther than what was there. The band cuts it short.
  bool is_gain(float before, float solved) const noexcept {
    const float from = std::abs(before);
    const float to = std::abs(solved);
    if (to - from < kLeastGainVoxels * voxel_mm) return false;
    return to >= band_mm || to > kLeastGain * from;
  }
};

/// Calls visit(n, at) for the nodes of a leaf in the middle of a block.
template <class Visit>
void for_each_own(const HaloBlock& block, const Visit& visit) {
  for (int n = 0; n < kLeafNodes; ++n) {
    visit(static_cast<std::size_t>(n), &block.value[HaloBlock::index(n >> 6, n >> 3 & 7, n & 7)]);
  }
}

bool has_too_slow(const LevelStack& stack, const ShortSide& side, int level, const Coord& origin) {
  HaloBlock block;
  gather_halo(stack, level, origin, block);
  bool found = false;
  for_each_own(block, [&](std::size_t, const float* at) { found = found || side.is_too_slow(at); });
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
    if (!side.is_gain(leaf.before()[n], now[n])) now[n] = leaf.before()[n];
  }
}

/// False: asked to stop.
bool solve_short(LevelEdit& edit, const ShortSide& side, const std::vector<Coord>& origins,
                 const std::function<bool()>& goes_on) {
  std::vector<SweptLeaf> swept(origins.size());
  for_each_leaf(origins.size(), [&](std::size_t n) {
    HaloBlock block;
    gather_halo(edit.stack(), edit.level(), origins[n], block);
    swept[n].leaf = edit.find(origins[n]);
    for_each_own(block, [&](std::size_t node, const float* at) {
      if (side.is_told(at)) swept[n].dirty[node / 8] |= static_cast<std::uint8_t>(1U << node % 8);
    });
  });
  if (!sweep_distances(edit, swept, goes_on)) return false;
  for_each_leaf(swept.size(), [&](std::size_t n) { keep_gains(side, swept[n]); });
  edit.mark_changes();
  return true;
}

}  // namespace

bool redistance_shortened(LevelStack& stack, bool is_outside, const Progress& progress) {
  EditMemory memory;
  EditTarget target{stack, memory, 0.0, [](const LeafChange&, const float*, float) {},
                    std::numeric_limits<std::int64_t>::max()};
  for (int level = stack.top(); level >= 0; --level) {
    const double done = static_cast<double>(stack.top() - level) / stack.count();
    const auto goes_on = [&] { return !progress || progress("redistance", done); };
    if (!goes_on()) return false;
    const ShortSide side{is_outside, static_cast<float>(stack.voxel_mm(level)),
                         stack.band_mm(level)};
    const std::vector<Coord> origins = leaves_to_solve(stack, side, level);
    if (origins.empty()) continue;
    Edit edit(target);
    for (const Coord& origin : origins) edit.want(level, origin);
    edit.load();
    if (!solve_short(edit.level(level), side, origins, goes_on)) return false;
    edit.drop_empty();
    edit.commit();
  }
  return true;
}

}  // namespace argil
