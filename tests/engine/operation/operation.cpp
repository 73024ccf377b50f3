// SPDX-License-Identifier: GPL-3.0-or-later
// Operations on a whole clay against exact volumes, and what each must leave in order.
#include "argil/engine/operation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/clay.h"
#include "argil/engine/surface.h"

#include "clay/clay_access.h"
#include "field/level_stack.h"
#include "raycast/ray_scene.h"
#include "support/effort.h"
#include "support/measure/mesh_topology.h"
#include "support/measure/self_intersection.h"
#include "support/shapes.h"
#include "support/stroke_maker.h"

namespace argil::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string joined_lines(const std::vector<std::string>& lines) {
  std::string out;
  for (const auto& line : lines) out += line + "\n";
  return out;
}

/// Edges are sharp, as those of the solids that volumes are compared with.
ClayOptions sharp_options(double voxel) { return {voxel, ClayOptions{}.tolerance_voxels, 0.0}; }

Clay solid_ball(double radius, double voxel = 0.25) {
  return Clay::ball(radius, sharp_options(voxel)).value();
}

Clay block(const Vec3& size, double voxel = 0.25) {
  return Clay::block(size, sharp_options(voxel)).value();
}

std::shared_ptr<const Clay> shared(Clay clay) {
  return std::make_shared<const Clay>(std::move(clay));
}

Combine with_clay(CombineKind kind, Clay other, const Vec3& at = {}, const Quat& turn = {}) {
  Combine with;
  with.kind = kind;
  with.clay = shared(std::move(other));
  with.placement = {at, turn};
  return with;
}

Combine with_mesh(CombineKind kind, TriangleMesh mesh, const Vec3& at = {}) {
  Combine with;
  with.kind = kind;
  with.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  with.placement.position_mm = at;
  return with;
}

/// A ball with engraved and raised detail, down to the finest level, on its top and side.
Clay detailed_ball(double radius = 10.0) {
  Clay clay = solid_ball(radius);
  for (const auto action : {Action::carve, Action::add}) {
    Stroke stroke;
    stroke.tool.action = action;
    stroke.tool.radii_mm = {0.7, 0.7, 0.7};
    const double side = action == Action::add ? 1.0 : -1.0;
    for (int i = 0; i < 12; ++i) {
      const double x = side * 0.05 * radius * i;
      stroke.samples.push_back({0.1 * i, {x, 0.0, std::sqrt(radius * radius - x * x)}, {}, 1.0});
    }
    EXPECT_TRUE(clay.apply(stroke));
  }
  return clay;
}

void expect_same_surface(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.normals, b.normals);
}

double volume_of(const Clay& clay) { return signed_volume(extract_surface(clay)); }

/// What every operation must leave: invariants, a closed surface, the same surface by update as by
/// a whole extraction, undo and redo bit for bit.
void apply_and_check(Clay& clay, const Operation& operation) {
  Surface surface;
  surface.update(clay);
  const std::uint64_t before = clay.hash();
  const ClayOptions options = clay.options();
  const int depth = clay.undo_depth();
  const auto report = clay.apply(operation);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(clay.undo_depth(), depth + 1);
  EXPECT_EQ(joined_lines(clay.validate()), "");
  surface.update(clay);
  const TriangleMesh updated = surface.weld();
  expect_same_surface(updated, extract_surface(clay));
  EXPECT_EQ(find_mesh_faults(updated), MeshFaults{});
  const std::uint64_t after = clay.hash();
  ASSERT_TRUE(clay.undo());
  EXPECT_EQ(clay.hash(), before);
  EXPECT_EQ(clay.options().voxel_mm, options.voxel_mm);
  surface.update(clay);
  expect_same_surface(surface.weld(), extract_surface(clay));
  ASSERT_TRUE(clay.redo());
  EXPECT_EQ(clay.hash(), after);
  surface.update(clay);
  expect_same_surface(surface.weld(), updated);
}

void expect_volume(const Clay& clay, double exact, double share = 0.005) {
  const double volume = volume_of(clay);
  EXPECT_NEAR(volume, exact, share * exact) << "off by " << 100.0 * (volume / exact - 1.0) << " %";
}

// The part of a ball beyond a plane at distance d from its centre.
double cap_volume(double radius, double d) {
  const double h = radius - d;
  return kPi * h * h * (3.0 * radius - h) / 3.0;
}
double ball_volume(double radius) { return 4.0 / 3.0 * kPi * radius * radius * radius; }

TEST(OperationVolume, CutBallIsTheBallLessItsCap) {
  // Usually each distance has one of the two normals, by turns.
  const std::vector<Vec3> normals{{0, 0, 1}, {1, -2, 3}};
  std::size_t turn = 0;
  for (const double d : {0.0, 3.1, -4.7, 9.0}) {
    for (const Vec3& normal : effort<std::vector<Vec3>>({normals[turn++ % 2]}, normals)) {
      Clay clay = solid_ball(10.0);
      apply_and_check(clay, Cut{normalized(normal) * d, normal, false});
      expect_volume(clay, ball_volume(10.0) - cap_volume(10.0, d));
    }
  }
}

