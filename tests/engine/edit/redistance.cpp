// SPDX-License-Identifier: GPL-3.0-or-later
// What strokes leave around them: clay that was smooth stays smooth to the eye.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/surface.h"

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

}  // namespace
}  // namespace argil
