// SPDX-License-Identifier: GPL-3.0-or-later
// What strokes leave around them: clay that was smooth stays smooth to the eye.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/surface.h"

#include "support/measure/mesh_topology.h"

namespace argil {
namespace {

constexpr double kRadius = 25.0;
constexpr double kDegree = 3.14159265358979 / 180.0;

/// Over the bottom of the ball (-y), 12 degrees of its circumference, a tool of 5 mm.
Stroke over_the_bottom(Action action) {
  Stroke stroke;
  stroke.tool = {action, Shape::ball, {5.0, 5.0, 5.0}, 0.2};
  stroke.spacing = 0.25;
  for (int step = 0; step <= 12; ++step) {
    const double angle = (step - 6) * kDegree;
    const Vec3 place{kRadius * std::sin(angle), -kRadius * std::cos(angle), 0.0};
    stroke.samples.push_back({0.05 * step, place, {}, 1.0});
  }
  return stroke;
}

/// How far the surface's normals between two cones about -y lean from the ball's, degrees, sorted.
std::vector<double> leans(const Clay& clay, double from_degrees, double to_degrees) {
  const TriangleMesh mesh = extract_surface(clay);
  std::vector<double> all;
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    const Vec3 outward = mesh.positions[n] / length(mesh.positions[n]);
    const double aside = std::acos(-outward.y) / kDegree;
    if (aside < from_degrees || aside >= to_degrees) continue;
    all.push_back(std::acos(std::clamp(dot(mesh.normals[n], outward), -1.0, 1.0)) / kDegree);
  }
  std::sort(all.begin(), all.end());
  return all;
}

double share(const std::vector<double>& sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

TEST(SmoothStrokes, LeaveTheClayAroundThemAsSmoothAsItWas) {
  const ClayOptions options{.voxel_mm = 0.25, .tolerance_voxels = 0.02};
  Clay clay = Clay::ball(kRadius, options).value();
  const std::vector<double> before = leans(clay, 20.0, 30.0);
  for (const Action action : {Action::inflate, Action::smooth, Action::pinch}) {
    for (int pass = 0; pass < 3; ++pass) ASSERT_TRUE(clay.apply(over_the_bottom(action)).ok());
    const std::vector<double> after = leans(clay, 20.0, 30.0);
    RecordProperty("p95_degrees_" + std::to_string(static_cast<int>(action)),
                   std::to_string(share(after, 0.95)));
    EXPECT_LE(share(after, 0.5), share(before, 0.5) + 0.02) << static_cast<int>(action);
    EXPECT_LE(share(after, 0.95), share(before, 0.95) + 0.05) << static_cast<int>(action);
    for (int pass = 0; pass < 3; ++pass) ASSERT_TRUE(clay.undo());
  }
}

/// A bumpy ball, all of whose surface is on the finest level, and a tool of many voxels pulled over
/// it: the surface moves several voxels with each dab.
Clay inflated_ball(double voxel_mm) {
  constexpr double kBall = 8.0;
  const auto bumpy = [](const Vec3& p) {
    const double bump = std::sin(7.0 * p.x) * std::sin(7.0 * p.y) * std::sin(7.0 * p.z);
    return (length(p) - kBall - 0.06 * bump) / 1.1;
  };
  const Box3 bounds{{-9.0, -9.0, -9.0}, {9.0, 9.0, 9.0}};
  const ClayOptions options{.voxel_mm = voxel_mm, .tolerance_voxels = 0.02};
  Clay clay = Clay::from_distance(bumpy, bounds, options).value();
  Stroke stroke;
  stroke.tool = {Action::inflate, Shape::ball, {4.0, 4.0, 4.0}, 1.0};
  for (int step = 0; step <= 4; ++step) {
    const double angle = 0.1 * step;
    const Vec3 place{kBall * std::sin(angle), 0.0, kBall * std::cos(angle)};
    stroke.samples.push_back({0.1 * step, place, {}, 1.0});
  }
  EXPECT_TRUE(clay.apply(stroke).ok());
  return clay;
}

/// Where a dab moves the surface farther than its band is wide, the band has to follow it step by
/// step: else finer voxels end elsewhere.
TEST(InflateStrokes, ComeToTheSameOnFinerVoxels) {
  const Clay fine = inflated_ball(0.0625);
  const Clay coarse = inflated_ball(0.125);
  std::vector<double> apart;
  for (const Vec3& point : extract_surface(coarse).positions) {
    if (point.z > 5.0) apart.push_back(std::abs(fine.distance_at(point)) / 0.125);
  }
  std::sort(apart.begin(), apart.end());
  RecordProperty("p95_voxels", std::to_string(share(apart, 0.95)));
  EXPECT_LE(share(apart, 0.95), 0.2);
}

/// Open edges, parts and the like, of which there are to be none.
void expect_whole(const Clay& clay) {
  EXPECT_EQ(test::find_mesh_faults(extract_surface(clay)), test::MeshFaults{});
  EXPECT_TRUE(clay.validate().empty());
}

Stroke one_tool(Action action, double radius_mm, std::vector<Vec3> places) {
  Stroke stroke;
  stroke.tool = {action, Shape::ball, {radius_mm, radius_mm, radius_mm}, 1.0};
  for (std::size_t n = 0; n < places.size(); ++n) {
    stroke.samples.push_back({0.1 * static_cast<double>(n), places[n], {}, 1.0});
  }
  return stroke;
}

/// On the coarsest level nothing else knows where the surface is once it leaves the leaves.
TEST(InflateStrokes, GoBeyondTheLeavesOfTheCoarsestLevel) {
  const ClayOptions options{.voxel_mm = 0.5};
  Clay clay = Clay::ball(8.0, options).value();
  ASSERT_TRUE(clay.apply(one_tool(Action::inflate, 32.0, {{0.0, 0.0, 8.0}})).ok());
  expect_whole(clay);
}

/// How steep the distance is within two voxels of the surface of a ball of 25 mm about its +x pole,
/// sorted.
std::vector<double> steepness(const Clay& clay) {
  std::vector<double> all;
  constexpr double kStep = 0.25;
  for (double y = -6.0; y <= 6.0; y += 0.3) {
    for (double z = -3.0; z <= 3.0; z += 0.3) {
      const Vec3 outward = normalized(Vec3{kRadius, y, z});
      for (double x = kRadius - 4.0; x <= kRadius + 2.0; x += kStep) {
        const Vec3 at = x * outward;
        if (std::abs(clay.distance_at(at)) > 2.0 * kStep) continue;
        Vec3 rise;
        for (std::size_t a = 0; a < 3; ++a) {
          Vec3 step;
          step[a] = kStep;
          rise[a] = (clay.distance_at(at + step) - clay.distance_at(at - step)) / (2.0 * kStep);
        }
        all.push_back(length(rise));
      }
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// What is only carried along stays a distance nearly while the stroke goes on, and is one when it
/// ends.
TEST(CarriedClay, StaysADistanceFromDabToDab) {
  for (const Action action : {Action::pinch, Action::crease, Action::grab}) {
    Clay clay = Clay::ball(kRadius, {.voxel_mm = 0.25}).value();
    Stroke stroke = one_tool(action, 5.0, {});
    for (int n = 0; n <= 6; ++n) {
      const double angle = 0.05 * (n - 3);
      stroke.samples.push_back(
          {0.1 * n, kRadius * Vec3{std::cos(angle), std::sin(angle), 0.0}, {}, 1.0});
    }
    ASSERT_TRUE(clay.begin_stroke(stroke.tool, stroke).ok());
    for (const StrokeSample& sample : stroke.samples) {
      ASSERT_TRUE(clay.extend_stroke({&sample, 1}).ok());
      const std::vector<double> steep = steepness(clay);
      EXPECT_GT(share(steep, 0.01), 0.7) << static_cast<int>(action);
      EXPECT_LT(share(steep, 0.99), 1.35) << static_cast<int>(action);
    }
    ASSERT_TRUE(clay.end_stroke().ok());
    const std::vector<double> steep = steepness(clay);
    EXPECT_GT(share(steep, 0.05), 0.9) << static_cast<int>(action);
    EXPECT_LT(share(steep, 0.95), 1.05) << static_cast<int>(action);
    expect_whole(clay);
  }
}

/// Leaves of air that come to lie in clay, and the other way round, have no surface before or
/// after.
TEST(GrabStrokes, MoveWhatHasNoSurface) {
  const ClayOptions options{.voxel_mm = 0.5};
  Clay clay = Clay::ball(8.0, options).value();
  ASSERT_TRUE(clay.apply(one_tool(Action::add, 20.0, {{0.0, 0.0, 0.0}})).ok());
  std::vector<Vec3> path;
  for (int n = 0; n <= 10; ++n) path.push_back({3.0 * n, 0.0, 0.0});
  ASSERT_TRUE(clay.apply(one_tool(Action::grab, 60.0, path)).ok());
  expect_whole(clay);
}

}  // namespace
}  // namespace argil