TEST(OperationVolume, CutBallWithRoundEdgesIsNearlyIt) {
  Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = 0.25}).value();
  apply_and_check(clay, Cut{{0, 0, 3.1}, {0, 0, 1}, false});
  expect_volume(clay, ball_volume(10.0) - cap_volume(10.0, 3.1));
}

TEST(OperationVolume, BothSidesOfACutMakeTheWhole) {
  Clay front = detailed_ball();
  Clay back = detailed_ball();
  const double whole = volume_of(front);
  apply_and_check(front, Cut{{0.3, 0.0, 0.0}, {1, 0.2, 0.1}, true});
  apply_and_check(back, Cut{{0.3, 0.0, 0.0}, {1, 0.2, 0.1}, false});
  EXPECT_NEAR(volume_of(front) + volume_of(back), whole, 1e-3 * whole);
}

TEST(OperationVolume, LensOfTwoBallsIsTwoCaps) {
  Clay clay = solid_ball(10.0);
  apply_and_check(clay, with_clay(CombineKind::intersect, solid_ball(10.0), {7.0, 2.0, 1.0}));
  const double d = length(Vec3{7.0, 2.0, 1.0});
  expect_volume(clay, 2.0 * cap_volume(10.0, 0.5 * d));
}

TEST(OperationVolume, UnionOfTwoBallsIsBothLessTheLens) {
  Clay clay = solid_ball(10.0);
  apply_and_check(clay, with_clay(CombineKind::unite, solid_ball(6.0), {9.0, 3.0, 0.0}));
  const double d = std::sqrt(90.0);
  const double x = (d * d + 100.0 - 36.0) / (2.0 * d);
  const double lens = cap_volume(10.0, x) + cap_volume(6.0, d - x);
  expect_volume(clay, ball_volume(10.0) + ball_volume(6.0) - lens);
}

TEST(OperationVolume, BlockLessABallWithinIsTheDifference) {
  Clay clay = block({20, 20, 20});
  apply_and_check(clay, with_clay(CombineKind::subtract, solid_ball(7.0)));
  expect_volume(clay, 8000.0 - ball_volume(7.0));
}

TEST(OperationVolume, BlockLessABallAtItsCornerIsAnEighthLess) {
  Clay clay = block({20, 20, 20});
  apply_and_check(clay, with_clay(CombineKind::subtract, solid_ball(7.0), {10, 10, 10}));
  expect_volume(clay, 8000.0 - ball_volume(7.0) / 8.0);
}

TEST(OperationVolume, MeshesCombineAsTheSolidsTheyBound) {
  Clay clay = solid_ball(10.0);
  apply_and_check(clay, with_mesh(CombineKind::intersect, box_mesh({30, 30, 8}), {0, 0, 0.03}));
  expect_volume(clay, ball_volume(10.0) - cap_volume(10.0, 4.03) - cap_volume(10.0, 3.97));
  Clay other = solid_ball(10.0);
  apply_and_check(other, with_mesh(CombineKind::subtract, box_mesh({6, 30, 6})));
  const double before = volume_of(other);
  apply_and_check(other, with_mesh(CombineKind::unite, box_mesh({5.5, 30.1, 5.5})));
  const double bar = 5.5 * 5.5 * 30.1;
  EXPECT_NEAR(volume_of(other) - before, bar, 0.01 * bar);
}

TEST(OperationVolume, TurnedBlockKeepsItsVolume) {
  Clay clay = solid_ball(3.0);
  apply_and_check(clay, with_clay(CombineKind::unite, block({12, 12, 12}, 0.2), {0.1, 0.2, 0.3},
                                  {0.9, 0.2, -0.3, 0.1}));
  expect_volume(clay, 1728.0, 0.01);
  Clay only = solid_ball(3.0);
  apply_and_check(
      only, with_clay(CombineKind::intersect, block({12, 12, 12}, 0.2), {}, {0.9, 0.2, -0.3, 0.1}));
  EXPECT_NEAR(volume_of(only), volume_of(solid_ball(3.0)), 1e-6);
}

TEST(OperationVolume, OffsetBallHasTheOtherRadius) {
  // Within the band and beyond it.
  for (const double distance : effort<std::vector<double>>({0.4, -2.0}, {0.4, 2.0, -0.4, -2.0})) {
    Clay clay = solid_ball(10.0, effort(0.25, 0.125));
    apply_and_check(clay, Offset{distance});
    expect_volume(clay, ball_volume(10.0 + distance));
  }
}

