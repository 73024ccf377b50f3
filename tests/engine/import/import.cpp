// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/import.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "import/import_field.h"
#include "import/import_input.h"
#include "import/machine_memory.h"
#include "support/effort.h"
#include "support/shapes.h"

namespace argil {
namespace {

TriangleMesh box_of(const Box3& box) { return test::box_mesh(box.size(), box.center()); }

using ::testing::HasSubstr;
using Field = std::function<double(const Vec3&)>;

constexpr double kVoxel = 0.25;

ClayOptions options(double voxel_mm = kVoxel) { return {voxel_mm, 0.1}; }

ImportResult imported(const TriangleMesh& mesh, double voxel_mm = kVoxel) {
  auto result = import_mesh(mesh, options(voxel_mm));
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return std::move(result).value();
}

Error refusal(const TriangleMesh& mesh, const ClayOptions& with = options(),
              std::uint64_t limit = 0) {
  const auto result = import_mesh(mesh, with, {}, limit);
  EXPECT_FALSE(result.ok());
  return result.ok() ? Error{} : result.error();
}

struct Spread {
  double worst = 0.0;
  double p99 = 0.0;
  std::size_t nodes = 0;
};

/// The finest level before what is not needed is dropped from it.
VdbGrid::Ptr finest_of(const TriangleMesh& mesh) {
  const auto input = prepare_import(mesh, options());
  EXPECT_TRUE(input.ok());
  auto finest = build_finest_level(input.value(), {}, available_bytes());
  EXPECT_TRUE(finest.ok()) << (finest.ok() ? "" : finest.error().message);
  return finest.value().grid;
}

/// How far the active nodes of the finest level are from the true distance, in voxels, where that
/// is within `within` voxels.
Spread error_of_nodes(const TriangleMesh& mesh, const Field& truth,
                      double within = kHalfWidthVoxels - 1) {
  const VdbGrid::Ptr grid = finest_of(mesh);
  std::vector<double> errors;
  for (auto node = grid->tree().cbeginValueOn(); node; ++node) {
    const Coord c = node.getCoord();
    const double t = truth({c.x() * kVoxel, c.y() * kVoxel, c.z() * kVoxel});
    if (std::abs(t) > within * kVoxel) continue;
    errors.push_back(std::abs(t - static_cast<double>(*node)) / kVoxel);
  }
  if (errors.empty()) return {};
  std::sort(errors.begin(), errors.end());
  return {errors.back(), errors[errors.size() * 99 / 100], errors.size()};
}

Field ball_field(const Vec3& center, double radius) {
  return [=](const Vec3& p) { return length(p - center) - radius; };
}

double box_distance(const Vec3& p, const Box3& box) {
  const Vec3 c = box.center();
  const Vec3 half = box.size() * 0.5;
  Vec3 q{std::abs(p.x - c.x) - half.x, std::abs(p.y - c.y) - half.y, std::abs(p.z - c.z) - half.z};
  const double inside = std::min(0.0, std::max({q.x, q.y, q.z}));
  return inside + length({std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)});
}

/// The exact distance to the union of two balls, inside included: the nearer cap, or the circle in
/// which the spheres meet.
double two_balls(const Vec3& p, double half_gap, double radius) {
  const double a = length(p - Vec3{-half_gap, 0, 0}) - radius;
  const double b = length(p - Vec3{half_gap, 0, 0}) - radius;
  if (std::min(a, b) >= 0.0) return std::min(a, b);
  // The nearest point of a sphere serves where it lies on its own side of the middle plane.
  const double circle = std::sqrt(radius * radius - half_gap * half_gap);
  const double to_circle = std::hypot(p.x, std::hypot(p.y, p.z) - circle);
  double nearest = to_circle;
  for (const double side : {-1.0, 1.0}) {
    const Vec3 center{side * half_gap, 0, 0};
    const Vec3 foot = center + normalized(p - center) * radius;
    if (foot.x * side >= 0.0) nearest = std::min(nearest, length(foot - p));
  }
  return -nearest;
}

TEST(ImportBall, HasTheDistanceToTheSphereItsTrianglesApproach) {
  const Vec3 center{1.03, -2.01, 0.37};
  const TriangleMesh mesh = test::ball_mesh(10.0, 7, center);
  const Spread error = error_of_nodes(mesh, ball_field(center, 10.0));
  EXPECT_GT(error.nodes, 30000U);
  EXPECT_LT(error.worst, 0.01);  // the chords of 131 072 triangles
  const ImportResult got = imported(test::ball_mesh(10.0, test::effort(5, 7), center));
  EXPECT_FALSE(got.report.winding_bridged);
  EXPECT_EQ(got.report.bridged_nodes, 0);
  EXPECT_EQ(got.report.lost_vertices, 0);
  EXPECT_LT(got.report.max_vertex_distance_mm, 0.12 * kVoxel);  // what coarsening may miss
}

TEST(ImportBall, SatisfiesTheInvariantsOfClay) {
  const ImportResult got = imported(test::ball_mesh(10.0, 5));
  EXPECT_THAT(got.clay.validate(), ::testing::IsEmpty());
}

TEST(ImportBox, IsExactOnFacesEdgesAndCornersThoughItsFacesHoldNodes) {
  const Box3 box{{-5, -4, -3}, {5, 4, 3}};
  const Spread error =
      error_of_nodes(box_of(box), [&](const Vec3& p) { return box_distance(p, box); });
  EXPECT_GT(error.nodes, 10000U);
  EXPECT_LT(error.worst, 1e-5);
}

TEST(ImportOverlap, OfTwoBallsIsTheirUnionWithoutInnerWalls) {
  const TriangleMesh both =
      test::joined(test::ball_mesh(8.0, 6, {-4, 0, 0}), test::ball_mesh(8.0, 6, {4, 0, 0}));
  const Spread error = error_of_nodes(both, [](const Vec3& p) { return two_balls(p, 4.0, 8.0); });
  EXPECT_GT(error.nodes, 30000U);
  EXPECT_LT(error.p99, 0.05);
  EXPECT_LT(error.worst, 0.6);  // marched into the fan inside the sharp valley
  RecordProperty("p99", std::to_string(error.p99));
  RecordProperty("worst", std::to_string(error.worst));
  const ImportResult got = imported(both, test::effort(2.0 * kVoxel, kVoxel));
  EXPECT_LT(got.clay.distance_at({0, 0, 0}), -0.99);
  EXPECT_LT(got.clay.distance_at({4, 0, 0}), -0.99);  // on the wall of the other ball
  EXPECT_GT(got.report.lost_vertices, 0);             // those of the inner walls
}

TEST(ImportOverlap, OfTwoBoxesThatShareAFaceLeavesNothingBetween) {
  const TriangleMesh both =
      test::joined(box_of({{-6, -4, -4}, {0, 4, 4}}), box_of({{0, -3, -3}, {6, 3, 3}}));
  const ImportResult got = imported(both);
  EXPECT_LT(got.clay.distance_at({0, 0, 0}), -0.9);
  EXPECT_LT(got.clay.distance_at({0.1, 1, 1}), -0.9);
  EXPECT_GT(got.clay.distance_at({0.5, 0, 3.5}), 0.4);
}

TEST(ImportCavity, OfAnInwardShellStaysHollow) {
  const TriangleMesh nested =
      test::joined(test::ball_mesh(10.0, 6), test::inside_out(test::ball_mesh(6.0, 6)));
  const Spread error = error_of_nodes(
      nested, [](const Vec3& p) { return std::max(length(p) - 10.0, 6.0 - length(p)); });
  const ImportResult got = imported(nested, test::effort(2.0 * kVoxel, kVoxel));
  EXPECT_GT(error.nodes, 40000U);
  EXPECT_LT(error.worst, 0.01);
  EXPECT_GT(got.clay.distance_at({0, 0, 0}), 0.0);
}

TEST(ImportOpen, ClosesABoxWithoutItsFloorByTheFlatFloor) {
  const Box3 box{{-5.1, -4.1, -3.1}, {5.1, 4.1, 3.1}};
  TriangleMesh open = box_of(box);
  std::erase_if(open.triangles, [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return open.positions[v].z == box.min.z; });
  });
  ASSERT_EQ(open.triangles.size(), 10U);
  const ImportResult got = imported(open);
  EXPECT_TRUE(got.report.winding_bridged);
  EXPECT_GT(got.report.bridged_nodes, 0);
  const Spread error = error_of_nodes(open, [&](const Vec3& p) { return box_distance(p, box); });
  EXPECT_LT(error.p99, 0.15);
  EXPECT_LT(error.worst, 0.6);
  RecordProperty("p99", std::to_string(error.p99));
  RecordProperty("worst", std::to_string(error.worst));
}

