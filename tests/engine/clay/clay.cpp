// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/clay.h"

#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/surface.h"

#include "support/effort.h"
#include "support/measure/mesh_topology.h"
#include "support/measure/self_intersection.h"
#include "support/stroke_maker.h"

namespace argil {
namespace {

std::string violations(const std::vector<std::string>& lines) {
  std::string out;
  for (const auto& line : lines) out += line + "\n";
  return out;
}

Clay small_ball() {
  ClayOptions options;
  options.voxel_mm = 0.5;
  return Clay::ball(10.0, options).value();
}

TEST(ClayBall, HoldsItsInvariantsAndIsStoredNoFinerThanNeeded) {
  for (const double voxel : {0.1, 0.25, 1.0}) {
    ClayOptions options;
    options.voxel_mm = voxel;
    const Clay clay = Clay::ball(12.0, options).value();
    EXPECT_EQ(violations(clay.validate()), "") << "voxel " << voxel;
    for (const Vec3 p : {Vec3{12, 0, 0}, Vec3{0, -7.2, 9.6}, Vec3{4, 4, 10.5830052}}) {
      EXPECT_NEAR(clay.distance_at(p), length(p) - 12.0, 0.1 * voxel);
    }
  }
}

TEST(ClayBlock, KeepsSharpEdgesAtTheFinestLevelOnly) {
  ClayOptions options;
  options.voxel_mm = 0.25;
  const Clay clay = Clay::block({20, 16, 12}, options).value();
  EXPECT_EQ(violations(clay.validate()), "");
  EXPECT_NEAR(clay.distance_at({10, 0, 0}), 0.0, 0.05);
  EXPECT_GT(clay.level_stats()[0].leaves, 0);
  EXPECT_LT(clay.level_stats()[0].active_voxels, 150000);
}

Box3 cube(double half_mm) {
  Box3 box;
  box.include(Vec3{-half_mm, -half_mm, -half_mm});
  box.include(Vec3{half_mm, half_mm, half_mm});
  return box;
}

TEST(ClayFromDistance, MakesTheBallBitForBit) {
  const ClayOptions options{.voxel_mm = 0.5};
  const auto ball = [](const Vec3& p) { return length(p) - 10.0; };
  EXPECT_EQ(Clay::from_distance(ball, cube(10.0), options).value().hash(), small_ball().hash());
}

TEST(ClayFromDistance, HoldsItsInvariantsOffTheOrigin) {
  const auto torus = [](const Vec3& p) {
    return std::hypot(std::hypot(p.x - 30.0, p.y) - 10.0, p.z + 20.0) - 4.0;
  };
  Box3 box;
  box.include(Vec3{16, -14, -24});
  box.include(Vec3{44, 14, -16});
  const Clay clay = Clay::from_distance(torus, box, ClayOptions{.voxel_mm = 0.5}).value();
  EXPECT_EQ(violations(clay.validate()), "");
  EXPECT_NEAR(clay.distance_at({44, 0, -20}), 0.0, 0.05);
  EXPECT_LT(clay.distance_at({40, 0, -20}), -3.5);
}

TEST(ClayFromDistance, RefusesWhatItCannotDo) {
  const auto message = [](const std::function<double(const Vec3&)>& distance, const Box3& box) {
    const auto made = Clay::from_distance(distance, box, ClayOptions{.voxel_mm = 0.5});
    return made.ok() ? std::string("no error") : made.error().message;
  };
  const auto plane = [](const Vec3& p) { return p.z; };
  EXPECT_NE(message(nullptr, cube(10)).find("no formula"), std::string::npos);
  EXPECT_NE(message(plane, cube(1)).find("at least 4 mm wide"), std::string::npos);
  EXPECT_NE(message(plane, cube(1e9)).find("of the origin"), std::string::npos);
  EXPECT_NE(message(plane, cube(std::nan(""))).find("bounds_mm"), std::string::npos);
  EXPECT_NE(message([](const Vec3& p) { return std::sqrt(p.x); }, cube(10)).find("not a finite"),
            std::string::npos);
}

TEST(ClayCreate, RefusesBadNumbersByName) {
  const auto message = [](const Result<Clay>& r) {
    return r.ok() ? std::string("no error") : r.error().message;
  };
  ClayOptions options;
  EXPECT_NE(message(Clay::ball(-1.0, options)).find("radius_mm is -1"), std::string::npos);
  EXPECT_NE(message(Clay::ball(std::nan(""), options)).find("radius_mm"), std::string::npos);
  EXPECT_NE(message(Clay::block({1, 0, 1}, options)).find("size_mm"), std::string::npos);
  options.voxel_mm = 0.0;
  EXPECT_NE(message(Clay::ball(10.0, options)).find("voxel_mm is 0"), std::string::npos);
}

/// Voxels beyond what can be saved and read again, and sizes beyond a kilometre.
TEST(ClayCreate, RefusesWhatNoProjectHolds) {
  const auto message = [](const Result<Clay>& r) {
    return r.ok() ? std::string("no error") : r.error().message;
  };
  for (const double voxel : {1e-5, 1e8, -1.0, std::nan(""), HUGE_VAL}) {
    const ClayOptions options{.voxel_mm = voxel};
    const std::string range = "; must be from 0.0001 to 1000; choose another, or scale the model";
    EXPECT_NE(message(Clay::ball(20.0 * voxel, options)).find(range), std::string::npos) << voxel;
    EXPECT_NE(message(Clay::block({20.0 * voxel, 20.0 * voxel, 20.0 * voxel}, options)).find(range),
              std::string::npos)
        << voxel;
  }
  for (const double tolerance : {std::nan(""), -0.1, 1e308}) {
    const ClayOptions options{.tolerance_voxels = tolerance};
    EXPECT_NE(message(Clay::ball(10.0, options)).find("tolerance_voxels is "), std::string::npos);
  }
  for (const double edge : {std::nan(""), -0.1, 1e308}) {
    ClayOptions options;
    options.edge_radius_mm = edge;
    EXPECT_NE(message(Clay::ball(10.0, options)).find("edge_radius_mm is "), std::string::npos);
  }
  const ClayOptions coarse{.voxel_mm = 1e3};
  EXPECT_NE(message(Clay::ball(2e6, coarse)).find("to 1e+06 mm"), std::string::npos);
  EXPECT_NE(message(Clay::block({1e5, 1e5, 2e6}, coarse)).find("to 1e+06 mm"), std::string::npos);
  const Box3 wide{{-1e5, -1e5, -1e5}, {1e5, 1e5, 2e6}};
  const auto plane = [](const Vec3& p) { return p.z; };
  EXPECT_NE(message(Clay::from_distance(plane, wide, coarse)).find("within 1e+06 mm"),
            std::string::npos);
}

class EachAction : public testing::TestWithParam<Action> {};

TEST_P(EachAction, LeavesAValidClayAndUndoesBitForBit) {
  Clay clay = small_ball();
  const std::uint64_t start = clay.hash();
  Stroke stroke;
  stroke.tool = {GetParam(), Shape::ball, {4, 4, 4}, 0.8};
  stroke.samples = {{0.0, {8, 0, 0}, {}, 1.0}, {1.0, {6, 6, 2}, {}, 1.0}};
  const auto report = clay.apply(stroke);
  ASSERT_TRUE(report.ok());
  EXPECT_GT(report.value().dabs, 3);
  EXPECT_EQ(violations(clay.validate()), "");
  const std::uint64_t after = clay.hash();
  EXPECT_NE(after, start);
  ASSERT_TRUE(clay.undo());
  EXPECT_EQ(clay.hash(), start);
  ASSERT_TRUE(clay.redo());
  EXPECT_EQ(clay.hash(), after);
  EXPECT_FALSE(clay.redo());
}

INSTANTIATE_TEST_SUITE_P(Clay, EachAction, testing::ValuesIn(actions_on_levels()));

/// 1 000 sequences in 20 tests of 50, so that CTest can spread them; usually the first 2 of each.
/// What a seed means never changes.
class RandomEditsProperty : public testing::TestWithParam<int> {};

TEST_P(RandomEditsProperty, KeepEveryInvariantAndOneClosedSurfaceAfterEveryDab) {
  constexpr int kSequences = 50;
  SymmetryCount count;
  for (int n = 0; n < test::effort(2, kSequences); ++n) {
    const auto seed = static_cast<std::uint32_t>(GetParam() * kSequences + n);
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    Clay clay = random_start(random);
    Surface surface;
    const std::uint64_t start = clay.hash();
    ASSERT_EQ(violations(clay.validate()), "");
    const int strokes = 2 + static_cast<int>(random() % 4);
    for (int i = 0; i < strokes; ++i) {
      const Stroke stroke = random_dab(random, 10.0);
      SCOPED_TRACE("stroke " + std::to_string(i) + ": " + describe(stroke));
      const auto report = clay.apply(stroke);
      ASSERT_TRUE(report.ok());
      count.add(report.value());
      ASSERT_EQ(violations(clay.validate()), "");
      surface.update(clay);
      const TriangleMesh mesh = surface.weld();
      ASSERT_EQ(test::find_mesh_faults(mesh), test::MeshFaults{});
      const TriangleMesh fresh = extract_surface(clay);
      ASSERT_EQ(mesh.triangles, fresh.triangles);
      ASSERT_EQ(mesh.positions, fresh.positions);
      ASSERT_EQ(mesh.normals, fresh.normals);
    }
    if (n % 10 == 0) {  // the exact test is a hundred times slower than the edit
      ASSERT_EQ(test::find_soup_faults(surface.weld()), test::SoupFaults{});
    }
    while (clay.undo()) {
    }
    ASSERT_EQ(clay.hash(), start);
    surface.update(clay);
    ASSERT_EQ(surface.weld().positions, extract_surface(clay).positions);
  }
  count.print();
}

/// Tools far above and below the usual, and what a hand does besides: strokes while they are made,
/// given up, taken back, made again.
TEST(SurfaceOfEdits, FollowsLiveStrokesUndoAndRedoWithToolsOfAnySize) {
  constexpr double kRadii[] = {0.02, 0.15, 0.6, 2.5, 9.0, 30.0};
  std::mt19937 random(7);
  Clay clay = Clay::ball(9.0, ClayOptions{.voxel_mm = 0.3}).value();
  Surface surface;
  surface.update(clay);
  for (int step = 0; step < test::effort(25, 60); ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    Stroke stroke = random_dab(random, 10.0);
    const double radius = kRadii[random() % std::size(kRadii)];
    const bool is_large = radius > 5.0;
    stroke.tool.shape = Shape::ball;
    stroke.tool.radii_mm = {radius, radius, radius};
    stroke.tool.strength = is_large ? 0.05 : 0.5;
    if (is_large && stroke.tool.action == Action::carve) stroke.tool.action = Action::smooth;
    ASSERT_TRUE(clay.begin_stroke(stroke.tool, {.mirror = stroke.mirror}).ok());
    for (const StrokeSample& sample : stroke.samples) {
      ASSERT_TRUE(clay.extend_stroke({&sample, 1}).ok());
      surface.update(clay);
      ASSERT_EQ(surface.weld().positions, extract_surface(clay).positions);
    }
    const auto kind = random() % 4;
    if (kind == 0) {
      ASSERT_TRUE(clay.cancel_stroke());
    } else {
      ASSERT_TRUE(clay.end_stroke().ok());
    }
    if (kind == 1) clay.undo();
    surface.update(clay);
    if (kind == 1) clay.redo();
    surface.update(clay);
    const TriangleMesh mesh = surface.weld();
    const TriangleMesh fresh = extract_surface(clay);
    ASSERT_EQ(mesh.triangles, fresh.triangles);
    ASSERT_EQ(mesh.positions, fresh.positions);
    ASSERT_EQ(mesh.normals, fresh.normals);
  }
}

INSTANTIATE_TEST_SUITE_P(Clay, RandomEditsProperty, testing::Range(0, 20));

TEST(ClayUndo, TakesBackAStrokeThatIsInterrupted) {
  Clay clay = small_ball();
  const std::uint64_t start = clay.hash();
  Stroke stroke;
  stroke.tool = {Action::add, Shape::ball, {3, 3, 3}, 1.0};
  stroke.samples = {{0.0, {9, 0, 0}, {}, 1.0}, {1.0, {0, 9, 0}, {}, 1.0}};
  int calls = 0;
  const auto report = clay.apply(stroke, [&](std::string_view, double) { return ++calls < 4; });
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().kind, ErrorKind::interrupted);
  EXPECT_EQ(clay.hash(), start);
  EXPECT_EQ(clay.undo_depth(), 0);
}

TEST(ClayApply, RefusesABadStrokeByNameAndChangesNothing) {
  Clay clay = small_ball();
  const std::uint64_t start = clay.hash();
  const auto refused = [&](const Stroke& stroke) {
    const auto report = clay.apply(stroke);
    return report.ok() ? std::string("accepted") : report.error().message;
  };
  Stroke good;
  good.tool = {Action::carve, Shape::ball, {2, 2, 2}, 1.0};
  good.samples = {{0.0, {9, 0, 0}, {}, 1.0}};
  Stroke bad = good;
  bad.tool.radii_mm = {-2, -2, -2};
  EXPECT_NE(refused(bad).find("radius_mm is -2"), std::string::npos);
  bad = good;
  bad.tool.radii_mm = {1e6, 1e6, 1e6};
  EXPECT_NE(refused(bad).find("radius_mm is 1e+06"), std::string::npos);
  bad = good;
  bad.tool.strength = 0.0;
  EXPECT_NE(refused(bad).find("strength is 0"), std::string::npos);
  bad = good;
  bad.spacing = 0.0;
  EXPECT_NE(refused(bad).find("spacing is 0"), std::string::npos);
  bad = good;
  bad.samples.clear();
  EXPECT_NE(refused(bad).find("poses is empty"), std::string::npos);
  bad = good;
  bad.samples[0].position_mm.y = 1e9;
  EXPECT_NE(refused(bad).find("poses[0]"), std::string::npos);
  bad.samples[0].position_mm.y = std::nan("");
  EXPECT_NE(refused(bad).find("not finite"), std::string::npos);
  EXPECT_EQ(clay.hash(), start);
}

TEST(ClayGolden, HashesTheSameForAnyThreadCount) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    std::mt19937 random(7);
    Clay clay = random_start(random);
    for (int i = 0; i < 8; ++i) ASSERT_TRUE(clay.apply(random_dab(random, 10.0)).ok());
    hashes.push_back(clay.hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
  std::printf("hash %016llx\n", static_cast<unsigned long long>(hashes[0]));
}

TEST(ClayCarve, OfEverythingLeavesAnEmptyClayThatCanBeAddedTo) {
  Clay clay = small_ball();
  Stroke all;
  all.tool = {Action::carve, Shape::ball, {14, 14, 14}, 1.0};
  all.samples = {{}};
  ASSERT_TRUE(clay.apply(all).ok());
  EXPECT_EQ(violations(clay.validate()), "");
  EXPECT_TRUE(extract_surface(clay).triangles.empty());
  EXPECT_GT(clay.distance_at({0, 0, 0}), 0.0);
  all.tool = {Action::add, Shape::ball, {5, 5, 5}, 1.0};
  ASSERT_TRUE(clay.apply(all).ok());
  EXPECT_EQ(violations(clay.validate()), "");
  EXPECT_NEAR(signed_volume(extract_surface(clay)), 4.0 / 3.0 * 3.14159265 * 125.0, 8.0);
}

}  // namespace
}  // namespace argil