TEST(OperationVolume, OffsetBlockIsTheMinkowskiSumWithABall) {
  // The surface that is moved has its edges cut off by a voxel: a fine one. Inward they are not
  // missed.
  const Vec3 size = effort(Vec3{24, 20, 16}, Vec3{32, 24, 20});
  Clay clay = block(size, effort(0.16, 0.125));
  apply_and_check(clay, Offset{2.0});
  const double faces = 2.0 * 2.0 * (size.x * size.y + size.y * size.z + size.x * size.z);
  const double edges = kPi * 4.0 * (size.x + size.y + size.z);
  expect_volume(clay, size.x * size.y * size.z + faces + edges + ball_volume(2.0));
  Clay inner = block(size, effort(0.32, 0.125));
  apply_and_check(inner, Offset{-2.0});
  expect_volume(inner, (size.x - 4.0) * (size.y - 4.0) * (size.z - 4.0));
}

/// Two faces that meet in an edge along y at x = 0, at 10 degrees to the plane z = 0 each, from
/// there to x = 20.
constexpr double kHalfAngle = 10.0 * kPi / 180.0;

Clay wedge() {
  Clay clay = block({40.0, 6.0, 8.0});
  for (const double side : {1.0, -1.0}) {
    const Vec3 outward{-std::sin(kHalfAngle), 0.0, side * std::cos(kHalfAngle)};
    EXPECT_TRUE(clay.apply(Cut{{}, outward}));
  }
  return clay;
}

TEST(OperationOffset, IsADistanceBeyondTheEndsOfWhatItShrank) {
  // There the faces of the wedge are hardly nearer than at the edge: what they say is no distance.
  Clay clay = wedge();
  apply_and_check(clay, Offset{-1.0});
  const double edge = 1.0 / std::sin(kHalfAngle);
  for (double y = -1.0; y <= 1.0; y += 0.31) {
    for (double far = 0.3; far < 0.9; far += 0.07) {
      const double found = clay.distance_at({edge - far, y, 0.0});
      EXPECT_GT(found, 0.7 * far - 0.05) << far << " mm before the edge, at " << y;
      EXPECT_LT(found, 1.3 * far + 0.2) << far << " mm before the edge, at " << y;
    }
  }
}

TEST(OperationOffset, OutwardAgainRoundsWhatItShrank) {
  const double back = 0.9;
  Clay clay = wedge();
  apply_and_check(clay, Offset{-1.0});
  apply_and_check(clay, Offset{back});
  const double edge = 1.0 / std::sin(kHalfAngle);
  int count = 0;
  for (const Vec3& p : extract_surface(clay).positions) {
    if (std::abs(p.y) > 1.0 || p.x > edge + 5.0) continue;
    // The way to the smaller wedge: to its edge, or to the nearer face.
    const double across = std::abs(p.z);
    const double along = (p.x - edge) * std::cos(kHalfAngle) + across * std::sin(kHalfAngle);
    const double way = along < 0.0
                           ? std::hypot(p.x - edge, across)
                           : across * std::cos(kHalfAngle) - (p.x - edge) * std::sin(kHalfAngle);
    EXPECT_NEAR(way, back, 0.2) << p.x << ", " << p.y << ", " << p.z;
    ++count;
  }
  EXPECT_GT(count, 250);
}

TEST(OperationVolume, ResampledBallKeepsItsVolume) {
  for (const double voxel :
       effort<std::vector<double>>({0.25, 0.1, 0.155}, {0.0625, 0.25, 0.1, 0.155})) {
    const double radius = effort(7.0, 10.0);
    Clay clay = solid_ball(radius, 0.125);
    apply_and_check(clay, Resample{voxel});
    EXPECT_EQ(clay.options().voxel_mm, voxel);
    expect_volume(clay, ball_volume(radius));
  }
}

std::uint64_t leaf_count(const Clay& clay) {
  std::uint64_t count = 0;
  for (const auto& level : clay.level_stats()) count += static_cast<std::uint64_t>(level.leaves);
  return count;
}

TEST(OperationResample, ByAPowerOfTwoKeepsTheBitsOfTheLevelsThatStay) {
  const Clay before = detailed_ball();
  Clay finer = detailed_ball();
  apply_and_check(finer, Resample{0.0625});
  ASSERT_EQ(finer.level_count(), before.level_count() + 2);
  EXPECT_EQ(leaf_count(finer), leaf_count(before));
  expect_same_surface(extract_surface(finer), extract_surface(finer));
  EXPECT_DOUBLE_EQ(volume_of(finer), volume_of(before));
  Clay coarser = detailed_ball();
  apply_and_check(coarser, Resample{0.5});
  ASSERT_EQ(coarser.level_count(), before.level_count() - 1);
  const double tolerance = coarser.options().tolerance_voxels * 0.5;
  EXPECT_NEAR(volume_of(coarser), volume_of(before),
              tolerance * surface_area(extract_surface(before)));
}

