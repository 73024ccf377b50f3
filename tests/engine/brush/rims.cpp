// SPDX-License-Identifier: GPL-3.0-or-later
// Where a tool's surface meets the clay's: how even the edge is, and what later dabs do to it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/surface.h"
#include "argil/mesh/bodies.h"

#include "edit/edge_rounding.h"
#include "support/measure/mesh_topology.h"
#include "support/measure/rim.h"
#include "support/measure/self_intersection.h"

namespace argil {
namespace {

using test::dab_of;
using test::measure_rim;
using test::nine_rims;
using test::RimCase;
using test::RimMeasure;
using test::rms_between;

constexpr double kVoxel = test::kRimVoxel;

RimMeasure measured_after(const RimCase& rim, int dabs, std::optional<double> edge, double voxel) {
  Clay clay = test::rim_ball(edge);
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
  const std::vector<RimCase> cases = nine_rims(tool_mm);
  for (const RimCase& rim : cases) {
    const RimMeasure measured = measured_after(rim, 1, edge, voxel);
    const double serration = measured.serration_rms() / voxel;
    std::printf("rim %s: serration %.4f offset %.3f surface %.4f\n",
                rim.is_carved ? "carve" : "add", serration, measured.mean() / voxel,
                measured.surface_rms / voxel);
    all.worst_serration = std::max(all.worst_serration, serration);
    all.serration_rms += serration * serration / static_cast<double>(cases.size());
    all.surface_rms +=
        std::pow(measured.surface_rms / voxel, 2.0) / static_cast<double>(cases.size());
  }
  all.serration_rms = std::sqrt(all.serration_rms);
  all.surface_rms = std::sqrt(all.surface_rms);
  std::printf("tool %.3g: serration rms %.4f worst %.4f surface %.4f\n", tool_mm, all.serration_rms,
              all.worst_serration, all.surface_rms);
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
  for (const RimCase& rim : nine_rims(8.0)) {
    const RimMeasure one = measured_after(rim, 1, {}, 4 * kVoxel);
    const RimMeasure ten = measured_after(rim, 10, {}, 4 * kVoxel);
    std::printf("ten dabs move it by %.4f\n", rms_between(one, ten) / (4 * kVoxel));
    EXPECT_LE(rms_between(one, ten) / (4 * kVoxel), 0.01);
  }
}

/// A dab over and over, until the middle of what it scrapes is flat.
TEST(Rims, OfWhatIsScrapedAreEven) {
  constexpr double kTool = 4.0;
  constexpr double kToolVoxel = 0.5;
  for (const Vec3& way : test::rim_directions()) {
    const Vec3 axis = normalized(way);
    Clay clay = Clay::ball(1.5 * kTool, ClayOptions{.voxel_mm = kVoxel}).value();
    Stroke stroke;
    stroke.tool.action = Action::scrape;
    stroke.tool.radii_mm = {kTool, kTool, kTool};
    stroke.tool.strength = 1.0;
    stroke.samples.resize(1);
    stroke.samples[0].position_mm = axis * (1.25 * kTool);
    for (int n = 0; n < 15; ++n) ASSERT_TRUE(clay.apply(stroke).ok());
    const TriangleMesh mesh = extract_surface(clay);
    double height = 0.0;
    int count = 0;
    for (const Vec3& p : mesh.positions) {
      const double along = dot(p, axis);
      if (along < 0.0 || length(p - along * axis) > 0.25 * kTool) continue;
      height += along;
      ++count;
    }
    ASSERT_GT(count, 10);
    constexpr double kPlane = 1e4;  // as good as flat
    const RimCase rim{1.5 * kTool, axis * (height / count + kPlane), kPlane, true};
    const RimMeasure measured = measure_rim(mesh, rim, kToolVoxel);
    EXPECT_LE(measured.serration_rms(), 0.042 * kToolVoxel);
    EXPECT_LE(measured.surface_rms, 0.045 * kToolVoxel);
  }
}

/// The ball that rolls in the groove around an added ball touches both: its middle is on a circle.
double worst_of_fillet(double radius_mm, double* mean_radius_mm) {
  const double tool = 8.0;
  const Vec3 axis = normalized(test::rim_directions()[0]);
  Clay clay = test::rim_ball(radius_mm);
  const RimCase rim{test::kRimBall, axis * test::kRimBall, tool, false};
  EXPECT_TRUE(clay.apply(dab_of(rim)).ok());
  EXPECT_TRUE(clay.validate().empty());
  const double a = test::kRimBall + radius_mm;
  const double b = tool + radius_mm;
  const double along = (test::kRimBall * test::kRimBall + a * a - b * b) / (2.0 * test::kRimBall);
  const double across = std::sqrt(a * a - along * along);
  double worst = 0.0;
  double sum = 0.0;
  int count = 0;
  for (const Vec3& p : extract_surface(clay).positions) {
    const double z = dot(p, axis);
    const double off = length(p - z * axis);
    // Between the two feet of the rolling ball, seen from its middle.
    const Vec3 from{off - across, z - along, 0.0};
    const Vec3 to_ball = Vec3{-across, -along, 0.0} / a;
    const Vec3 to_tool = Vec3{-across, test::kRimBall - along, 0.0} / b;
    const Vec3 way = from / length(from);
    const double opening = dot(to_ball, to_tool);
    if (dot(way, to_ball) < opening || dot(way, to_tool) < opening) continue;
    if (length(from) > 2.0 * radius_mm) continue;
    worst = std::max(worst, std::abs(length(from) - radius_mm));
    sum += length(from);
    ++count;
  }
  EXPECT_GT(count, 200);
  *mean_radius_mm = sum / count;
  return worst;
}

TEST(Rims, AreFilletedAsWideAsAsked) {
  for (const double radius : {1.0, 2.0, 3.0}) {
    double mean = 0.0;
    const double worst = worst_of_fillet(radius, &mean);
    std::printf("fillet %g: mean %g worst off %g\n", radius, mean, worst);
    EXPECT_NEAR(mean, radius, 0.1 * radius);
    EXPECT_LE(worst, 0.25 * radius);
  }
}

TEST(Rims, AreAsSharpAsTheLatticeAllowsWithRadius0) {
  const RimCase rim = nine_rims(8.0).front();
  const RimMeasure sharp = measured_after(rim, 1, 0.0, 4 * kVoxel);
  const RimMeasure usual = measured_after(rim, 1, {}, 4 * kVoxel);
  EXPECT_GT(sharp.mean(), 0.7 * usual.mean());
  EXPECT_GT(sharp.serration_rms(), usual.serration_rms());
}

TEST(Rims, KeepFinerLeavesOnlyWhileTheyAreThere) {
  Clay clay = test::rim_ball({});
  const auto leaves = [&](std::size_t level) { return clay.level_stats()[level].leaves; };
  ASSERT_EQ(leaves(1), 0);
  RimCase rim = nine_rims(8.0).front();
  ASSERT_TRUE(clay.apply(dab_of(rim)).ok());
  EXPECT_GT(leaves(1), 20);
  rim.tool_mm = 24.0;  // takes that rim away and leaves a wider one, a level coarser
  ASSERT_TRUE(clay.apply(dab_of(rim)).ok());
  EXPECT_EQ(leaves(1), 0);
  EXPECT_GT(leaves(2), 20);
}

/// A bowl whose way lies along a plane of symmetry, and one that a mask holds in part.
TEST(Rims, OfSweptMirroredAndMaskedDabsAreSound) {
  for (const bool is_masked : {false, true}) {
    Clay clay = test::rim_ball({});
    Stroke stroke = dab_of(nine_rims(8.0).front());
    stroke.samples[0].position_mm = {3.0, -39.0, 5.0};
    stroke.samples.push_back(stroke.samples[0]);
    stroke.samples.back().time_s = 1.0;
    stroke.samples.back().position_mm = {9.0, -38.0, 12.0};
    stroke.mirror.x = true;
    if (is_masked) {
      Stroke mask = stroke;
      mask.tool.action = Action::mask;
      mask.samples.resize(1);
      mask.samples[0].position_mm.z += 6.0;
      ASSERT_TRUE(clay.apply(mask).ok());
    }
    for (int n = 0; n < 2; ++n) {
      const auto report = clay.apply(stroke);
      ASSERT_TRUE(report.ok());
      EXPECT_TRUE(is_masked || report.value().symmetry == StrokeSymmetry::exact);
    }
    const auto faults = clay.validate();
    EXPECT_TRUE(faults.empty()) << faults.front();
    const TriangleMesh surface = extract_surface(clay);
    EXPECT_EQ(test::find_mesh_faults(surface), test::MeshFaults{});
    EXPECT_EQ(test::find_soup_faults(surface), test::SoupFaults{});
  }
}

/// A combination has no tool, so its edges are written at level 0 and rounded by 1.5 of its voxels.
TEST(Rims, OfCutsAndCombinationsAreEven) {
  const Vec3 axis = normalized(test::rim_directions()[0]);
  constexpr double kSmall = 10.0;
  const ClayOptions options{.voxel_mm = kVoxel};
  std::vector<std::pair<RimCase, Operation>> all;
  constexpr double kPlane = 1e4;  // as good as flat
  all.push_back({{kSmall, axis * (6.0 + kPlane), kPlane, true}, Cut{axis * 6.0, axis, false}});
  for (const CombineKind kind : {CombineKind::unite, CombineKind::subtract}) {
    Combine with;
    with.kind = kind;
    with.clay = std::make_shared<const Clay>(Clay::ball(4.0, options).value());
    with.placement.position_mm = axis * kSmall;
    all.push_back({{kSmall, axis * kSmall, 4.0, kind == CombineKind::subtract}, with});
  }
  for (const auto& [rim, operation] : all) {
    Clay clay = Clay::ball(kSmall, options).value();
    ASSERT_TRUE(clay.apply(operation).ok());
    const RimMeasure measured = measure_rim(extract_surface(clay), rim, kVoxel);
    std::printf("combined: serration %.4f surface %.4f\n", measured.serration_rms() / kVoxel,
                measured.surface_rms / kVoxel);
    EXPECT_LE(measured.serration_rms(), 0.06 * kVoxel);
    EXPECT_LE(measured.surface_rms, 0.27 * kVoxel);
  }
}

/// Fillets of many voxels, over leaves as fine as the clay has.
TEST(Rims, OfWideFilletsAreWholeSurfaces) {
  const ClayOptions sharp{.voxel_mm = kVoxel};
  for (const double voxels : {4.0, 8.0, 12.0}) {
    ClayOptions options = sharp;
    options.edge_radius_mm = voxels * kVoxel;
    Combine with;
    with.clay = std::make_shared<const Clay>(Clay::ball(8.0, sharp).value());
    with.placement.position_mm = {9.0, 4.0, 1.0};
    Stroke box;
    box.tool.action = Action::add;
    box.tool.shape = Shape::box;
    box.tool.radii_mm = {6.0, 4.0, 5.0};
    box.samples.resize(1);
    box.samples[0].position_mm = {0.0, 2.0, 9.0};
    const auto expect_sound = [&](const auto& what, const char* name) {
      SCOPED_TRACE(std::string(name) + ", voxels: " + std::to_string(voxels));
      Clay clay = Clay::ball(10.0, options).value();
      ASSERT_TRUE(clay.apply(what).ok());
      EXPECT_TRUE(clay.validate().empty());
      const TriangleMesh surface = extract_surface(clay);
      EXPECT_EQ(test::find_mesh_faults(surface), test::MeshFaults{});
      EXPECT_EQ(mesh::mesh_bodies(surface).count, 1U);
    };
    with.kind = CombineKind::unite;
    expect_sound(Operation(with), "union");
    with.kind = CombineKind::subtract;
    expect_sound(Operation(with), "difference");
    expect_sound(Operation(Cut{{0, 0, 3.0}, {0, 0.3, 1.0}, false}), "cut");
    expect_sound(box, "box");
  }
}

/// What a mask holds stays where the edge beside it is wider than the tool's bounds.
TEST(Rims, LeaveMaskedMatterAlone) {
  ClayOptions options{.voxel_mm = kVoxel};
  options.edge_radius_mm = 2.0;
  Clay clay = Clay::block({24.0, 24.0, 12.0}, options).value();
  const Clay before = Clay::block({24.0, 24.0, 12.0}, options).value();
  Stroke mask;
  mask.tool.action = Action::mask;
  mask.tool.radii_mm = {4.0, 4.0, 4.0};
  mask.samples.resize(1);
  mask.samples[0].position_mm = {8.1, 0.0, 6.0};
  for (int n = 0; n < 6; ++n) ASSERT_TRUE(clay.apply(mask).ok());
  Stroke carve = mask;
  carve.tool.action = Action::carve;
  carve.samples[0].position_mm = {0.0, 0.0, 6.0};
  ASSERT_TRUE(clay.apply(carve).ok());
  int held = 0;
  for (double x = 4.0; x < 9.0; x += 0.1) {
    const Vec3 p{x, 0.0, 6.0};
    if (clay.mask_at(p) < 0.999) continue;
    EXPECT_NEAR(clay.distance_at(p), before.distance_at(p), 0.05) << x;
    ++held;
  }
  EXPECT_GT(held, 10);
}

// ---- the rule itself ---------------------------------------------------------------------------

TEST(RoundedMax, IsTheDistanceToAWedgeOpenedByABall) {
  // Planes x <= 0 and y <= 0: the ball's middle rolls on the corner at (-1, -1).
  for (const double x : {-3.0, -0.9, -0.5, 0.0, 0.7}) {
    for (const double y : {-2.0, -0.8, -0.4, 0.2, 1.0}) {
      const bool is_round = x > -0.95 && y > -0.95;
      const double expected = is_round ? std::hypot(x + 1.0, y + 1.0) - 1.0 : std::max(x, y);
      EXPECT_NEAR(rounded_max(x, y, 0.0, 1.0), expected, 1e-12) << x << " " << y;
    }
  }
}

TEST(RoundedMax, IsTheDistanceToTheSharpWedgeWithoutARadius) {
  EXPECT_NEAR(rounded_max(0.3, 0.4, 0.0, 0.0), 0.5, 1e-12);
  EXPECT_EQ(rounded_max(-0.3, 0.4, 0.0, 0.0), 0.4);
}

TEST(RoundedMax, IsTheMaximumOfParallelPlanes) {
  EXPECT_EQ(rounded_max(0.3, 0.25, 1.0, 1.0), 0.3);
  EXPECT_EQ(rounded_max(0.3, 0.25, -1.0, 1.0), 0.3);
}

}  // namespace
}  // namespace argil
