// SPDX-License-Identifier: GPL-3.0-or-later
// Fewer triangles do not bring steps back to the rim of a tool.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/surface.h"
#include "argil/io/decimate.h"

#include "support/effort.h"
#include "support/measure/rim.h"

namespace argil {
namespace {

constexpr double kToolMm = 8.0;
constexpr double kToolVoxel = 1.0;

/// rms over the rims, in voxels of the tool's level.
double serration_at(std::int64_t triangles) {
  const std::vector<test::RimCase> all = test::nine_rims(kToolMm);
  // Usually one of each kind.
  const std::size_t step = test::effort(std::size_t{3}, std::size_t{1});
  double sum = 0.0;
  int count = 0;
  for (std::size_t n = 0; n < all.size(); n += step) {
    Clay clay = test::rim_ball({});
    EXPECT_TRUE(clay.apply(test::dab_of(all[n])).ok());
    mesh::DecimateOptions options;
    options.triangles = triangles;
    const auto made = io::decimate(extract_surface(clay), clay, options);
    EXPECT_TRUE(made.ok());
    if (!made) continue;
    const auto measured = test::measure_rim(made.value().mesh, all[n], kToolVoxel);
    const double serration = measured.serration_rms() / kToolVoxel;
    std::printf("rim %zu of %zu at %lld triangles: %.4f\n", n, all.size(),
                static_cast<long long>(triangles), serration);
    sum += serration * serration;
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(DecimatedRims, AreEvenWith20000Triangles) { EXPECT_LE(serration_at(20000), 0.025); }

TEST(DecimatedRims, AreEvenWith6000Triangles) { EXPECT_LE(serration_at(6000), 0.025); }

}  // namespace
}  // namespace argil
