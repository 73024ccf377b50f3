// SPDX-License-Identifier: GPL-3.0-or-later
// What comes to rest from all around, and which of that lies on most.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"
#include "argil/mesh/print_orientation.h"

#include "prepare/flat_hull.h"
#include "prepare/resting.h"
#include "prepare/sphere.h"
#include "prepare/standing.h"

namespace argil::mesh {
namespace {

constexpr std::size_t kPutDown = 200;  ///< directions; facets that catch less of them are small
constexpr int kBinsASide = 64;         ///< of each face of a cube about the middle
constexpr double kOneFacet = 0.9999;   ///< cosine of 0.8 degrees

/// The farthest point in each of some 25 000 directions: enough to roll on, and as few for a mesh
/// of millions.
std::vector<Vec3> outermost(const std::vector<Vec3>& points, const Vec3& middle) {
  struct Far {
    double square = -1.0;
    std::size_t point = 0;
  };
  std::vector<Far> bins(std::size_t{6} * kBinsASide * kBinsASide);
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Vec3 from = points[n] - middle;
    std::size_t axis = 0;
    for (std::size_t a = 1; a < 3; ++a) {
      if (std::abs(from[a]) > std::abs(from[axis])) axis = a;
    }
    const double along = std::abs(from[axis]);
    if (along == 0.0) continue;
    const auto bin_of = [&](double across) {
      const int bin = static_cast<int>(0.5 * kBinsASide * (1.0 + across / along));
      return static_cast<std::size_t>(std::clamp(bin, 0, kBinsASide - 1));
    };
    const std::size_t face = 2 * axis + (from[axis] < 0.0 ? 1 : 0);
    const std::size_t row = face * kBinsASide + bin_of(from[(axis + 1) % 3]);
    Far& far = bins[row * kBinsASide + bin_of(from[(axis + 2) % 3])];
    const double square = dot(from, from);
    if (square > far.square) far = {square, n};
  }
  std::vector<Vec3> kept;
  for (const Far& far : bins) {
    if (far.square >= 0.0) kept.push_back(points[far.point]);
  }
  return kept;
}

/// The area of the convex hull of what lies within `slack_mm` of the plane below.
double area_below(const std::vector<Vec3>& points, const Vec3& up, double slack_mm) {
  const Vec3 any = std::abs(up.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 u = normalized(cross(up, any));
  const Vec3 v = cross(up, u);
  double lowest = dot(points[0], up);
  for (const Vec3& p : points) lowest = std::min(lowest, dot(p, up));
  std::vector<Vec3> flat;
  for (const Vec3& p : points) {
    if (dot(p, up) <= lowest + slack_mm) flat.push_back({dot(p, u), dot(p, v), 0.0});
  }
  const std::vector<Vec3> hull = flat_hull(std::move(flat));
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
    twice += cross(hull[i] - hull[0], hull[i + 1] - hull[0]).z;
  }
  return 0.5 * twice;
}

}  // namespace

Vec3 lying_on_most(const TriangleMesh& mesh, const Vec3& up, double slack_mm, const Pace& pace) {
  constexpr double kRolled = 0.3;  // of the work, where the mesh is small
  assert(!mesh.positions.empty() && slack_mm >= 0.0);
  const Vec3 centre = centre_of_mass(mesh);
  const std::vector<Vec3> outer = outermost(mesh.positions, centre);
  if (outer.empty()) return up;
  std::vector<Vec3> rests{rested_up(outer, centre, up)};
  for (std::size_t n = 0; n < kPutDown; ++n) {
    pace.at(kRolled * static_cast<double>(n) / kPutDown);
    const Vec3 rest = rested_up(outer, centre, direction_around(n, kPutDown));
    const bool is_known = std::any_of(rests.begin(), rests.end(), [&](const Vec3& known) {
      return dot(known, rest) > kOneFacet;
    });
    if (!is_known) rests.push_back(rest);
  }
  // What lies in one plane does so but for rounding.
  Box3 box;
  for (const Vec3& p : outer) box.include(p);
  const double slack = std::max(slack_mm, 1e-7 * length(box.size()));
  // The first is where it lies now, or would: another side has to be larger.
  constexpr double kLarger = 1.001;
  Vec3 best = rests[0];
  double most = area_below(mesh.positions, best, slack);
  for (std::size_t n = 0; n < rests.size(); ++n) {
    pace.at(kRolled + (1.0 - kRolled) * static_cast<double>(n) / static_cast<double>(rests.size()));
    const double area = area_below(mesh.positions, rests[n], slack);
    if (area <= kLarger * most) continue;
    most = area;
    best = rests[n];
  }
  return rested_up(mesh.positions, centre, best);
}

}  // namespace argil::mesh
