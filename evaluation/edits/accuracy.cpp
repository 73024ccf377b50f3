// SPDX-License-Identifier: GPL-3.0-or-later
// Distances between what strokes left, where they went.
#include "edits/accuracy.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include <tbb/parallel_for.h>

#include "argil/engine/mesh_distance.h"

namespace argil::evaluation {
namespace {

/// Triangles are kept this far, so that the nearest to a point of the stroke is among them.
constexpr double kKeptReach = 1.75;
constexpr std::size_t kMostPoints = 200'000;
constexpr std::uint32_t kNone = 0xFFFFFFFFU;

/// The vertices where the stroke went, or evenly chosen ones of them.
std::vector<Vec3> points_near(const TriangleMesh& mesh, const StrokePlan& plan) {
  std::vector<Vec3> near;
  for (const Vec3& p : mesh.positions) {
    if (is_near(plan, p, kStrokeReach)) near.push_back(p);
  }
  const std::size_t step = near.size() / kMostPoints + 1;
  std::vector<Vec3> chosen;
  for (std::size_t i = 0; i < near.size(); i += step) chosen.push_back(near[i]);
  return chosen;
}

DistanceSpread spread_of(std::vector<double> distances) {
  if (distances.empty()) return {};
  std::sort(distances.begin(), distances.end());
  const auto count = static_cast<double>(distances.size());
  const auto p99 = static_cast<std::size_t>(0.99 * (count - 1.0));
  return {std::accumulate(distances.begin(), distances.end(), 0.0) / count, distances[p99],
          distances.back()};
}

DistanceSpread worse_of(const DistanceSpread& a, const DistanceSpread& b) {
  return {std::max(a.mean_mm, b.mean_mm), std::max(a.p99_mm, b.p99_mm),
          std::max(a.max_mm, b.max_mm)};
}

DistanceSpread spread_to_mesh(const std::vector<Vec3>& points, const TriangleMesh& mesh) {
  assert(!mesh.triangles.empty());
  const MeshDistance near(mesh.positions, mesh.triangles);
  std::vector<double> distances(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    distances[i] = near.closest(points[i], std::numeric_limits<double>::infinity()).distance;
  });
  return spread_of(std::move(distances));
}

/// By central differences over a millionth of a ball.
Vec3 slope_of(const ShapeFunction& shape, const Vec3& p) {
  constexpr double kStepMm = 1e-6 * kBallMm;
  Vec3 slope;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 step;
    step[axis] = kStepMm;
    slope[axis] = (shape(p + step) - shape(p - step)) / (2.0 * kStepMm);
  }
  return slope;
}

/// To the shape's surface along its slope, by Newton's method.
Vec3 moved_onto(const ShapeFunction& shape, Vec3 p) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 slope = slope_of(shape, p);
    p -= shape(p) / dot(slope, slope) * slope;
  }
  return p;
}

}  // namespace

TriangleMesh part_near_stroke(const TriangleMesh& mesh, const StrokePlan& plan, double radii) {
  std::vector<bool> wanted(mesh.positions.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    wanted[i] = is_near(plan, mesh.positions[i], radii);
  }
  TriangleMesh part;
  std::vector<std::uint32_t> numbers(mesh.positions.size(), kNone);
  for (const Triangle& triangle : mesh.triangles) {
    if (!wanted[triangle[0]] && !wanted[triangle[1]] && !wanted[triangle[2]]) continue;
    Triangle own{};
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& number = numbers[triangle[i]];
      if (number == kNone) {
        number = static_cast<std::uint32_t>(part.positions.size());
        part.positions.push_back(mesh.positions[triangle[i]]);
      }
      own[i] = number;
    }
    part.triangles.push_back(own);
  }
  return part;
}

DistanceSpread spread_between(const TriangleMesh& a, const TriangleMesh& b,
                              const StrokePlan& plan) {
  const TriangleMesh near_a = part_near_stroke(a, plan, kKeptReach);
  const TriangleMesh near_b = part_near_stroke(b, plan, kKeptReach);
  return worse_of(spread_to_mesh(points_near(near_a, plan), near_b),
                  spread_to_mesh(points_near(near_b, plan), near_a));
}

DistanceSpread spread_to_shape(const TriangleMesh& mesh, const TriangleMesh& finer,
                               const ShapeFunction& shape, const StrokePlan& plan) {
  const TriangleMesh near = part_near_stroke(mesh, plan, kKeptReach);
  std::vector<double> off;
  for (const Vec3& p : points_near(near, plan)) {
    off.push_back(std::abs(shape(p)) / length(slope_of(shape, p)));
  }
  std::vector<Vec3> exact = points_near(finer, plan);
  for (Vec3& p : exact) p = moved_onto(shape, p);
  return worse_of(spread_of(std::move(off)), spread_to_mesh(exact, near));
}

double longest_edge_mm(const TriangleMesh& mesh, const StrokePlan& plan) {
  double longest = 0.0;
  for (const Triangle& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& a = mesh.positions[triangle[i]];
      const Vec3& b = mesh.positions[triangle[(i + 1) % 3]];
      const double edge = length(b - a);
      if (edge > longest && is_near(plan, a, kStrokeReach)) longest = edge;
    }
  }
  return longest;
}

}  // namespace argil::evaluation
