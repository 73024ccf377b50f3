// SPDX-License-Identifier: GPL-3.0-or-later
// What the surface extraction and restriction rely on: a leaf's parent is stored, and where the
// surface passes so is the parent of each neighbour.
#include "field/nesting.h"

#include <atomic>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>

#include "field/row_bits.h"

namespace argil {
namespace {

/// Whether the surface passes the cells of a leaf that is not stored. What is interpolated there
/// from nodes of a coarser level on one side is on that side too, so these few are looked at first.
bool surface_passes(const LevelStack& stack, int level, const Coord& origin) {
  int from = level;
  int side = kLeafSide;
  Coord low = origin;
  while (side > 1 && from < stack.top() && !stack.has_leaf(from, low)) {
    ++from;
    side /= 2;
    low = coarser(low);
  }
  return sides_differ(stack, from, low, side) && sides_differ(stack, level, origin, kLeafSide);
}

}  // namespace

bool sides_differ(const LevelStack& stack, int level, const Coord& low, int side) {
  assert(side >= 1);
  const bool first = stack.sample(level, low) < 0.0F;
  for (int i = 0; i <= side; ++i) {
    for (int j = 0; j <= side; ++j) {
      for (int k = 0; k <= side; ++k) {
        if ((stack.sample(level, low.offsetBy(i, j, k)) < 0.0F) != first) return true;
      }
    }
  }
  return false;
}

std::optional<NestingFault> nesting_fault(const LevelStack& stack, int level, const Coord& origin) {
  assert(is_leaf_origin(origin));
  if (level == stack.top()) return std::nullopt;
  if (!stack.has_leaf(level + 1, coarser(origin))) {
    return NestingFault{NestingFault::Kind::no_parent, level, origin};
  }
  bool complete = true;
  for_each_required_parent(origin, [&](const Coord& coarse) {
    complete = complete &&
               (stack.has_leaf(level + 1, coarse) || !surface_passes(stack, level + 1, coarse));
  });
  if (complete) return std::nullopt;
  return NestingFault{NestingFault::Kind::no_neighbour, level, origin};
}

/// In parallel, and still the first: a thread gives up on what lies behind a fault that is known.
std::optional<NestingFault> first_nesting_fault(const LevelStack& stack) {
  for (int level = 0; level < stack.top(); ++level) {
    const std::vector<Coord> origins = stack.sorted_origins(level);
    std::atomic<std::size_t> first{origins.size()};
    tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t n) {
      std::size_t known = first.load(std::memory_order_relaxed);
      if (n >= known || !nesting_fault(stack, level, origins[n])) return;
      while (n < known && !first.compare_exchange_weak(known, n)) {
      }
    });
    if (first < origins.size()) return nesting_fault(stack, level, origins[first]);
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
