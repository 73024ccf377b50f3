// SPDX-License-Identifier: GPL-3.0-or-later
// Reading a field with cubic weights.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "rows/rows.h"

namespace argil {
namespace {

constexpr int kCubicNodes = kLeafRows * kRowNodes;

/// The sum over 4^3 nodes under the weights of Catmull-Rom, in doubles.
double cubic_at(const std::vector<float>& field, int side, const std::array<double, 3>& at) {
  std::array<std::array<double, 4>, 3> weight;
  std::array<int, 3> low;
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] = static_cast<int>(std::floor(at[a]));
    const double t = at[a] - low[a];
    weight[a] = {0.5 * (2 * t * t - t - t * t * t), 0.5 * (2 - 5 * t * t + 3 * t * t * t),
                 0.5 * (t + 4 * t * t - 3 * t * t * t), 0.5 * (t * t * t - t * t)};
  }
  double sum = 0.0;
  for (int n = 0; n < 64; ++n) {
    const int node =
        ((low[0] + n / 16 - 1) * side + low[1] + n / 4 % 4 - 1) * side + low[2] + n % 4 - 1;
    sum += weight[0][static_cast<std::size_t>(n / 16)] *
           weight[1][static_cast<std::size_t>(n / 4 % 4)] *
           weight[2][static_cast<std::size_t>(n % 4)] *
           static_cast<double>(field[static_cast<std::size_t>(node)]);
  }
  return sum;
}

/// Points of a row that lie evenly, unevenly and all over the field, to its first and last nodes.
TEST(CubicRows, AreThePlainFormula) {
  constexpr int kSide = 16;
  std::mt19937 dice(3);
  std::uniform_real_distribution<float> some(-1.0F, 1.0F);
  std::vector<float> field(kSide * kSide * kSide);
  for (float& value : field) value = some(dice);
  PointBlock points{};
  std::fill(std::begin(points.is_asked), std::end(points.is_asked), true);
  for (int n = 0; n < kCubicNodes; ++n) {
    const float spread = 0.1F * static_cast<float>(n / 64);  // voxels, more with every plane
    points.x[n] = static_cast<float>(n / 64) + spread * some(dice);
    points.y[n] = static_cast<float>(n / 8 % 8) + spread * some(dice);
    points.z[n] = static_cast<float>(n % 8) + spread * some(dice);
    if (n % 61 != 0) continue;
    for (float* at : {points.x + n, points.y + n, points.z + n}) {
      *at = some(dice) < 0.0F ? -3.0F : 9.9F;
    }
  }
  float out[kCubicNodes];
  row_loops().read_cubic({field.data(), {kSide, kSide, kSide}, {4.0F, 4.0F, 4.0F}, 1.0F}, points,
                         out);
  for (int n = 0; n < kCubicNodes; ++n) {
    const double expected =
        cubic_at(field, kSide,
                 {4.0 + static_cast<double>(points.x[n]), 4.0 + static_cast<double>(points.y[n]),
                  4.0 + static_cast<double>(points.z[n])});
    ASSERT_NEAR(static_cast<double>(out[n]), expected, 2e-5) << n;
  }
}

/// A node reads its own value back, to the bit: what is not moved stays.
TEST(CubicRows, ReadNodesAsTheyAre) {
  std::vector<float> field(12 * 12 * 12);
  for (std::size_t n = 0; n < field.size(); ++n)
    field[n] = std::sin(0.1F * static_cast<float>(n * n));
  PointBlock points{};
  std::fill(std::begin(points.is_asked), std::end(points.is_asked), true);
  for (int n = 0; n < kCubicNodes; ++n) {
    points.x[n] = static_cast<float>(n / 64);
    points.y[n] = static_cast<float>(n / 8 % 8);
    points.z[n] = static_cast<float>(n % 8);
  }
  float out[kCubicNodes];
  row_loops().read_cubic({field.data(), {12, 12, 12}, {2.0F, 2.0F, 2.0F}, 1.0F}, points, out);
  for (int n = 0; n < kCubicNodes; ++n) {
    const int at = ((n / 64 + 2) * 12 + n / 8 % 8 + 2) * 12 + n % 8 + 2;
    ASSERT_EQ(out[n], field[static_cast<std::size_t>(at)]) << n;
  }
}

/// A point just below a node may be rounded up to it: what lies beyond must be there.
TEST(CubicRows, ReadNothingBeyondTwoNodesBehind) {
  constexpr int kSide = 13;
  const std::vector<float> field(kSide * kSide * kSide, 2.0F);  // a block of its own
  PointBlock points{};
  points.is_asked[0] = true;
  for (int n = 0; n < kRowNodes; ++n) {
    points.x[n] = points.y[n] = points.z[n] = std::nextafter(7.0F, 0.0F);
  }
  float out[kCubicNodes] = {};
  row_loops().read_cubic({field.data(), {kSide, kSide, kSide}, {3.0F, 3.0F, 3.0F}, 1.0F}, points,
                         out);
  EXPECT_EQ(out[0], 2.0F);
}

}  // namespace
}  // namespace argil
