// SPDX-License-Identifier: GPL-3.0-or-later
// Where a tool's surface meets the clay's: how even the edge is, and what later dabs do to it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/surface.h"

#include "edit/edge_rounding.h"
#include "support/rim.h"

namespace argil {
namespace {

using test::measure_rim;
using test::RimCase;
using test::RimMeasure;

constexpr double kBall = 40.0;
constexpr double kVoxel = 0.25;

const std::vector<Vec3>& directions() {
  static const std::vector<Vec3> all{
      {0.31, -0.87, 0.38}, {0.1, -0.99, 0.05}, {0.577, -0.577, 0.577}};
  return all;
}

/// Three kinds of rim, 58 to 96 degrees, in three directions, with a tool of 8 voxels' radius at
/// its level, where rims are worst.
std::vector<RimCase> nine_cases(double tool_mm) {
  std::vector<RimCase> cases;
  for (const auto& [is_carved, off] : {std::pair{true, 0.0}, {false, 0.0}, {true, 0.6}}) {
    for (const Vec3& way : directions()) {
      cases.push_back({kBall, normalized(way) * (kBall + off * tool_mm), tool_mm, is_carved});
    }
  }
  return cases;
}

Stroke dab_of(const RimCase& rim) {
  Stroke stroke;
  stroke.tool.action = rim.is_carved ? Action::carve : Action::add;
  stroke.tool.radii_mm = {rim.tool_mm, rim.tool_mm, rim.tool_mm};
  stroke.tool.strength = 1.0;
  stroke.samples.resize(1);
  stroke.samples[0].position_mm = rim.tool_at_mm;
  return stroke;
}

Clay ball_with(std::optional<double> edge_radius_mm) {
  ClayOptions options{.voxel_mm = kVoxel};
  options.edge_radius_mm = edge_radius_mm;
  return Clay::ball(kBall, options).value();
}

RimMeasure measured_after(const RimCase& rim, int dabs, std::optional<double> edge, double voxel) {
  Clay clay = ball_with(edge);
  for (int n = 0; n < dabs; ++n) EXPECT_TRUE(clay.apply(dab_of(rim)).ok());
  const auto faults = clay.validate();
  EXPECT_TRUE(faults.empty()) << faults.front();
  return measure_rim(extract_surface(clay), rim, voxel);
}

/// rms over all, and the worst, of both measures in voxels of the tool's level.
struct Summary {
  double serration_rms = 0.0;
  double worst_serration = 0.0;
  double surface_rms = 0.0;
};

Summary summary_of(double tool_mm, double voxel, std::optional<double> edge) {
  Summary all;
  const std::vector<RimCase> cases = nine_cases(tool_mm);
  for (const RimCase& rim : cases) {
    const RimMeasure measured = measured_after(rim, 1, edge, voxel);
    const double serration = measured.serration_rms() / voxel;
    std::printf("rim %s: serration %.4f offset %.3f surface %.4f\n",
                rim.is_carved ? "carve" : "add", serration, measured.mean() / voxel,
                measured.surface_rms / voxel);
    all.worst_serration = std::max(all.worst_serration, serration);
    all.serration_rms += serration * serration / static_cast<double>(cases.size());
    all.surface_rms += std::pow(measured.surface_rms / voxel, 2.0) / static_cast<double>(cases.size());
  }
  all.serration_rms = std::sqrt(all.serration_rms);
  all.surface_rms = std::sqrt(all.surface_rms);
  std::printf("tool %.3g: serration rms %.4f worst %.4f surface %.4f\n", tool_mm,
              all.serration_rms, all.worst_serration, all.surface_rms);
  return all;
}

TEST(Rims, AreEvenWithATool8VoxelsWide) {
  const Summary all = summary_of(8.0, 4 * kVoxel, {});
  EXPECT_LE(all.serration_rms, 0.025);
  EXPECT_LE(all.worst_serration, 0.03);
  EXPECT_LE(all.surface_rms, 0.04);
}

TEST(Rims, AreEvenWhereNothingIsFiner) {
  const Summary all = summary_of(2.0, kVoxel, {});
  EXPECT_LE(all.serration_rms, 0.028);
  EXPECT_LE(all.worst_serration, 0.04);
}

TEST(Rims, StayWhereTheyAreUnderTenEqualDabs) {
  double worst = 0.0;
  for (const RimCase& rim : nine_cases(8.0)) {
    const RimMeasure one = measured_after(rim, 1, {}, 4 * kVoxel);
    const RimMeasure ten = measured_after(rim, 10, {}, 4 * kVoxel);
    std::printf("ten dabs move it by %.4f\n", rms_between(one, ten) / (4 * kVoxel));
    worst = std::max(worst, rms_between(one, ten) / (4 * kVoxel));
  }
  EXPECT_LE(worst, 0.01);
}

}  // namespace
}  // namespace argil
