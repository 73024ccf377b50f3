// SPDX-License-Identifier: GPL-3.0-or-later
// What an operation should have made, as distances of its vertices: no second way to compute the
// operation stands behind these figures, only the distance of the body that was worked.
#include "operations/truth.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "scene/scene.h"

namespace argil::evaluation {
namespace {

constexpr double kSeamMm = 2.0 * kVoxelMm;

/// `value` of each place, in their order.
template <class T, class Value>
std::vector<T> at_each(const std::vector<Vec3>& places, const Value& value) {
  std::vector<T> values(places.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, places.size(), 4096),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        values[i] = static_cast<T>(value(places[i]));
                      }
                    });
  return values;
}

std::vector<double> errors_at(const std::vector<Vec3>& places, const Distance& error_mm) {
  return at_each<double>(places, error_mm);
}

double greatest(const std::vector<double>& errors) {
  return errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end());
}

/// Points of a surface, each with its share of the area.
struct SurfacePoints {
  std::vector<Vec3> places;
  std::vector<double> weights;
};

/// Corners and centre of the triangles: half of the area is that of the centre. Of many triangles
/// each so many-th, which leaves out few corners.
SurfacePoints points_on(const TriangleMesh& mesh) {
  constexpr std::size_t kMostTriangles = 200'000;
  const std::size_t step = (mesh.triangles.size() + kMostTriangles - 1) / kMostTriangles;
  SurfacePoints points;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += step) {
    const auto [a, b, c] = mesh.triangles[i];
    const std::array corners{mesh.positions[a], mesh.positions[b], mesh.positions[c]};
    const double area = 0.5 * length(cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (const Vec3& p : corners) {
      points.places.push_back(p);
      points.weights.push_back(area / 6.0);
    }
    points.places.push_back((corners[0] + corners[1] + corners[2]) / 3.0);
    points.weights.push_back(area / 2.0);
  }
  return points;
}

struct Weighed {
  double value;
  double weight;
};

/// What share of the weight does not exceed; sorted.
double quantile_of(const std::vector<Weighed>& sorted, double share, double all) {
  double sum = 0.0;
  for (const Weighed& one : sorted) {
    sum += one.weight;
    if (sum >= share * all) return one.value;
  }
  return sorted.back().value;
}

void summarize(std::vector<Weighed>& errors, OperationError& error) {
  assert(!errors.empty());
  std::sort(errors.begin(), errors.end(),
            [](const Weighed& a, const Weighed& b) { return a.value < b.value; });
  double squares = 0.0;
  double all = 0.0;
  for (const Weighed& one : errors) {
    squares += one.weight * one.value * one.value;
    all += one.weight;
  }
  error.p50 = quantile_of(errors, 0.5, all);
  error.p99 = quantile_of(errors, 0.99, all);
  error.max = errors.back().value;
  error.rms = std::sqrt(squares / all);
}

/// So many of the places that few stand between two of them.
std::vector<Vec3> some_of(const std::vector<Vec3>& places) {
  constexpr std::size_t kMostPlaces = 500'000;
  const std::size_t step = (places.size() + kMostPlaces - 1) / kMostPlaces;
  std::vector<Vec3> some;
  for (std::size_t i = 0; i < places.size(); i += step) some.push_back(places[i]);
  return some;
}

std::vector<Vec3> places_where(const std::vector<Vec3>& places,
                               const std::function<bool(const Vec3&)>& asked) {
  const auto is_kept = at_each<char>(places, asked);
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (is_kept[i] != 0) kept.push_back(places[i]);
  }
  return kept;
}

}  // namespace

Truth as_it_was(const WorkedBody& body) {
  return {[distance = body.distance](const Vec3& p) { return std::abs(distance(p)); }, nullptr,
          [](const Vec3&) { return true; }};
}

Truth moved_surface(const WorkedBody& body, double distance_mm) {
  return {[distance = body.distance, distance_mm](const Vec3& p) {
            return std::abs(distance(p) - distance_mm);
          },
          nullptr, nullptr};
}

Truth hollow_wall(const WorkedBody& body, double wall_mm) {
  return {[distance = body.distance, wall_mm](const Vec3& p) {
            const double d = distance(p);
            return std::min(std::abs(d), std::abs(d + wall_mm));
          },
          nullptr, [](const Vec3&) { return true; }};
}

Truth united(const WorkedBody& body, const Placement& copy) {
  const Distance a = body.distance;
  const Distance b = placed(body.distance, copy);
  // The lesser of two distances is that of their union wherever it is zero or more.
  return {[=](const Vec3& p) { return std::abs(std::min(a(p), b(p))); },
          [=](const Vec3& p) { return std::abs(a(p)) < kSeamMm && std::abs(b(p)) < kSeamMm; },
          [=](const Vec3& p) { return b(p) > kSeamMm; }};
}

OperationError error_of(const TriangleMesh& result, const WorkedBody& body, const Truth& truth) {
  assert(!result.triangles.empty());
  OperationError error;
  const SurfacePoints points = points_on(result);
  const std::vector<double> errors = errors_at(points.places, truth.error_mm);
  std::vector<char> is_seam(errors.size(), 0);
  if (truth.is_seam) {
    is_seam = at_each<char>(points.places, truth.is_seam);
    error.seam = 0.0;
  }
  std::vector<Weighed> beyond;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double voxels = errors[i] / kVoxelMm;
    if (is_seam[i] != 0) {
      error.seam = std::max(*error.seam, voxels);
    } else {
      beyond.push_back({voxels, points.weights[i]});
    }
  }
  summarize(beyond, error);
  if (truth.stays) {
    const Distance to_result = distance_to(std::make_shared<const TriangleMesh>(result));
    const std::vector<Vec3> wanted = places_where(some_of(body.mesh->positions), truth.stays);
    error.missed = greatest(errors_at(wanted, to_result)) / kVoxelMm;
  }
  return error;
}

}  // namespace argil::evaluation