TEST(OperationResample, ToLessThanHalfTheVoxelKeepsTheSolid) {
  for (const double ratio : {0.4, 0.52}) {
    Clay clay = solid_ball(5.0);
    const double volume = volume_of(clay);
    apply_and_check(clay, Resample{0.25 * ratio});
    expect_volume(clay, volume, 0.002);
  }
}

TEST(OperationCombine, TakesASolidWithFarCoarserVoxels) {
  Clay clay = solid_ball(6.0);
  apply_and_check(clay, with_clay(CombineKind::unite, solid_ball(10.0, 1.0), {14.0, 0.0, 0.0}));
  const double to_circle = (14.0 * 14.0 + 6.0 * 6.0 - 10.0 * 10.0) / (2.0 * 14.0);
  const double lens = cap_volume(6.0, to_circle) + cap_volume(10.0, 14.0 - to_circle);
  expect_volume(clay, ball_volume(6.0) + ball_volume(10.0) - lens, 0.01);
}

TEST(OperationCombine, PutsAFineStampOnALargeClay) {
  // The clay has levels so coarse that the stamp lies between their nodes.
  Clay clay = solid_ball(60.0);
  const double volume = volume_of(clay);
  apply_and_check(clay, with_clay(CombineKind::unite, solid_ball(2.0), {60.13, 0.07, 0.11}));
  const double half = 0.5 * ball_volume(2.0);
  EXPECT_NEAR(volume_of(clay) - volume, half, 0.15 * half);
}

TEST(OperationResample, ToAnyVoxelKeepsDetailWithinHalfOfIt) {
  const double radius = effort(6.0, 10.0);
  const Clay before = detailed_ball(radius);
  Clay clay = detailed_ball(radius);
  apply_and_check(clay, Resample{0.2});
  double most = 0.0;
  for (const Vec3& p : extract_surface(before).positions) {
    most = std::max(most, std::abs(clay.distance_at(p)));
  }
  EXPECT_LT(most, 0.5 * 0.25);
}

/// From points of the outer surface inward along the normal, to the cavity.
struct Walls {
  double thinnest = kInfinity;
  double thickest = 0.0;
  int rays = 0;
};

Walls walls_of(const TriangleMesh& hollow, const std::function<bool(const Vec3&)>& is_outer) {
  const RayScene scene = RayScene::build(hollow).value();
  Walls walls;
  for (std::size_t v = 0; v < hollow.positions.size(); v += 7) {
    const Vec3& p = hollow.positions[v];
    if (!is_outer(p)) continue;
    const Vec3 inward = -hollow.normals[v];
    const auto hit = scene.closest(p + 1e-3 * inward, inward);
    if (!hit) continue;
    walls.thinnest = std::min(walls.thinnest, hit->distance);
    walls.thickest = std::max(walls.thickest, hit->distance);
    ++walls.rays;
  }
  return walls;
}

TEST(OperationHollow, WallIsAsThickAsAsked) {
  for (const double wall : effort<std::vector<double>>({1.0}, {1.0, 2.3})) {
    Clay clay = solid_ball(10.0);
    apply_and_check(clay, Hollow{wall, {}});
    const Walls walls =
        walls_of(extract_surface(clay), [](const Vec3& p) { return length(p) > 9.5; });
    EXPECT_GT(walls.rays, 100);
    EXPECT_NEAR(walls.thinnest, wall, 0.25);
    EXPECT_NEAR(walls.thickest, wall, 0.25);
    expect_volume(clay, ball_volume(10.0) - ball_volume(10.0 - wall));
  }
}

TEST(OperationHollow, BlockHasFlatWallsOfThatThickness) {
  Clay clay = block({20, 16, 12});
  const double volume = volume_of(clay);  // its edges are cut off by a voxel
  apply_and_check(clay, Hollow{2.0, {}});
  const auto is_face = [](const Vec3& p) {
    // Clear of the edges, where the ray along a rounded normal means nothing.
    return std::abs(p.z) > 5.9 && std::abs(p.x) < 7.0 && std::abs(p.y) < 5.0;
  };
  const Walls walls = walls_of(extract_surface(clay), is_face);
  EXPECT_GT(walls.rays, 10);
  EXPECT_NEAR(walls.thinnest, 2.0, 0.25);
  EXPECT_NEAR(walls.thickest, 2.0, 0.25);
  expect_volume(clay, volume - 16.0 * 12.0 * 8.0, 0.002);
}

