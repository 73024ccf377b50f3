// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/fast_march.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "argil/core/vec3.h"

namespace argil {
namespace {

using Distance = std::function<double(const Vec3&)>;

/// Where the origin lies off the middle of a block: nothing is symmetric to the lattice by luck.
constexpr Vec3 kShift{0.31, -0.17, 0.43};

/// Analytic distances about the origin, in voxels.
Distance ball(double radius) {
  return [=](const Vec3& p) { return length(p) - radius; };
}
Distance plane(const Vec3& normal, double offset) {
  return [n = normalized(normal), offset](const Vec3& p) { return dot(n, p) - offset; };
}
Distance torus(double ring, double tube) {
  return [=](const Vec3& p) { return length({length({p.x, p.y, 0.0}) - ring, 0.0, p.z}) - tube; };
}
Distance two_balls(double radius, double half_gap) {
  return [=](const Vec3& p) {
    return std::min(length(p - Vec3{half_gap, 0, 0}), length(p + Vec3{half_gap, 0, 0})) - radius;
  };
}

Vec3 node_place(const MarchBlock& block, std::size_t at, const Vec3& shift) {
  const auto n1 = static_cast<std::size_t>(block.n[1]);
  const auto n2 = static_cast<std::size_t>(block.n[2]);
  const Vec3 p{static_cast<double>(at / (n1 * n2)), static_cast<double>((at / n2) % n1),
               static_cast<double>(at % n2)};
  const Vec3 middle{(block.n[0] - 1) / 2.0, (block.n[1] - 1) / 2.0, (block.n[2] - 1) / 2.0};
  return p - middle + shift;
}

/// A block about the origin where nodes within `band` voxels of the surface are fixed and the
/// others unknown with only their sign.
MarchBlock banded(const Distance& distance, int side, double band, double voxel = 1.0,
                  const Vec3& shift = kShift) {
  MarchBlock block;
  block.n = {side, side, side};
  block.voxel = static_cast<float>(voxel);
  const auto size = static_cast<std::size_t>(side) * static_cast<std::size_t>(side * side);
  block.value.resize(size);
  block.state.resize(size);
  for (std::size_t at = 0; at < size; ++at) {
    const double d = distance(node_place(block, at, shift));
    const bool fixed = std::abs(d) <= band;
    block.state[at] = fixed ? MarchBlock::kFixed : MarchBlock::kUnknown;
    block.value[at] = static_cast<float>(fixed ? d * voxel : (d < 0.0 ? -1.0 : 1.0));
  }
  return block;
}

struct ErrorFigures {
  double p95 = 0.0;
  double max = 0.0;
  std::size_t count = 0;
};

/// |solved - exact| in voxels over the unknown nodes within `limit` voxels of the surface.
ErrorFigures errors(const MarchBlock& block, const Distance& distance, double limit,
                    const Vec3& shift = kShift) {
  std::vector<double> all;
  for (std::size_t at = 0; at < block.value.size(); ++at) {
    if (block.state[at] != MarchBlock::kUnknown) continue;
    const double exact = distance(node_place(block, at, shift));
    if (std::abs(exact) > limit) continue;
    all.push_back(std::abs(static_cast<double>(block.value[at] / block.voxel) - exact));
  }
  if (all.empty()) return {};
  std::sort(all.begin(), all.end());
  return {all[all.size() * 95 / 100], all.back(), all.size()};
}

ErrorFigures march_errors(const Distance& distance, int side, double band, double limit) {
  MarchBlock block = banded(distance, side, band);
  fast_march(block, static_cast<float>(limit + 1.0));
  return errors(block, distance, limit);
}

void expect_figures(const ErrorFigures& figures, double p95, double max) {
  EXPECT_GT(figures.count, 1000U);
  EXPECT_LE(figures.p95, p95);
  EXPECT_LE(figures.max, max);
  ::testing::Test::RecordProperty("p95_voxel", std::to_string(figures.p95));
  ::testing::Test::RecordProperty("max_voxel", std::to_string(figures.max));
}

TEST(FastMarch, SecondOrderOnBall) {
  expect_figures(march_errors(ball(20.0), 65, 1.0, 40.0), 0.02, 0.5);
  expect_figures(march_errors(ball(20.0), 65, 3.0, 40.0), 0.02, 0.5);
}

TEST(FastMarch, SolvesThinStartOfOneLayer) {
  expect_figures(march_errors(ball(20.0), 65, 0.87, 40.0), 0.03, 0.5);
}

TEST(FastMarch, ConvergesOnBallOutside) {
  const auto outside = [](double radius, int side) {
    const Distance exact = ball(radius);
    MarchBlock block = banded(exact, side, 2.0);
    fast_march(block, static_cast<float>(side));
    return errors(block, exact, radius / 2.0).p95 / radius;
  };
  // Second order: half the relative voxel size, at least a third of the relative error.
  EXPECT_LT(outside(24.0, 73), outside(12.0, 37) / 3.0);
}

TEST(FastMarch, IsExactForPlanesAlongTheLattice) {
  for (const double offset : {-7.3, -0.5, 0.0, 0.21, 11.9}) {
    for (const Vec3& normal : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}}) {
      expect_figures(march_errors(plane(normal, offset), 33, 1.5, 40.0), 1e-5, 1e-4);
    }
  }
}

