// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/flat_hull.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>

namespace argil::mesh {
namespace {

double left_of(const Vec3& a, const Vec3& b, const Vec3& p) noexcept {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Adds a point to the end of a chain that only turns left; its first `kept` points stay.
void extend_chain(std::vector<Vec3>& chain, std::size_t kept, const Vec3& p) {
  while (chain.size() > kept && left_of(chain[chain.size() - 2], chain.back(), p) <= 0.0) {
    chain.pop_back();
  }
  chain.push_back(p);
}

}  // namespace

std::vector<Vec3> flat_hull(std::vector<Vec3> points) {
  const auto is_before = [](const Vec3& a, const Vec3& b) {
    return std::tie(a.x, a.y) < std::tie(b.x, b.y);
  };
  const auto is_same = [](const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y; };
  std::sort(points.begin(), points.end(), is_before);
  points.erase(std::unique(points.begin(), points.end(), is_same), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec3> hull;
  for (const Vec3& p : points) extend_chain(hull, 1, p);
  const std::size_t lower = hull.size();
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) extend_chain(hull, lower, *p);
  assert(hull.size() >= 2);
  hull.pop_back();  // the first again
  return hull;
}

double depth_within(const std::vector<Vec3>& hull, const Vec3& point) {
  if (hull.size() < 3) return std::numeric_limits<double>::lowest();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec3& a = hull[i];
    const Vec3& b = hull[(i + 1) % hull.size()];
    const double side = std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
    assert(side > 0.0);
    least = std::min(least, left_of(a, b, point) / side);
  }
  return least;
}

}  // namespace argil::mesh