TEST(ImportOpen, BridgesAHemisphereWiderThanTheBand) {
  // Where it is bridged does not depend on how fine its triangles are, only what it costs.
  const TriangleMesh half = test::cut_above(test::ball_mesh(8.0, test::effort(4, 6)), 0.0);
  const ImportResult got = imported(half);
  EXPECT_LT(got.clay.distance_at({0, 0, 4}), -0.9);
  EXPECT_NEAR(got.clay.distance_at({0.5, 0.2, -0.5}), 0.5, 0.15);
  EXPECT_NEAR(got.clay.distance_at({0.5, 0.2, 0.5}), -0.5, 0.15);
  EXPECT_GT(got.clay.distance_at({0, 0, -3}), 0.9);
}

TEST(ImportDeterminism, SameHashForAnyThreadCount) {
  const int splits = test::effort(4, 5);
  const TriangleMesh open = test::cut_above(test::ball_mesh(8.0, splits, {0.3, 0.2, 0.1}), -5.0);
  const TriangleMesh mesh = test::joined(open, test::ball_mesh(5.0, splits - 1, {6, 0, 0}));
  std::vector<std::uint64_t> hashes;
  for (const std::size_t threads : {1U, 2U, 7U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    hashes.push_back(imported(mesh, test::effort(0.8, kVoxel)).clay.hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(ImportRefuses, NothingAndWhatNamesNothing) {
  Error error = refusal({});
  EXPECT_EQ(error.kind, ErrorKind::bad_input);
  EXPECT_THAT(error.message, HasSubstr("no triangles"));
  error = refusal({{{0, 0, 0}, {1, 0, 0}}, {}, {{0, 1, 2}}});
  EXPECT_THAT(error.message, HasSubstr("triangle 0 names vertex 2 of 2"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  error = refusal({{{0, 0, 0}, {1, 0, 0}, {0, nan, 0}}, {}, {{0, 1, 2}}});
  EXPECT_THAT(error.message, HasSubstr("vertex 2"));
}

TEST(ImportRefuses, AFlatMeshWithoutVolume) {
  const TriangleMesh flat{{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}}, {}, {{0, 1, 2}, {0, 2, 3}}};
  Error error = refusal(flat);
  EXPECT_EQ(error.kind, ErrorKind::bad_input);
  EXPECT_THAT(error.message, HasSubstr("no volume"));
  const TriangleMesh twice{flat.positions, {}, {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}}};
  EXPECT_THAT(refusal(twice).message, HasSubstr("no volume"));
  const TriangleMesh line{{{0, 0, 0}, {5, 0, 0}, {9, 0, 0}}, {}, {{0, 1, 2}}};
  EXPECT_THAT(refusal(line).message, HasSubstr("area"));
}

TEST(ImportRefuses, SizesThatVoxelsCannotHold) {
  for (const double size : {1e12, 1e-12, 1e300}) {
    const Error error = refusal(test::ball_mesh(size, 2));
    EXPECT_EQ(error.kind, ErrorKind::bad_input) << size;
    EXPECT_THAT(error.message, HasSubstr("mm across")) << size;
    EXPECT_THAT(error.message, HasSubstr("--size-mm")) << size;
  }
  const Error far = refusal(test::ball_mesh(5.0, 2, {1e6, 0, 0}));
  EXPECT_THAT(far.message, HasSubstr("1e+06"));
}

TEST(ImportRefuses, OptionsOutOfRange) {
  const TriangleMesh ball = test::ball_mesh(5.0, 2);
  EXPECT_THAT(refusal(ball, {0.0, 0.1}).message, HasSubstr("voxel_mm is 0; must be from 0.0001"));
  EXPECT_THAT(refusal(ball, {0.25, 2.0}).message, HasSubstr("tolerance_voxels is 2; must be"));
  // OpenVDB threw.
  const TriangleMesh tiny = test::ball_mesh(0.005, 2);
  EXPECT_THAT(refusal(tiny, {1.25e-5, 0.1}).message, HasSubstr("voxel_mm is 1.25e-05; must be"));
}

TEST(ImportRefuses, MoreThanTheMemoryAndNamesTheVoxelThatFits) {
  const Error error = refusal(test::ball_mesh(50.0, 4), options(0.01));
  EXPECT_EQ(error.kind, ErrorKind::memory);
  const std::size_t at = error.message.find("choose voxels of ");
  ASSERT_NE(at, std::string::npos) << error.message;
  // A fourth of the area and of the memory: voxels as large.
  const TriangleMesh ball = test::ball_mesh(test::effort(25.0, 50.0), 4);
  const auto limit = test::effort<std::uint64_t>(5000000, 20000000);
  const Error less = refusal(ball, options(0.25), limit);
  EXPECT_EQ(less.kind, ErrorKind::memory);
  const double fits = std::stod(less.message.substr(less.message.find("voxels of ", 20) + 10));
  EXPECT_GT(fits, 0.25);
  EXPECT_LT(fits, 2.0);
  EXPECT_TRUE(import_mesh(ball, options(fits), {}, limit).ok()) << less.message;
}

/// It named voxels of 260 m.
TEST(ImportRefuses, MoreTrianglesThanTheMemoryHoldsWhateverTheVoxel) {
  const TriangleMesh ball = test::ball_mesh(50.0, 4);
  const Error error = refusal(ball, options(0.25), 100 * ball.triangles.size());
  EXPECT_EQ(error.kind, ErrorKind::memory);
  EXPECT_THAT(error.message, HasSubstr("a mesh of " + std::to_string(ball.triangles.size())));
  EXPECT_THAT(error.message, HasSubstr("fewer triangles"));
}

TEST(ImportProgress, StopsWhenAskedAndNamesItsStages) {
  std::vector<std::string> stages;
  const auto stop =
      import_mesh(test::ball_mesh(8.0, 4), options(), [&](std::string_view stage, double fraction) {
        EXPECT_GE(fraction, 0.0);
        EXPECT_LE(fraction, 1.0);
        stages.emplace_back(stage);
        return stage != "distance";
      });
  ASSERT_FALSE(stop.ok());
  EXPECT_EQ(stop.error().kind, ErrorKind::interrupted);
  EXPECT_EQ(stages.back(), "distance");
}

}  // namespace
}  // namespace argil
