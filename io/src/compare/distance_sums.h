// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <tbb/parallel_for.h>

#include "argil/core/pace.h"
#include "argil/mesh/certificate.h"

namespace argil::io {

/// Distances with the areas they stand for.
struct DistanceSums {
  double area = 0.0;
  double distance = 0.0;
  double square = 0.0;
  double max = 0.0;
  std::int64_t samples = 0;

  void add(double d, double weight) noexcept {
    assert(d >= 0.0 && weight >= 0.0);
    area += weight;
    distance += weight * d;
    square += weight * d * d;
    max = std::max(max, d);
    ++samples;
  }
  void add(const DistanceSums& s) noexcept {
    area += s.area;
    distance += s.distance;
    square += s.square;
    max = std::max(max, s.max);
    samples += s.samples;
  }
  mesh::DistanceSummary summary() const noexcept {
    const double least = std::numeric_limits<double>::min();
    return {max, distance / std::max(area, least), std::sqrt(square / std::max(area, least)),
            samples};
  }
};

/// Work over many items goes in blocks of this size, so that bits do not depend on threads.
inline constexpr std::size_t kDistanceBlock = 2048;
inline std::size_t block_count(std::size_t items) noexcept {
  return (items + kDistanceBlock - 1) / kDistanceBlock;
}

/// Runs `work(begin, end)` over blocks of fixed size in any order.
template <class Work>
void in_blocks(std::size_t count, const Pace& pace, const Work& work) {
  constexpr std::size_t kBetweenReports = 64;
  const std::size_t blocks = block_count(count);
  for (std::size_t first = 0; first < blocks; first += kBetweenReports) {
    pace.at(static_cast<double>(first) / static_cast<double>(blocks));
    const std::size_t last = std::min(blocks, first + kBetweenReports);
    tbb::parallel_for(first, last, [&](std::size_t block) {
      work(block * kDistanceBlock, std::min(count, (block + 1) * kDistanceBlock));
    });
  }
}

}  // namespace argil::io