TEST(OperationHollow, EndsWhereTheCavityWouldBeAFilm) {
  // Between faces at 10 degrees the cavity tapers to nothing; it ends two voxels thick.
  Clay clay = wedge();
  apply_and_check(clay, Hollow{1.0, {}});
  double first = kInfinity;  // along x
  double ends = 0.0;
  for (double x = 1.0; x < 15.0; x += 0.01) {
    if (clay.distance_at({x, 0.0, 0.0}) > 0.0) {
      first = std::min(first, x);
      ends = x;
    }
  }
  const double room = 0.25 / std::sin(kHalfAngle);
  const double edge = 1.0 / std::sin(kHalfAngle);
  EXPECT_GT(first, edge + room - 0.25 - 0.3);
  EXPECT_LT(first, edge + room + 0.5);
  EXPECT_GT(ends, 14.9);
  const TriangleMesh mesh = extract_surface(clay);
  const RayScene scene = RayScene::build(mesh).value();
  // From the cavity's middle plane up and down, the cavity is never narrower than nearly that.
  for (double x = first + 0.25; x < 14.0; x += 0.05) {
    const auto up = scene.closest({x, 0.0, 0.0}, {0.0, 0.0, 1.0});
    ASSERT_TRUE(up.has_value()) << x;
    EXPECT_GT(up->distance, 0.75 * 0.25) << x;
  }
}

TEST(OperationHollow, LeavesTheOuterSurfaceWhereItWas) {
  const double radius = effort(6.0, 10.0);
  const Clay before = detailed_ball(radius);
  Clay clay = detailed_ball(radius);
  apply_and_check(clay, Hollow{2.0, {}});
  std::vector<double> off_voxels;
  for (const Vec3& p : extract_surface(clay).positions) {
    if (length(p) > radius - 1.0) off_voxels.push_back(std::abs(before.distance_at(p)) / 0.25);
  }
  for (const Vec3& p : extract_surface(before).positions) {
    off_voxels.push_back(std::abs(clay.distance_at(p)) / 0.25);
  }
  // At the sharp rims of the detail a few vertices see finer leaves come beside them.
  EXPECT_LT(*std::ranges::max_element(off_voxels), 0.2);
  const auto beyond = std::ranges::count_if(off_voxels, [](double off) { return off > 0.1; });
  EXPECT_LT(static_cast<double>(beyond), 1e-3 * static_cast<double>(off_voxels.size()));
}

TEST(OperationHollow, DrainsOpenTheCavity) {
  Clay clay = solid_ball(10.0);
  const Drain drain{{0, 0, -10.0}, {0, 0, 1}, 1.5};
  const Drain slanted{{9.0, 0, 6.0}, {-1, 0.1, -0.2}, 1.0};
  apply_and_check(clay, Hollow{2.0, {drain, slanted}});
  for (double z = -11.0; z < 0.0; z += 0.1) EXPECT_GT(clay.distance_at({0, 0, z}), 0.0);
  // One surface from outside to inside: V - E + F of a ball with a through hole is 0.
  const TriangleMesh mesh = extract_surface(clay);
  const auto v = static_cast<std::int64_t>(mesh.positions.size());
  const auto f = static_cast<std::int64_t>(mesh.triangles.size());
  EXPECT_EQ(v - f / 2, 2 - 2 * 1);
  const double hole = kPi * 1.5 * 1.5 * 2.0 + kPi * 1.0 * 1.0 * 2.0;
  expect_volume(clay, ball_volume(10.0) - ball_volume(8.0) - hole, 0.01);
}

/// The leaves of a level that lie wholly on one side of x = `x_mm`, by their bits.
std::vector<std::pair<Coord, std::vector<float>>> leaves_left_of(const Clay& clay, int level,
                                                                 double x_mm) {
  std::vector<std::pair<Coord, std::vector<float>>> found;
  const double h = levels_of(clay).voxel_mm(level);
  for (const Coord& place : levels_of(clay).sorted_origins(level)) {
    if ((place.x() + kLeafSide) * h > x_mm) continue;
    const float* values = levels_of(clay).leaf(level, place)->buffer().data();
    found.emplace_back(place, std::vector<float>(values, values + kLeafNodes));
  }
  return found;
}

TEST(OperationDetail, FarFromACutOrCombinationKeepsItsBits) {
  const Clay before = detailed_ball();
  Clay cut = detailed_ball();
  apply_and_check(cut, Cut{{6.0, 0, 0}, {1, 0, 0}, false});
  Clay united = detailed_ball();
  apply_and_check(united, with_clay(CombineKind::unite, solid_ball(3.0), {10.0, 0, 0}));
  for (int level = 0; level < 3; ++level) {
    const double clear = -2.0;
    const auto kept = leaves_left_of(before, level, clear);
    EXPECT_EQ(leaves_left_of(cut, level, clear), kept) << "level " << level;
    EXPECT_EQ(leaves_left_of(united, level, clear), kept) << "level " << level;
  }
}

TEST(OperationDetail, OfTheOtherClayIsTakenOver) {
  Clay clay = solid_ball(4.0);
  const double whole = volume_of(detailed_ball());
  apply_and_check(clay, with_clay(CombineKind::unite, detailed_ball()));
  EXPECT_NEAR(volume_of(clay), whole, 5e-4 * whole);
}

