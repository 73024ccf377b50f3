// SPDX-License-Identifier: GPL-3.0-or-later
// How near the surface of an offset block is to where it belongs, everywhere.
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/operation.h"
#include "argil/engine/surface.h"

#include "support/effort.h"

namespace argil::test {
namespace {

/// From a block around the origin, which has sharp edges.
double distance_from_block(const Vec3& size, const Vec3& p) {
  const Vec3 beyond{std::abs(p.x) - 0.5 * size.x, std::abs(p.y) - 0.5 * size.y,
                    std::abs(p.z) - 0.5 * size.z};
  const Vec3 outside{std::max(beyond.x, 0.0), std::max(beyond.y, 0.0), std::max(beyond.z, 0.0)};
  return length(outside) + std::min(std::max({beyond.x, beyond.y, beyond.z}), 0.0);
}

/// In mm, of all vertices.
double farthest_off(const Vec3& size, double voxel_mm, double offset_mm) {
  Clay clay = Clay::block(size, {voxel_mm, ClayOptions{}.tolerance_voxels, 0.0}).value();
  EXPECT_TRUE(clay.apply(Offset{offset_mm}));
  double most = 0.0;
  for (const Vec3& p : extract_surface(clay).positions) {
    most = std::max(most, std::abs(distance_from_block(size, p) - offset_mm));
  }
  return most;
}

/// Wherever edges lie among the nodes and the leaves: beside some the finest level is not stored.
TEST(OperationOffset, HasRoundEdgesWhereverTheyLieAmongTheLeaves) {
  constexpr double kVoxel = 0.4;
  for (const Vec3& size : {Vec3{90.0, 38.0, 4.0}, Vec3{90.0, 38.0, 20.0}, Vec3{90.0, 40.0, 20.0}}) {
    for (const double offset : effort<std::vector<double>>({1.0, 3.0}, {0.7, 1.0, 2.0, 3.0, 4.0})) {
      EXPECT_LT(farthest_off(size, kVoxel, offset), 0.42 * kVoxel)
          << size.x << " x " << size.y << " x " << size.z << " by " << offset;
    }
  }
}

TEST(OperationOffset, HasRoundEdgesOfBlocksOfAnySize) {
  std::mt19937 dice(7);  // the standard says what it gives, not what distributions do with it
  const auto between = [&dice](double low, double high) {
    return low + (high - low) * static_cast<double>(dice()) / 4294967296.0;
  };
  double most = 0.0;
  for (int n = 0; n < effort(6, 72); ++n) {
    const double voxel = std::array{0.2, 0.4, 0.7}[static_cast<std::size_t>(n) % 3];
    const double offset = std::array{1.75, 5.0, 10.0}[static_cast<std::size_t>(n) / 3 % 3] * voxel;
    const Vec3 size{between(20.0, 100.0) * voxel, between(20.0, 60.0) * voxel,
                    between(10.0, 50.0) * voxel};
    const double off = farthest_off(size, voxel, offset) / voxel;
    EXPECT_LT(off, 0.75) << size.x << " x " << size.y << " x " << size.z << " by " << offset;
    most = std::max(most, off);
  }
  std::cout << "farthest of all vertices " << most << " voxels off\n";
}

/// Where a level ends the surface may be beyond: what lies beside it rises no less than it should.
TEST(OperationOffset, KeepsFlatFacesFlatWhereALevelEndsBesideThem) {
  constexpr double kVoxel = 0.4;
  EXPECT_LT(farthest_off({90.2, 38.2, 20.2}, kVoxel, 3.0), 0.3 * kVoxel);
  EXPECT_LT(farthest_off({90.1, 38.3, 20.35}, kVoxel, 3.0), 0.3 * kVoxel);
}

}  // namespace
}  // namespace argil::test