/// Turns into walls the nodes whose upwind cone leaves the block before it meets the plane: there
/// the scheme has one axis less to work with, whatever its order.
MarchBlock with_whole_cones(const MarchBlock& solved, const Vec3& unit, const Distance& distance) {
  MarchBlock result = solved;
  for (std::size_t at = 0; at < solved.value.size(); ++at) {
    const Vec3 p = node_place(solved, at, kShift);
    const double d = distance(p);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (unit[axis] == 0.0) continue;
      const double half = (solved.n[axis] - 1) / 2.0;
      const double end = p[axis] - kShift[axis] - d / unit[axis];
      if (std::abs(end) > half) result.state[at] = MarchBlock::kWall;
    }
  }
  return result;
}

TEST(FastMarch, SolvesPlanesOfAnyOrientation) {
  for (const Vec3& normal : {Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{3, -2, 1}, Vec3{0.4, 1, -0.3}}) {
    for (const double offset : {-6.4, 0.3, 8.7}) {
      const Distance exact = plane(normal, offset);
      MarchBlock block = banded(exact, 49, 2.0);
      fast_march(block, 100.0F);
      const MarchBlock judged = with_whole_cones(block, normalized(normal), exact);
      expect_figures(errors(judged, exact, 30.0), 1e-4, 1e-4);
    }
  }
}

TEST(FastMarch, SolvesTorusInsideAndOut) {
  expect_figures(march_errors(torus(20.0, 8.0), 65, 1.5, 12.0), 0.05, 0.5);
}

TEST(FastMarch, KeepsTheMedialAxisOfTwoBalls) {
  expect_figures(march_errors(two_balls(9.0, 15.0), 65, 1.5, 16.0), 0.04, 0.5);
}

TEST(FastMarch, ScalesWithTheVoxel) {
  MarchBlock unit = banded(ball(10.0), 33, 1.5);
  MarchBlock quarter = banded(ball(10.0), 33, 1.5, 0.25);
  EXPECT_EQ(fast_march(unit, 50.0F), fast_march(quarter, 12.5F));
  for (std::size_t at = 0; at < unit.value.size(); ++at) {
    ASSERT_EQ(unit.value[at] * 0.25F, quarter.value[at]) << at;
  }
}

TEST(FastMarch, StopsAtTheLimitAndKeepsSigns) {
  const Distance exact = ball(12.0);
  MarchBlock block = banded(exact, 41, 1.5);
  const MarchBlock given = block;
  const std::int64_t solved = fast_march(block, 5.0F);
  std::int64_t below = 0;
  for (std::size_t at = 0; at < block.value.size(); ++at) {
    if (given.state[at] != MarchBlock::kUnknown) continue;
    ASSERT_EQ(block.value[at] < 0.0F, given.value[at] < 0.0F) << at;
    ASSERT_LE(std::abs(block.value[at]), 5.0F) << at;
    ASSERT_GT(std::abs(block.value[at]), 0.0F) << at;
    below += std::abs(block.value[at]) < 5.0F ? 1 : 0;
  }
  EXPECT_EQ(solved, below);
  EXPECT_GT(solved, 1000);
}