TEST(OperationCoincident, ClayWithItselfIsItself) {
  Clay clay = detailed_ball();
  const std::uint64_t before = clay.hash();
  ASSERT_TRUE(clay.apply(with_clay(CombineKind::unite, detailed_ball())));
  EXPECT_EQ(clay.hash(), before);
  ASSERT_TRUE(clay.apply(with_clay(CombineKind::intersect, detailed_ball())));
  EXPECT_EQ(clay.hash(), before);
  const auto gone = clay.apply(with_clay(CombineKind::subtract, detailed_ball()));
  ASSERT_FALSE(gone);
  EXPECT_NE(gone.error().message.find("nothing would be left"), std::string::npos);
  EXPECT_EQ(clay.hash(), before);
}

TEST(OperationCoincident, TouchingBlocksBecomeOneWithoutASlit) {
  // On the lattice, off it, and turned with the clay's own plane.
  for (const double edge : {4.0, 4.11}) {
    Clay clay = block({2.0 * edge, 10, 10});
    apply_and_check(clay, with_mesh(CombineKind::unite, box_mesh({6, 10, 10}), {edge + 3.0, 0, 0}));
    // A block of the voxels' own has the same edges cut off.
    const double whole = volume_of(block({2.0 * edge + 6.0, 10, 10}));
    EXPECT_NEAR(volume_of(clay), whole, 0.002 * whole);
    const auto mesh = extract_surface(clay);
    for (const Vec3& p : mesh.positions) {
      EXPECT_FALSE(std::abs(p.x - edge) < 0.3 && std::abs(p.y) < 4.5 && std::abs(p.z) < 4.5)
          << p.x << " " << p.y << " " << p.z;
    }
  }
}

TEST(OperationCoincident, DifferenceWithASharedFaceLeavesNoSheet) {
  for (const double edge : {4.0, 4.11}) {
    Clay clay = block({2.0 * edge, 10, 10});
    apply_and_check(clay,
                    with_mesh(CombineKind::subtract, box_mesh({edge, 12, 12}), {0.5 * edge, 0, 0}));
    const double half = volume_of(block({edge, 10, 10}));
    EXPECT_NEAR(volume_of(clay), half, 0.005 * half);
    for (const Vec3& p : extract_surface(clay).positions) EXPECT_LT(p.x, 0.5);
  }
}

TEST(OperationCoincident, TouchingBallsStayWhole) {
  Clay clay = solid_ball(5.0);
  apply_and_check(clay, with_clay(CombineKind::unite, solid_ball(5.0), {10.0, 0, 0}));
  const double one = volume_of(solid_ball(5.0));
  EXPECT_NEAR(volume_of(clay), 2.0 * one, 0.005 * one);
  Clay cut = solid_ball(5.0);
  apply_and_check(cut, with_clay(CombineKind::subtract, solid_ball(5.0), {10.0, 0, 0}));
  EXPECT_NEAR(volume_of(cut), one, 0.001 * one);
}

struct Refusal {
  Operation operation;
  const char* names;
};

