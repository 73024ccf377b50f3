// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/deepened_part.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "field/dense_block.h"
#include "field/fast_march.h"
#include "support/complete_level.h"

namespace argil {
namespace {

constexpr double kVoxel = 0.25;

/// Level 0 of a stack of two, complete, of a scene.
LevelStack level_of(const test::ForceScene& scene) {
  LevelStack stack(kVoxel, 2);
  stack.grid(0).setTree(test::complete_level(scene, kVoxel)->treePtr());
  return stack;
}

DeepenedPart part_of_all(const LevelStack& stack) {
  const auto box = stack.grid(0).evalActiveVoxelBoundingBox();
  return {stack, 0, leaf_origin(box.min()).offsetBy(-2 * kLeafSide),
          leaf_origin(box.max()).offsetBy(2 * kLeafSide)};
}

/// All nodes of the part and whatever lies between, marched.
MarchBlock marched(const LevelStack& stack, const NodeBox& box, double depth_mm) {
  MarchBlock block{box.sides(), static_cast<float>(kVoxel), {}, {}};
  for_each_node(box, [&](const Coord& node) {
    const float value = stack.grid(0).tree().getValue(node);
    block.value.push_back(value);
    block.state.push_back(std::abs(value) < stack.band_mm(0) ? MarchBlock::kFixed
                                                             : MarchBlock::kUnknown);
  });
  fast_march(block, static_cast<float>(depth_mm));
  return block;
}

class DeepenedPartOf : public ::testing::TestWithParam<const char*> {};

TEST_P(DeepenedPartOf, AgreesWithTheMarch) {
  const LevelStack stack = level_of(test::force_scene(GetParam(), 4.0, kVoxel));
  const DeepenedPart part = part_of_all(stack);
  const double depth = static_cast<double>(DeepenedPart::kDepthVoxels) * kVoxel;
  const auto active = stack.grid(0).evalActiveVoxelBoundingBox();
  const NodeBox box = NodeBox{active.min(), active.max()}.grown(12);
  const MarchBlock block = marched(stack, box, depth);
  std::size_t at = 0;
  std::vector<double> apart;
  for_each_node(box, [&](const Coord& node) {
    const float* values = part.values(leaf_origin(node));
    const float expected = block.value[at++];
    if (values == nullptr) {
      EXPECT_GE(static_cast<double>(std::abs(expected)), 0.999 * depth) << node;
      return;
    }
    const float found = values[static_cast<std::size_t>(leaf_offset(node))];
    EXPECT_EQ(std::signbit(found), std::signbit(expected)) << node;
    apart.push_back(std::abs(static_cast<double>(found - expected)) / kVoxel);
  });
  ASSERT_GT(apart.size(), 20000U);
  std::sort(apart.begin(), apart.end());
  EXPECT_LT(apart[apart.size() * 99 / 100], 0.01);
  EXPECT_LT(apart.back(), 0.1);
  RecordProperty("p99", std::to_string(apart[apart.size() * 99 / 100]));
  RecordProperty("worst", std::to_string(apart.back()));
}

TEST(DeepenedPart, HasTheSameBitsForAnyThreadCount) {
  const LevelStack stack = level_of(test::force_scene("slot", 4.0, kVoxel));
  const auto values_with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const DeepenedPart part = part_of_all(stack);
    std::vector<float> all;
    for (const Coord& origin : stack.sorted_origins(0)) {
      const float* values = part.values(origin);
      all.insert(all.end(), values, values + kLeafNodes);
    }
    return all;
  };
  const std::vector<float> one = values_with(1);
  EXPECT_TRUE(one == values_with(2));
  EXPECT_TRUE(one == values_with(7));
}

INSTANTIATE_TEST_SUITE_P(Scenes, DeepenedPartOf,
                         ::testing::Values("ball", "torus", "edge", "slot", "rough"),
                         [](const auto& given) { return std::string(given.param); });

}  // namespace
}  // namespace argil
