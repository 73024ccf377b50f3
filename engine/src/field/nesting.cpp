// SPDX-License-Identifier: GPL-3.0-or-later
// What the surface extraction and restriction rely on: a leaf's parent is stored, and where the
// surface passes so is the parent of each neighbour.
#include "field/nesting.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include "field/found_leaves.h"
#include "field/leaf_finder.h"
#include "field/row_bits.h"
#include "field/sampling.h"

namespace argil {
namespace {

bool sides_differ(const FoundLeaves& leaves, int level, const Coord& low, int side) {
  const bool first = sample_of(leaves, level, low) < 0.0F;
  for (int i = 0; i <= side; ++i) {
    for (int j = 0; j <= side; ++j) {
      for (int k = 0; k <= side; ++k) {
        if ((sample_of(leaves, level, low.offsetBy(i, j, k)) < 0.0F) != first) return true;
      }
    }
  }
  return false;
}

/// Whether the surface passes the cells of a leaf that is not stored. What is interpolated there
/// from nodes of a coarser level on one side is on that side too, so these few are looked at first.
bool surface_passes(const FoundLeaves& leaves, int level, const Coord& origin) {
  int from = level;
  int side = kLeafSide;
  Coord low = origin;
  while (side > 1 && from < leaves.top() && leaves.values(from, low) == nullptr) {
    ++from;
    side /= 2;
    low = coarser(low);
  }
  return sides_differ(leaves, from, low, side) && sides_differ(leaves, level, origin, kLeafSide);
}

std::vector<Coord> leaf_origins_of(const LevelStack& stack, int level) {
  std::vector<Coord> origins;
  origins.reserve(stack.grid(level).tree().leafCount());
  for (auto leaf = stack.grid(level).tree().cbeginLeaf(); leaf; ++leaf) {
    origins.push_back(leaf->origin());
  }
  return origins;
}

/// What leaves of a level require of the next coarser one and is not there.
struct Missing {
  bool parent = false;            ///< of some leaf itself
  std::vector<Coord> neighbours;  ///< parents of neighbours, which only the surface requires

  void find(LeafFinder& coarse, const Coord& origin) {
    const Coord own = leaf_origin(coarser(origin));
    for_each_required_parent(origin, [&](const Coord& required) {
      if (coarse.has_leaf(required)) return;
      if (required == own) parent = true;
      neighbours.push_back(required);
    });
  }

  void add(const Missing& more) {
    parent = parent || more.parent;
    neighbours.insert(neighbours.end(), more.neighbours.begin(), more.neighbours.end());
  }
};

constexpr std::size_t kGrain = 1024;  // leaves that lie together share what a finder remembers

/// Each once.
Missing missing_parents(const LevelStack& stack, int level) {
  const std::vector<Coord> origins = leaf_origins_of(stack, level);
  tbb::combinable<Missing> found;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, origins.size(), kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      LeafFinder coarse(stack, level + 1);
                      Missing& missing = found.local();
                      for (std::size_t n = range.begin(); n < range.end(); ++n) {
                        missing.find(coarse, origins[n]);
                      }
                    });
  Missing missing;
  found.combine_each([&](const Missing& more) { missing.add(more); });
  std::vector<Coord>& absent = missing.neighbours;
  std::sort(absent.begin(), absent.end());
  absent.erase(std::unique(absent.begin(), absent.end()), absent.end());
  return missing;
}

/// Whether the leaves of a level have what they require. A coarser leaf that is not there is looked
/// at once, and not for each leaf that may require it.
bool nests(const LevelStack& stack, int level) {
  const Missing missing = missing_parents(stack, level);
  if (missing.parent) return false;
  const std::vector<Coord>& absent = missing.neighbours;
  std::atomic<bool> is_crossed = false;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, absent.size(), kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      const FoundLeaves leaves(stack, level + 1);
                      for (std::size_t n = range.begin(); n < range.end(); ++n) {
                        if (surface_passes(leaves, level + 1, absent[n])) is_crossed = true;
                      }
                    });
  return !is_crossed;
}

}  // namespace

bool sides_differ(const LevelStack& stack, int level, const Coord& low, int side) {
  assert(side >= 1);
  return sides_differ(FoundLeaves(stack, level), level, low, side);
}

std::optional<NestingFault> nesting_fault(const LevelStack& stack, int level, const Coord& origin) {
  assert(is_leaf_origin(origin));
  if (level == stack.top()) return std::nullopt;
  if (!stack.has_leaf(level + 1, coarser(origin))) {
    return NestingFault{NestingFault::Kind::no_parent, level, origin};
  }
  bool complete = true;
  const FoundLeaves leaves(stack, level + 1);
  for_each_required_parent(origin, [&](const Coord& coarse) {
    complete = complete && (leaves.values(level + 1, coarse) != nullptr ||
                            !surface_passes(leaves, level + 1, coarse));
  });
  if (complete) return std::nullopt;
  return NestingFault{NestingFault::Kind::no_neighbour, level, origin};
}

std::optional<NestingFault> first_nesting_fault(const LevelStack& stack) {
  for (int level = 0; level < stack.top(); ++level) {
    if (nests(stack, level)) continue;
    for (const Coord& origin : stack.sorted_origins(level)) {
      if (auto fault = nesting_fault(stack, level, origin)) return fault;
    }
  }
  return std::nullopt;
}

bool has_band(const float* values, float band) {
  for (int plane = 0; plane < kLeafNodes; plane += 64) {
    unsigned within = 0;
    for (int row = plane; row < plane + 64; row += 8) within |= band_bits(values + row, band);
    if (within != 0) return true;
  }
  return false;
}

bool has_child(const LevelStack& stack, int level, const Coord& origin) {
  for (int octant = 0; level > 0 && octant < 8; ++octant) {
    if (stack.has_leaf(
            level - 1,
            (origin << 1).offsetBy(octant & 4 ? 8 : 0, octant & 2 ? 8 : 0, octant & 1 ? 8 : 0))) {
      return true;
    }
  }
  return false;
}

bool is_empty(const LevelStack& stack, int level, const Coord& origin) {
  assert(stack.has_leaf(level, origin));
  const float band = stack.band_mm(level);
  return !has_band(values_of(*stack.leaf(level, origin)), band) &&
         !has_child(stack, level, origin) && !any_corner(origin, [&](const Coord& node) {
           return std::abs(stack.sample(level, node)) < band;
         });
}

}  // namespace argil