TEST(OperationFailure, LeavesTheHashAsItWas) {
  const double radius = effort(5.0, 10.0);
  const Vec3 bottom{0, 0, -radius};
  Clay clay = solid_ball(radius);
  const std::uint64_t before = clay.hash();
  const auto a_clay = shared(solid_ball(3.0));
  const std::vector<Refusal> refusals{
      {Offset{0.0}, "distance_mm is 0"},
      {Offset{1e-4}, "a twentieth"},
      {Offset{kNaN}, "distance_mm is nan"},
      {Offset{1e6}, "longest side"},
      {Offset{-radius - 0.5}, "nothing would be left"},
      {Hollow{0.1, {}}, "wall_mm is 0.1"},
      {Hollow{kInfinity, {}}, "wall_mm is inf"},
      {Hollow{radius, {}}, "choose a thinner wall"},
      {Hollow{2.0, {{bottom, {0, 0, 1}, 0.1}}}, "drains[0]: radius_mm is 0.1"},
      {Hollow{2.0, {{bottom, {0, 0, 0}, 1.0}}}, "drains[0]"},
      {Hollow{2.0, {{bottom, {0, 0, 1}, 1}, {bottom, {0, 0, -1}, 1}}}, "drains[1]: the line"},
      {Hollow{2.0, {{{0, 0, 0}, {0, 0, 1}, 1.0}}}, "lies deep in the clay"},
      {Hollow{2.0, {{{0, 9e15, 0}, {0, 1, 0}, 1.0}}}, "drains[0]: point_mm is (0, 9e+15, 0)"},
      {Hollow{2.0, {{{0, 0, 1e6}, {0, 0, 1}, 1.0}}}, "meets no cavity"},
      {Cut{{0, 0, 0}, {0, 0, 0}, false}, "normal is (0, 0, 0)"},
      {Cut{{kNaN, 0, 0}, {0, 0, 1}, false}, "point_mm"},
      {Cut{{0, 2e6, 0}, {0, 0, 1}, false}, "no coordinate may be beyond"},
      {Cut{{0, 0, -20}, {0, 0, 1}, false}, "nothing would be left"},
      {Combine{}, "give one of them"},
      {Combine{CombineKind::unite, a_clay, nullptr, {{kNaN, 0, 0}, {}}}, "position_mm"},
      {Combine{CombineKind::unite, a_clay, nullptr, {{0, 0, -1e7}, {}}}, "position_mm"},
      {Combine{CombineKind::unite, a_clay, nullptr, {{}, {0, 0, 0, 0}}}, "orientation"},
      {Combine{CombineKind::unite, a_clay, nullptr, {{1e5, 0, 0}, {}}}, "move the other nearer"},
      {Combine{CombineKind::intersect, a_clay, nullptr, {{50, 0, 0}, {}}}, "do not overlap"},
      {with_mesh(CombineKind::unite, {}), "triangle"},
      {Resample{0.25}, "has already"},
      {Resample{-1.0}, "voxel_mm is -1"},
      {Resample{100.0}, "voxel_mm is 100"},
      {Resample{1e-9}, "voxel_mm is 1e-09"},
      {Resample{5e-5}, "voxel_mm is 5e-05; for this clay it must be from 0.0001 to"},
  };
  for (const Refusal& refusal : refusals) {
    const auto report = clay.apply(refusal.operation);
    ASSERT_FALSE(report) << refusal.names;
    EXPECT_EQ(report.error().kind, ErrorKind::bad_input);
    EXPECT_NE(report.error().message.find(refusal.names), std::string::npos)
        << report.error().message;
    EXPECT_EQ(clay.hash(), before) << refusal.names;
    EXPECT_EQ(clay.undo_depth(), 0);
  }
}

/// The way to the clay costs nothing: drains are looked for where the cavity is.
TEST(OperationHollow, FindsTheCavityFromAKilometreAway) {
  Clay near = solid_ball(5.0);
  Clay far = solid_ball(5.0);
  ASSERT_TRUE(near.apply(Hollow{2.0, {{{0, 0, -5}, {0, 0, 1}, 1.0}}}));
  ASSERT_TRUE(far.apply(Hollow{2.0, {{{0, 0, -kMaxReachMm}, {0, 0, 1}, 1.0}}}));
  EXPECT_NEAR(volume_of(far), volume_of(near), 1e-3 * volume_of(near));
}

TEST(OperationFailure, RefusesWhileAStrokeIsOpen) {
  Clay clay = solid_ball(effort(5.0, 10.0));
  ASSERT_TRUE(clay.begin_stroke(Tool{}));
  EXPECT_FALSE(clay.apply(Offset{0.4}));
  EXPECT_TRUE(clay.cancel_stroke());
  EXPECT_TRUE(clay.apply(Offset{0.4}));
}

/// Of the detailed ball of this radius.
std::vector<Operation> one_of_each(double radius) {
  const double unit = 0.1 * radius;
  const Vec3 beside = unit * Vec3{9.0, 1.0, 0.0};
  return {Offset{0.6},
          Offset{-0.6},
          Hollow{1.5, {{{0, 0, -radius}, {0, 0, 1}, 1.2}}},
          Cut{{1.0, 0, 0}, {1, 1, 0.3}, false},
          with_clay(CombineKind::unite, solid_ball(4.0 * unit), beside),
          with_clay(CombineKind::subtract, solid_ball(4.0 * unit), beside),
          with_mesh(CombineKind::intersect, box_mesh(unit * Vec3{12, 30, 12})),
          Resample{0.5},
          Resample{0.3}};
}

/// Interrupts one of each where its progress is first told, and at `stops` parts of its calls.
void expect_nothing_left_by_interruption(double radius, int stops) {
  Clay clay = detailed_ball(radius);
  const std::uint64_t before = clay.hash();
  const int depth = clay.undo_depth();
  for (const Operation& operation : one_of_each(radius)) {
    int calls = 0;
    ASSERT_TRUE(clay.apply(operation, [&](std::string_view, double) { return ++calls > 0; }));
    ASSERT_TRUE(clay.undo());
    ASSERT_GT(calls, 0);
    const int step = std::max(1, calls / stops);
    for (int stop = 1; stop <= calls; stop += step) {
      int call = 0;
      const auto report =
          clay.apply(operation, [&](std::string_view, double) { return ++call < stop; });
      ASSERT_FALSE(report) << operation.index() << " at " << stop;
      EXPECT_EQ(report.error().kind, ErrorKind::interrupted);
      EXPECT_EQ(clay.hash(), before);
      EXPECT_EQ(clay.undo_depth(), depth);
    }
  }
}

