// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimate/vertex_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace argil::mesh {
namespace {

/// Points on a spiral, many of them with equal coordinates.
std::vector<Vec3> points() {
  std::vector<Vec3> made;
  for (int i = 0; i < 5000; ++i) {
    const double turn = 0.01 * i;
    made.push_back(
        {std::round(9.0 * std::sin(turn)), std::round(5.0 * std::cos(turn)), 0.25 * turn});
  }
  return made;
}

std::vector<std::uint32_t> every_third(std::size_t count) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t v = 0; v < count; v += 3) numbers.push_back(v);
  return numbers;
}

TEST(VertexBlocks, HaveEachVertexOnceAndAreSmallEnough) {
  const std::vector<Vec3> positions = points();
  const std::vector<std::uint32_t> wanted = every_third(positions.size());
  std::vector<std::uint32_t> all;
  for (const VertexBlock& block : vertex_blocks(positions, wanted, 100, 0.4)) {
    EXPECT_LE(block.size(), 100U);
    EXPECT_TRUE(std::is_sorted(block.begin(), block.end()));
    all.insert(all.end(), block.begin(), block.end());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, wanted);
  EXPECT_TRUE(vertex_blocks(positions, {}, 100, 0.4).empty());
}

TEST(VertexBlocks, AreCutElsewhereByAnotherFraction) {
  const std::vector<Vec3> positions = points();
  const auto first = vertex_blocks(positions, every_third(positions.size()), 1000, 0.5);
  const auto second = vertex_blocks(positions, every_third(positions.size()), 1000, 0.4);
  EXPECT_NE(first.front(), second.front());
}

TEST(VertexBlocksGolden, AreTheSameForAnyNumberOfThreads) {
  const std::vector<Vec3> positions = points();
  const auto several = vertex_blocks(positions, every_third(positions.size()), 50, 0.4);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(vertex_blocks(positions, every_third(positions.size()), 50, 0.4), several);
}

}  // namespace
}  // namespace argil::mesh
