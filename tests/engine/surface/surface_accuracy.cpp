// SPDX-License-Identifier: GPL-3.0-or-later
// How far the surface of a ball lies from the ball, within levels and where they meet.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "support/analytic_stack.h"
#include "surface/block_surface.h"

namespace argil::test {
namespace {

constexpr double kAccuracyVoxel = 0.05;

struct Deviation {
  double max = 0.0;     // voxels of the finest level
  double mean = 0.0;    // over vertices, edge middles and triangle middles
  double normal = 0.0;  // largest angle in radians between a vertex normal and the ball's
};

Deviation deviation_from_ball(const TriangleMesh& mesh, const Vec3& center, double radius) {
  Deviation d;
  double count = 0.0;
  const auto look = [&](const Vec3& p) {
    const double off = std::abs(length(p - center) - radius) / kAccuracyVoxel;
    d.max = std::max(d.max, off);
    d.mean += off;
    count += 1.0;
  };
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions[t[0]];
    const Vec3& b = mesh.positions[t[1]];
    const Vec3& c = mesh.positions[t[2]];
    for (const Vec3& p : {a, b, c, (a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5}) look(p);
    look((a + b + c) / 3.0);
  }
  d.mean /= count;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 exact = normalized(mesh.positions[i] - center);
    d.normal = std::max(d.normal, std::acos(std::min(1.0, dot(exact, mesh.normals[i]))));
  }
  return d;
}

// A ball of 32 voxels radius in a cube of 96 finest voxels.
AnalyticStack ball_scene(int levels, const Vec3& center) {
  AnalyticStack s;
  s.voxel_mm = kAccuracyVoxel;
  s.levels = levels;
  s.top_leaves = levels == 1 ? 6 : 3;
  s.field = ball_field(center, 32 * kAccuracyVoxel);
  s.choose = chosen_by_chance(5, 0.4);
  return s;
}

Deviation measure(int levels) {
  const Vec3 center{0.3 * kAccuracyVoxel, -0.4 * kAccuracyVoxel, 0.17 * kAccuracyVoxel};
  BlockSurface surface;
  surface.rebuild_all(ball_scene(levels, center).build());
  return deviation_from_ball(surface.weld(), center, 32 * kAccuracyVoxel);
}

void report(const Deviation& d) {
  testing::Test::RecordProperty("max_voxels", std::to_string(d.max));
  testing::Test::RecordProperty("mean_voxels", std::to_string(d.mean));
  testing::Test::RecordProperty("normal_rad", std::to_string(d.normal));
  std::printf("max %.4f h, mean %.4f h, normal %.4f rad\n", d.max, d.mean, d.normal);
}

TEST(SurfaceAccuracy, OfAUniformBallIsAFortiethOfAVoxel) {
  const Deviation d = measure(1);
  report(d);
  EXPECT_LT(d.max, 0.025);
  EXPECT_LT(d.mean, 0.01);
  EXPECT_LT(d.normal, 0.03);
}

// In voxels of the finer level; half of the ball is of the coarser one, whose own error is
// fourfold.
TEST(SurfaceAccuracy, OfABallOverTwoLevelsIsThatOfTheCoarser) {
  const Deviation d = measure(2);
  report(d);
  EXPECT_LT(d.max, 0.08);
  EXPECT_LT(d.mean, 0.02);
  EXPECT_LT(d.normal, 0.03);
}

}  // namespace
}  // namespace argil::test
