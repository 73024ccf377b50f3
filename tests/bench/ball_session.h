// SPDX-License-Identifier: GPL-3.0-or-later
// What benches of sculpting sessions work on.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "argil/engine/clay.h"
#include "argil/engine/pick.h"
#include "argil/engine/surface.h"

#include "bench/hand.h"
#include "support/bumpy_clay.h"

namespace argil::bench {

inline constexpr double kVoxelMm = 0.25;
/// A surface that lies in all directions cuts so many lattice edges for each voxel^2 of area.
inline constexpr double kVerticesPerSquareVoxel = 1.5;

/// The clay that a row works on, a bumpy ball, with its surface.
struct Ball {
  double radius_mm = 0.0;
  Clay clay;
  Surface surface;
  std::vector<Vec3> vertices;  ///< of the untouched surface
};

/// One with about so many vertices.
inline Result<Ball> made_ball(std::int64_t vertices, std::optional<double> edge_radius_mm = {}) {
  const double area = static_cast<double>(vertices) / kVerticesPerSquareVoxel;
  const double radius_mm = kVoxelMm * std::sqrt(area / (4.0 * std::numbers::pi));
  auto made = test::bumpy_ball(radius_mm, kVoxelMm, edge_radius_mm);
  if (!made) return made.error();
  Ball ball{radius_mm, std::move(made.value()), Surface(), {}};
  ball.surface.update(ball.clay);
  ball.vertices = ball.surface.weld().positions;
  ball.vertices.shrink_to_fit();
  return ball;
}

/// The part of a ball's surface, as an area, within `radius` of a point `away` from its centre.
inline double area_within(double ball, double away, double radius) {
  const double cosine = (ball * ball + away * away - radius * radius) / (2.0 * ball * away);
  return 2.0 * std::numbers::pi * ball * ball * (1.0 - std::clamp(cosine, -1.0, 1.0));
}

inline Tool tool_covering(double vertices, Action action, double ball_mm) {
  const double area = vertices / kVerticesPerSquareVoxel * kVoxelMm * kVoxelMm;
  double low = kVoxelMm;
  double high = ball_mm;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const double away = ball_mm + height_of(action) * middle;
    (area_within(ball_mm, away, middle) < area ? low : high) = middle;
  }
  Tool tool;
  tool.action = action;
  tool.radii_mm = {low, low, low};
  return tool;
}

/// Where stroke `n` of a session begins, as a direction: no two begin alike.
inline Vec3 start_of_stroke(int n) {
  const double turn = 2.399963 * n;  // the golden angle
  return {std::cos(turn), std::sin(turn), 0.8 - 0.4 * (n % 5)};
}

/// Ray `n` of an eye above a dab: 0 at its middle, `rays` others spread over half the tool.
inline Ray ray_over_dab(const StrokeSample& sample, const Tool& tool, int n, int rays) {
  const Vec3 up = normalized(sample.position_mm);
  const Vec3 side = normalized(cross(up, Vec3{0.36, 0.48, 0.8}));
  const double turn = 2.399963 * n;
  const double out = 0.5 * smallest_radius(tool) * std::sqrt(static_cast<double>(n) / rays);
  const Vec3 beside = out * (std::cos(turn) * side + std::sin(turn) * cross(up, side));
  return {3.0 * sample.position_mm + beside, -up};
}

}  // namespace argil::bench
