// SPDX-License-Identifier: GPL-3.0-or-later
#include "nesting.h"

#include <atomic>
#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>

#include "retention.h"

namespace argil {
namespace {

/// Whether the surface passes the cells of a place without a leaf. What is interpolated there from
/// nodes of a coarser level on one side is on that side too, so these few are looked at first.
bool surface_passes(const LevelStack& stack, int level, const Coord& place) {
  int from = level;
  int side = kLeafSide;
  Coord low = place;
  while (side > 1 && from < stack.top() && !stack.has_leaf(from, low)) {
    ++from;
    side /= 2;
    low = coarser(low);
  }
  return sides_differ(stack, from, low, side) && sides_differ(stack, level, place, kLeafSide);
}

}  // namespace

bool sides_differ(const LevelStack& stack, int level, const Coord& low, int side) {
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

std::optional<NestingFault> nesting_fault(const LevelStack& stack, int level, const Coord& place) {
  if (level == stack.top()) return std::nullopt;
  if (!stack.has_leaf(level + 1, coarser(place))) {
    return NestingFault{NestingFault::Kind::no_parent, level, place};
  }
  bool complete = true;
  for_each_required_place(place, [&](const Coord& coarse) {
    complete = complete &&
               (stack.has_leaf(level + 1, coarse) || !surface_passes(stack, level + 1, coarse));
  });
  if (complete) return std::nullopt;
  return NestingFault{NestingFault::Kind::no_neighbour, level, place};
}

std::optional<NestingFault> first_nesting_fault(const LevelStack& stack) {
  for (int level = 0; level < stack.top(); ++level) {
    const std::vector<Coord> places = stack.sorted_places(level);
    std::atomic<std::size_t> first{places.size()};
    tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t n) {
      std::size_t known = first.load(std::memory_order_relaxed);
      if (n >= known || !nesting_fault(stack, level, places[n])) return;
      while (n < known && !first.compare_exchange_weak(known, n)) {
      }
    });
    if (first < places.size()) return nesting_fault(stack, level, places[first]);
  }
  return std::nullopt;
}

}  // namespace argil
