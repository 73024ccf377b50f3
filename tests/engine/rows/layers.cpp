// SPDX-License-Identifier: GPL-3.0-or-later
// The points of both layers of a leaf, by every instruction set and side by side.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "rows/rows.h"

namespace argil {
namespace {

constexpr float kLayerBand = 3.0F;

/// A leaf with its faces, at a wavy surface, some of it creased; in voxels.
std::array<float, 1000> wavy_faces(std::mt19937& dice) {
  std::uniform_real_distribution<float> some(-1.0F, 1.0F);
  const std::array<float, 3> tilt = {some(dice), some(dice), some(dice)};
  const float bend = 0.1F * some(dice);
  const float crease = some(dice);
  std::array<float, 1000> values;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const float x = static_cast<float>(n / 100) - 4.5F;
    const float y = static_cast<float>(n / 10 % 10) - 4.5F;
    const float z = static_cast<float>(n % 10) - 4.5F;
    const float bent = tilt[0] * x + tilt[1] * y + tilt[2] * z + bend * (x * x - y * z);
    values[n] = std::clamp(std::min(bent, crease * x - z + 2.0F), -kLayerBand, kLayerBand);
  }
  return values;
}

/// On the heap: there are 29 kB of them.
std::unique_ptr<LayerPoints> points_of(const RowLoops& loops, const std::array<float, 1000>& values,
                                       bool outside, bool inside) {
  auto points = std::make_unique<LayerPoints>();
  loops.project_to_layers(values.data(), {1.0F, kLayerBand, 1.75F, 1.0F / 12.0F, {outside, inside}},
                          *points);
  return points;
}

bool has_same_bits(const float* a, const float* b, int count) {
  return std::memcmp(a, b, static_cast<std::size_t>(count) * sizeof(float)) == 0;
}

void expect_same_layer(const LayerPoints& found, const LayerPoints& expected, int side) {
  constexpr int kClusters = ClusterBoxes::kClusters;
  for (int cluster = 0; cluster < kClusters; ++cluster) {
    const int count = expected.count[side][cluster];
    ASSERT_EQ(found.count[side][cluster], count);
    for (int field = 0; field < LayerPoints::kFields; ++field) {
      EXPECT_TRUE(has_same_bits(found.values[side][cluster][field],
                                expected.values[side][cluster][field], count))
          << field;
    }
  }
  const auto expect_same = [](const ClusterBoxes& a, const ClusterBoxes& b) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_TRUE(has_same_bits(a.low[axis], b.low[axis], kClusters));
      EXPECT_TRUE(has_same_bits(a.high[axis], b.high[axis], kClusters));
    }
  };
  expect_same(found.feet[side], expected.feet[side]);
  expect_same(found.surface[side], expected.surface[side]);
}

int count_of(const LayerPoints& points, int side) {
  int count = 0;
  for (const int each : points.count[side]) count += each;
  return count;
}

TEST(Rows, ProjectToTheSameLayersWithEveryInstructionSet) {
  std::mt19937 dice(31);
  int told = 0;
  for (int n = 0; n < 200; ++n) {
    const auto values = wavy_faces(dice);
    const auto expected = points_of(baseline::kRowLoops, values, true, true);
    const auto found = points_of(row_loops(), values, true, true);
    for (int side = 0; side < 2; ++side) {
      expect_same_layer(*found, *expected, side);
      told += count_of(*found, side);
    }
  }
  EXPECT_GT(told, 5000);
}

TEST(Rows, ALayerIsTheSameWhetherTheOtherIsWantedOrNot) {
  std::mt19937 dice(32);
  int told = 0;
  for (int n = 0; n < 200; ++n) {
    const auto values = wavy_faces(dice);
    const auto both = points_of(row_loops(), values, true, true);
    const auto outside = points_of(row_loops(), values, true, false);
    const auto inside = points_of(row_loops(), values, false, true);
    expect_same_layer(*outside, *both, 0);
    expect_same_layer(*inside, *both, 1);
    EXPECT_EQ(count_of(*outside, 1), 0);
    EXPECT_EQ(count_of(*inside, 0), 0);
    told += count_of(*outside, 0) + count_of(*inside, 1);
  }
  EXPECT_GT(told, 5000);
}

}  // namespace
}  // namespace argil