TEST(OperationInterruption, HalfwayLeavesNothingBehind) {
  expect_nothing_left_by_interruption(5.0, 2);
}

TEST(OperationInterruptionSlow, AnywhereLeavesNothingBehind) {
  expect_nothing_left_by_interruption(10.0, 6);
}

TEST(OperationDeterminism, SameHashForAnyThreads) {
  const double radius = effort(5.0, 10.0);
  Clay clay = detailed_ball(radius);
  for (const Operation& operation : one_of_each(radius)) {
    std::optional<std::uint64_t> first;
    for (const std::size_t threads : {std::size_t{1}, std::size_t{2}, std::size_t{7}}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      ASSERT_TRUE(clay.apply(operation));
      if (!first) first = clay.hash();
      EXPECT_EQ(clay.hash(), *first) << "operation " << operation.index() << ", " << threads;
      ASSERT_TRUE(clay.undo());
    }
  }
}

TEST(OperationProperty, EachLeavesDetailedClayInOrder) {
  const double radius = effort(5.0, 10.0);
  for (const Operation& operation : one_of_each(radius)) {
    SCOPED_TRACE(operation.index());
    Clay clay = detailed_ball(radius);
    apply_and_check(clay, operation);
    EXPECT_EQ(find_soup_faults(extract_surface(clay)), SoupFaults{});
  }
}

Operation random_operation(std::mt19937& random, const Clay& clay) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const double voxel = clay.options().voxel_mm;
  const Vec3 size = clay.bounds_mm().size();
  const Vec3 at{0.4 * size.x * unit(random), 0.4 * size.y * unit(random),
                0.4 * size.z * unit(random)};
  const Vec3 axis{unit(random), unit(random), unit(random)};
  switch (random() % 5) {
    case 0:
      return Offset{3.0 * voxel * unit(random)};
    case 1:
      return Hollow{3.2 * voxel, {}};
    case 2:
      return Cut{at, axis, random() % 2 == 0};
    case 3:
      return with_clay(
          static_cast<CombineKind>(random() % 3),
          solid_ball(std::max(0.3 * size.x, 9.0 * voxel), voxel * (random() % 2 == 0 ? 1.0 : 0.8)),
          at, {1.0, axis.x, axis.y, axis.z});
    default:
      return Resample{voxel * (random() % 2 == 0 ? 2.0 : 1.3)};
  }
}

TEST(OperationProperty, RandomOnesAmongStrokesKeepTheInvariantsAndUndo) {
  for (unsigned seed = 1; seed <= effort(3U, 12U); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    Clay clay = random_start(random);
    std::vector<std::uint64_t> hashes{clay.hash()};
    for (int step = 0; step < 4; ++step) {
      if (clay.apply(random_dab(random, 0.6 * clay.bounds_mm().size().x))) {
        hashes.push_back(clay.hash());
      }
      const Operation operation = random_operation(random, clay);
      SCOPED_TRACE(operation.index());
      const auto report = clay.apply(operation);
      if (report) hashes.push_back(clay.hash());
      EXPECT_EQ(clay.hash(), hashes.back());
      EXPECT_EQ(joined_lines(clay.validate()), "");
      EXPECT_EQ(find_mesh_faults(extract_surface(clay)), MeshFaults{});
    }
    for (std::size_t i = hashes.size() - 1; i-- > 0;) {
      ASSERT_TRUE(clay.undo());
      EXPECT_EQ(clay.hash(), hashes[i]);
    }
  }
}

TEST(OperationProperty, OperationsAndStrokesUndoInTurn) {
  Clay clay = detailed_ball();
  std::vector<std::uint64_t> hashes{clay.hash()};
  for (const Operation& operation :
       std::vector<Operation>{Cut{{0, 0, -3}, {0, 0, -1}, false}, Resample{0.5}, Offset{0.8}}) {
    ASSERT_TRUE(clay.apply(operation));
    hashes.push_back(clay.hash());
    Stroke stroke;
    stroke.tool.radii_mm = {2, 2, 2};
    stroke.samples.push_back({0.0, {0, 9.5, 0}, {}, 1.0});
    ASSERT_TRUE(clay.apply(stroke));
    hashes.push_back(clay.hash());
    EXPECT_EQ(joined_lines(clay.validate()), "");
  }
  for (std::size_t i = hashes.size() - 1; i-- > 0;) {
    ASSERT_TRUE(clay.undo());
    EXPECT_EQ(clay.hash(), hashes[i]);
  }
  for (std::size_t i = 1; i < hashes.size(); ++i) {
    ASSERT_TRUE(clay.redo());
    EXPECT_EQ(clay.hash(), hashes[i]);
  }
}

}  // namespace
}  // namespace argil::test