TEST(FastMarch, LeavesFixedNodesAndWallsUntouched) {
  MarchBlock block = banded(ball(10.0), 33, 1.5);
  const std::size_t plane_size = 33 * 33;
  for (std::size_t at = 0; at < 3 * plane_size; ++at) {
    block.state[at] = MarchBlock::kWall;
    block.value[at] = -12345.0F;
  }
  const MarchBlock given = block;
  fast_march(block, 60.0F);
  for (std::size_t at = 0; at < block.value.size(); ++at) {
    if (given.state[at] == MarchBlock::kUnknown) continue;
    ASSERT_EQ(block.value[at], given.value[at]) << at;
  }
  EXPECT_EQ(block.state, given.state);
}

/// Two rooms joined by a door: distance has to walk through it.
TEST(FastMarch, GoesAroundWalls) {
  MarchBlock block;
  block.n = {31, 31, 1};
  block.value.assign(31 * 31, 1.0F);
  block.state.assign(31 * 31, MarchBlock::kUnknown);
  for (std::size_t i = 0; i < 30; ++i) block.state[i * 31 + 15] = MarchBlock::kWall;
  for (std::size_t i = 0; i < 31; ++i) {
    block.state[i * 31] = MarchBlock::kFixed;
    block.value[i * 31] = 0.0F;
  }
  fast_march(block, 100.0F);
  EXPECT_NEAR(block.value[30 * 31 + 30], 30.0F, 1.0F);
  const double shortest =
      15.0 + std::hypot(30.0, 15.0);  // along the floor, then up behind the wall
  EXPECT_NEAR(static_cast<double>(block.value[0 * 31 + 30]), shortest, 1.5);
}

TEST(FastMarch, GivesTheLimitWithoutSources) {
  MarchBlock block;
  block.n = {4, 5, 6};
  block.value.assign(120, 1.0F);
  block.value[7] = -0.25F;
  block.value[8] = -0.0F;
  block.state.assign(120, MarchBlock::kUnknown);
  EXPECT_EQ(fast_march(block, 3.0F), 0);
  EXPECT_EQ(block.value[0], 3.0F);
  EXPECT_EQ(block.value[7], -3.0F);
  EXPECT_EQ(block.value[8], 3.0F);
}

TEST(FastMarch, AcceptsAnEmptyBlock) {
  MarchBlock block;
  block.n = {0, 0, 0};
  EXPECT_EQ(fast_march(block, 1.0F), 0);
}

/// Dirichlet data that lie far from any zero crossing: a hole in a field given all around.
TEST(FastMarch, FillsAHoleFromDistantData) {
  const Distance exact = ball(40.0);
  const Vec3 shift{60.3, 3.2, -7.1};
  MarchBlock block = banded(exact, 33, 1000.0, 1.0, shift);
  const Vec3 middle = shift;
  for (std::size_t at = 0; at < block.value.size(); ++at) {
    if (length(node_place(block, at, shift) - middle) > 10.0) continue;
    block.state[at] = MarchBlock::kUnknown;
    block.value[at] = 1.0F;
  }
  fast_march(block, 200.0F);
  expect_figures(errors(block, exact, 200.0, shift), 0.01, 0.05);
}

/// A positive node between negative ones whose signed values lie far below: no negative result.
TEST(FastMarch, ClampsToASmallPositiveResult) {
  MarchBlock block;
  block.n = {3, 1, 1};
  block.value = {-5.0F, 1.0F, -5.0F};
  block.state = {MarchBlock::kFixed, MarchBlock::kUnknown, MarchBlock::kFixed};
  EXPECT_EQ(fast_march(block, 10.0F), 1);
  EXPECT_EQ(block.value[1], 1e-3F);
}

TEST(FastMarch, UsesValuesAcrossTheSurface) {
  MarchBlock block;
  block.n = {4, 1, 1};
  block.value = {-1.3F, -0.3F, 1.0F, 1.0F};
  block.state = {MarchBlock::kFixed, MarchBlock::kFixed, MarchBlock::kUnknown,
                 MarchBlock::kUnknown};
  fast_march(block, 10.0F);
  EXPECT_NEAR(block.value[2], 0.7F, 1e-6F);
  EXPECT_NEAR(block.value[3], 1.7F, 1e-6F);
}

TEST(FastMarch, RepeatsTheSameBits) {
  MarchBlock first = banded(two_balls(9.0, 13.0), 49, 1.5);
  MarchBlock second = first;
  fast_march(first, 30.0F);
  fast_march(second, 30.0F);
  EXPECT_EQ(
      std::memcmp(first.value.data(), second.value.data(), first.value.size() * sizeof(float)), 0);
}

}  // namespace
}  // namespace argil
