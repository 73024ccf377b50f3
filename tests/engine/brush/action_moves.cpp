// SPDX-License-Identifier: GPL-3.0-or-later
// elastic, snake_hook and slide: what moves matter.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/pick.h"
#include "argil/engine/surface.h"

#include "support/measure/mesh_topology.h"
#include "support/stroke_maker.h"

namespace argil {
namespace {

using testing::IsEmpty;

constexpr double kMovedVoxel = 0.2;
constexpr double kMovedBall = 10.0;

Clay moved_ball() { return Clay::ball(kMovedBall, ClayOptions{.voxel_mm = kMovedVoxel}).value(); }

double moved_volume(const Clay& clay) {
  const TriangleMesh mesh = extract_surface(clay);
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    sum += dot(mesh.positions[t[0]], cross(mesh.positions[t[1]], mesh.positions[t[2]])) / 6.0;
  }
  return sum;
}

/// Where a ray along -x first meets the clay.
double front_at(const Clay& clay, double y, double z) {
  const auto hit = pick(clay, Ray{{100.0, y, z}, {-1.0, 0.0, 0.0}});
  return hit.ok() && hit.value() ? hit.value()->point_mm.x : std::nan("");
}

// ---- elastic -----------------------------------------------------------------------------------

Stroke elastic_pull(const Vec3& from, const Vec3& to, double keeps) {
  Stroke pull = stroke_of(Action::elastic, 3.0, 1.0, {from, to});
  pull.tool.volume_preservation = keeps;
  return pull;
}

TEST(ActionElastic, KeepsItsVolumeAsFarAsItIsTold) {
  const double start = moved_volume(moved_ball());
  for (const Vec3& to : {Vec3{14, 0, 0}, Vec3{7, 0, 0}, Vec3{10, 4, 0}}) {
    Clay keeping = moved_ball();
    ASSERT_TRUE(keeping.apply(elastic_pull({10, 0, 0}, to, 1.0)).ok());
    const double kept = moved_volume(keeping) - start;
    Clay giving = moved_ball();
    ASSERT_TRUE(giving.apply(elastic_pull({10, 0, 0}, to, 0.0)).ok());
    const double given = moved_volume(giving) - start;
    Clay grabbed = moved_ball();
    ASSERT_TRUE(grabbed.apply(stroke_of(Action::grab, 6.0, 1.0, {{10, 0, 0}, to})).ok());
    const double by_grab = moved_volume(grabbed) - start;
    std::printf("volume: kept %+.2f, given %+.2f, grab %+.2f mm3 of %.0f\n", kept, given, by_grab,
                start);
    EXPECT_LT(std::abs(kept), 0.001 * start);
    if (to.y == 0.0) {
      EXPECT_GT(std::abs(given), 4.0 * std::abs(kept));
      EXPECT_GT(given * (to.x - 10.0), 0.0);
    }
    EXPECT_THAT(keeping.validate(), IsEmpty());
    EXPECT_EQ(test::find_mesh_faults(extract_surface(keeping)), test::MeshFaults{});
  }
}

TEST(ActionElastic, TakesTheMiddleAlongAndEndsAtThreeRadii) {
  Clay clay = moved_ball();
  ASSERT_TRUE(clay.apply(elastic_pull({10, 0, 0}, {13, 0, 0}, 1.0)).ok());
  EXPECT_NEAR(front_at(clay, 0, 0), 13.0, 0.1);
  EXPECT_NEAR(front_at(clay, 9.3, 0), std::sqrt(100.0 - 9.3 * 9.3), 0.2 * kMovedVoxel);
  EXPECT_NEAR(clay.distance_at({-10, 0, 0}), 0.0, 0.02);
  // Beyond grab's reach it still moves: what goes forward in the middle comes back beside.
  EXPECT_LT(front_at(clay, 5.0, 0), std::sqrt(75.0) - 0.1);
}

/// To and fro gives the clay back: no place is folded or torn.
TEST(ActionElastic, IsUndoneByTheWayBack) {
  Clay clay = moved_ball();
  ASSERT_TRUE(clay.apply(elastic_pull({10, 0, 0}, {13, 1, 0}, 1.0)).ok());
  ASSERT_TRUE(clay.apply(elastic_pull({13, 1, 0}, {10, 0, 0}, 1.0)).ok());
  for (const Vec3& vertex : extract_surface(clay).positions) {
    ASSERT_NEAR(length(vertex), kMovedBall, 0.5 * kMovedVoxel);
  }
}

// ---- snake_hook --------------------------------------------------------------------------------

Stroke hook_out(double factor, double spacing = 0.25) {
  Stroke hook = stroke_of(Action::snake_hook, 3.0, 1.0, {{9, 0, 0}, {16, 0, 0}, {20, 4, 0}});
  hook.tool.crease_pinch_factor = factor;
  hook.spacing = spacing;
  return hook;
}

/// How thick the tail is across y and z, at a place on its way out.
double thickness_at(const Clay& clay, double x) {
  double thick = 0.0;
  for (const Vec3& across : {Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    for (const double side : {-1.0, 1.0}) {
      const Vec3 from = Vec3{x, 0, 0} + 30.0 * side * across;
      const auto hit = pick(clay, Ray{from, -side * across});
      if (!hit.ok() || !hit.value()) return 0.0;
      thick += 0.5 * (30.0 - length(hit.value()->point_mm - from));
    }
  }
  return thick;
}

TEST(ActionSnakeHook, DrawsATailAlongItsWholeWay) {
  Clay clay = moved_ball();
  ASSERT_TRUE(clay.apply(hook_out(0.5)).ok());
  for (double x = 10.0; x <= 15.5; x += 0.5) {
    EXPECT_LT(clay.distance_at({x, 0, 0}), 0.0) << x;
    EXPECT_GT(thickness_at(clay, x), 1.0) << x;
  }
  EXPECT_LT(clay.distance_at({19, 3, 0}), 0.0);
  EXPECT_GT(moved_volume(clay), moved_volume(moved_ball()));
  EXPECT_NEAR(clay.distance_at({-10, 0, 0}), 0.0, 0.02);
  EXPECT_THAT(clay.validate(), IsEmpty());
  EXPECT_EQ(test::find_mesh_faults(extract_surface(clay)), test::MeshFaults{});
}

TEST(ActionSnakeHook, IsThinnerOrThickerByItsPinchFactor) {
  std::vector<double> thick;
  for (const double factor : {0.0, 0.5, 1.0}) {
    Clay clay = moved_ball();
    ASSERT_TRUE(clay.apply(hook_out(factor)).ok());
    thick.push_back(thickness_at(clay, 14.0));
    EXPECT_EQ(test::find_mesh_faults(extract_surface(clay)), test::MeshFaults{}) << factor;
  }
  std::printf("tail: %.2f, %.2f, %.2f mm thick\n", thick[0], thick[1], thick[2]);
  EXPECT_LT(thick[0], 0.95 * thick[1]);
  EXPECT_GT(thick[2], 1.1 * thick[1]);
}

TEST(ActionSnakeHook, HardlyDependsOnItsSpacing) {
  Clay near = moved_ball();
  Clay far = moved_ball();
  ASSERT_TRUE(near.apply(hook_out(0.5, 0.25)).ok());
  ASSERT_TRUE(far.apply(hook_out(0.5, 1.5)).ok());
  for (double x = 11.0; x <= 15.0; x += 1.0) {
    EXPECT_NEAR(thickness_at(far, x), thickness_at(near, x), 2.0 * kMovedVoxel) << x;
  }
}

/// Where the pressure of a pen decides the size, its first touch has next to none.
TEST(ActionSnakeHook, LeavesOutDabsThatNoLatticeHolds) {
  Clay clay = moved_ball();
  const std::uint64_t before = clay.hash();
  Stroke hook = hook_out(0.5);
  hook.tool.pressure_to_size = 1.0;
  for (const double pressure : {1e-4, 1e-7, 1e-12}) {
    for (StrokeSample& sample : hook.samples) sample.pressure = pressure;
    ASSERT_TRUE(clay.apply(hook).ok());
    EXPECT_EQ(clay.hash(), before) << pressure;
  }
}

// ---- slide -------------------------------------------------------------------------------------

/// Detail of two voxels' height on the ball, at an angle from the x axis.
Clay dotted_ball(double angle) {
  Clay clay = moved_ball();
  const Vec3 at = 9.7 * Vec3{std::cos(angle), std::sin(angle), 0.0};
  EXPECT_TRUE(clay.apply(stroke_of(Action::add, 0.7, 1.0, {at})).ok());
  return clay;
}

/// Where the ball stands out most, and how far.
struct KnobDot {
  double angle = 0.0;
  double height = 0.0;
};
KnobDot dot_of(const Clay& clay) {
  KnobDot highest;
  for (double a = -1.0; a <= 1.0; a += 0.005) {
    const Vec3 along{std::cos(a), std::sin(a), 0.0};
    const auto hit = pick(clay, Ray{30.0 * along, -along});
    if (!hit.ok() || !hit.value()) continue;
    const double height = length(hit.value()->point_mm) - kMovedBall;
    if (height > highest.height) highest = {a, height};
  }
  return highest;
}

TEST(ActionSlide, MovesDetailAndLeavesTheForm) {
  Clay clay = dotted_ball(-0.15);
  const KnobDot start = dot_of(clay);
  ASSERT_NEAR(start.angle, -0.15, 0.03);
  const auto on_ball = [](double a) { return kMovedBall * Vec3{std::cos(a), std::sin(a), 0.0}; };
  std::vector<Vec3> places;
  for (double a = -0.15; a <= 0.16; a += 0.05) places.push_back(on_ball(a));
  ASSERT_TRUE(clay.apply(stroke_of(Action::slide, 5.0, 1.0, places)).ok());
  const KnobDot end = dot_of(clay);
  std::printf("dot: %.3f rad, %.3f mm high; then %.3f rad, %.3f mm\n", start.angle, start.height,
              end.angle, end.height);
  EXPECT_NEAR(end.angle, 0.15, 0.04);
  EXPECT_NEAR(end.height / start.height, 1.0, 0.3);
  for (const Vec3& vertex : extract_surface(clay).positions) {
    if (length(vertex - on_ball(end.angle)) < 2.5) continue;
    ASSERT_NEAR(length(vertex), kMovedBall, 0.25 * kMovedVoxel) << vertex.x << ' ' << vertex.y;
  }
  EXPECT_THAT(clay.validate(), IsEmpty());
}

/// A hand that goes into the clay or out of it slides nothing.
TEST(ActionSlide, LeavesWhatTheHandPressesOn) {
  Clay clay = moved_ball();
  ASSERT_TRUE(clay.apply(stroke_of(Action::slide, 4.0, 1.0, {{9, 0, 0}, {12, 0, 0}})).ok());
  for (const Vec3& vertex : extract_surface(clay).positions) {
    ASSERT_NEAR(length(vertex), kMovedBall, 0.2 * kMovedVoxel);
  }
}

}  // namespace
}  // namespace argil
