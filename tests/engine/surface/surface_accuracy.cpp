// SPDX-License-Identifier: GPL-3.0-or-later
// How far surface and vertices lie from bodies, within levels and where they meet.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
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

// Over triangles, which are flat: the sagitta of their sides is most of it.
TEST(SurfaceAccuracy, OfAUniformBallIsAHundredthOfAVoxel) {
  const Deviation d = measure(1);
  report(d);
  EXPECT_LT(d.max, 0.012);
  EXPECT_LT(d.mean, 0.004);
  EXPECT_LT(d.normal, 0.001);
}

// In voxels of the finer level; half of the ball is of the coarser one, whose own error is
// fourfold.
TEST(SurfaceAccuracy, OfABallOverTwoLevelsIsThatOfTheCoarser) {
  const Deviation d = measure(2);
  report(d);
  EXPECT_LT(d.max, 0.05);
  EXPECT_LT(d.mean, 0.01);
  EXPECT_LT(d.normal, 0.03);
}

// ---- vertices alone --

/// A body on a lattice of one level, askew and off its nodes.
struct Body {
  const char* name;
  double reach;                       ///< of the body from its middle, in its own size
  double curvature;                   ///< its smallest radius of curvature, likewise
  double (*distance)(const Vec3& p);  ///< likewise
};
double ball_of_one(const Vec3& p) { return length(p) - 1.0; }
double torus_of_one(const Vec3& p) { return std::hypot(std::hypot(p.x, p.y) - 0.7, p.z) - 0.3; }
double rounded_box_of_one(const Vec3& p) {
  constexpr double kRound = 0.35;
  const auto beyond = [](double v, double half) { return std::abs(v) - (half - kRound); };
  const Vec3 d{beyond(p.x, 0.8), beyond(p.y, 0.6), beyond(p.z, 0.5)};
  const Vec3 out{std::max(d.x, 0.0), std::max(d.y, 0.0), std::max(d.z, 0.0)};
  return length(out) + std::min(std::max({d.x, d.y, d.z}), 0.0) - kRound;
}
/// The inner half of a torus' tube bends one way along the ring and the other across it.
double saddle_of_one(const Vec3& p) { return std::hypot(std::hypot(p.x, p.y) - 0.6, p.z) - 0.35; }

struct VertexErrors {
  double max = 0.0;  ///< in h^2/R
  double rms = 0.0;
  double normal = 0.0;        ///< radians
  double sliver_share = 0.0;  ///< of the triangles: an angle under 5 degrees
  double least_angle_deg = 180.0;
};

double least_angle_deg(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto at = [](const Vec3& p, const Vec3& q, const Vec3& r) {
    return std::acos(std::clamp(dot(normalized(q - p), normalized(r - p)), -1.0, 1.0));
  };
  return 180.0 / std::numbers::pi * std::min({at(a, b, c), at(b, c, a), at(c, a, b)});
}

/// Of so many voxels to the body's size; `is_counted`: which part of it, by place.
VertexErrors errors_of(const Body& body, double voxels,
                       const std::function<bool(const Vec3&)>& is_counted = {}) {
  const Vec3 middle{0.137, 0.291, 0.423};  // voxels
  const Quat turn = normalized(Quat{0.9, 0.3, 0.25, 0.2});
  const auto own = [=](const Vec3& p) { return rotate(turn, p - middle) / voxels; };
  AnalyticStack lattice;
  lattice.top_leaves = static_cast<int>(std::ceil((body.reach * voxels + 5.0) / 8.0));
  lattice.field = [&](int, const Coord&, const Vec3& p) {
    return static_cast<float>(voxels * body.distance(own(p)));
  };
  BlockSurface surface;
  const LevelStack stack = lattice.build();
  surface.rebuild_all(stack);
  const TriangleMesh mesh = surface.weld();
  VertexErrors errors;
  double count = 0.0;
  const double unit = 1.0 / (voxels * body.curvature);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3& p = mesh.positions[i];
    if (is_counted && !is_counted(own(p))) continue;
    const double off = std::abs(voxels * body.distance(own(p))) / unit;
    errors.max = std::max(errors.max, off);
    errors.rms += off * off;
    count += 1.0;
    Vec3 gradient;
    for (std::size_t a = 0; a < 3; ++a) {
      constexpr double kStep = 1e-3;
      Vec3 step;
      step[a] = kStep;
      gradient[a] = body.distance(own(p + step)) - body.distance(own(p - step));
    }
    const double cosine = dot(normalized(gradient), mesh.normals[i]);
    errors.normal = std::max(errors.normal, std::acos(std::min(1.0, cosine)));
  }
  errors.rms = std::sqrt(errors.rms / count);
  for (const Triangle& t : mesh.triangles) {
    const double angle =
        least_angle_deg(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    errors.least_angle_deg = std::min(errors.least_angle_deg, angle);
    errors.sliver_share += angle < 5.0 ? 1.0 / static_cast<double>(mesh.triangles.size()) : 0.0;
  }
  std::printf(
      "%s, %g voxels: max %.4f, rms %.4f h^2/R, normal %.5f rad; under 5 degrees %.4f %%, "
      "least %.2f\n",
      body.name, voxels, errors.max, errors.rms, errors.normal, 100.0 * errors.sliver_share,
      errors.least_angle_deg);
  return errors;
}

TEST(SurfaceVertices, OfABallAreOffByLessThanASixteenthOfH2OverRAtAnySize) {
  for (const double voxels : {20.0, 40.0, 80.0, 160.0}) {
    const VertexErrors errors = errors_of({"ball", 1.0, 1.0, ball_of_one}, voxels);
    EXPECT_LE(errors.max, 0.06) << voxels;
    EXPECT_LE(errors.normal, 1.0 / (voxels * voxels)) << voxels;  // second order as well
    EXPECT_LE(errors.sliver_share, 0.001) << voxels;
  }
}

/// Four times smaller where voxels are half as large.
void expect_second_order(const Body& body,
                         const std::function<bool(const Vec3&)>& is_counted = {}) {
  const VertexErrors coarse = errors_of(body, 32.0, is_counted);
  const VertexErrors fine = errors_of(body, 64.0, is_counted);
  EXPECT_LE(fine.max, 1.1 * coarse.max);  // in h^2/R: level is second order
  EXPECT_LE(fine.rms, 1.1 * coarse.rms);
  EXPECT_LE(fine.normal, 0.5 * coarse.normal);
  EXPECT_LE(fine.sliver_share, 0.001);
}

TEST(SurfaceVertices, AreOfSecondOrderOnATorus) {
  expect_second_order({"torus", 1.0, 0.3, torus_of_one});
}
TEST(SurfaceVertices, AreOfSecondOrderOnARoundedBox) {
  expect_second_order({"rounded box", 1.12, 0.35, rounded_box_of_one});
}
TEST(SurfaceVertices, AreOfSecondOrderOnASaddle) {
  expect_second_order({"saddle", 1.0, 0.25, saddle_of_one},
                      [](const Vec3& p) { return std::hypot(p.x, p.y) < 0.5; });
}

}  // namespace
}  // namespace argil::test
