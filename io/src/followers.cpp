// SPDX-License-Identifier: GPL-3.0-or-later
#include "followers.h"

#include <cstddef>
#include <limits>

#include "mesh_distance.h"

namespace argil::io {

namespace {
constexpr std::uint32_t kEnd = 0xffffffff;
}  // namespace

Followers::Followers(const TriangleMesh& surface)
    : points_(surface.positions),
      first_(surface.triangles.size(), kEnd),
      next_(surface.positions.size(), kEnd) {
  std::vector<bool> has_home(points_.size(), false);
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    for (const std::uint32_t v : surface.triangles[t]) {
      if (has_home[v]) continue;
      has_home[v] = true;
      next_[v] = first_[t];
      first_[t] = v;
    }
  }
}

void Followers::gather(std::span<const std::uint32_t> triangles) {
  gathered_.clear();
  for (const std::uint32_t t : triangles) {
    for (std::uint32_t p = first_[t]; p != kEnd; p = next_[p]) gathered_.push_back(p);
  }
}

bool Followers::place(std::span<const Corners> made, double reach_mm) {
  home_.resize(gathered_.size());
  for (std::size_t i = 0; i < gathered_.size(); ++i) {
    const Vec3& p = points_[gathered_[i]];
    double least = std::numeric_limits<double>::infinity();
    for (const Corners& t : made) {
      const Vec3 way = closest_on_triangle(p, t.a, t.b, t.c) - p;
      const double square = dot(way, way);
      if (square >= least) continue;
      least = square;
      home_[i] = t.number;
    }
    if (least > reach_mm * reach_mm) return false;
  }
  return true;
}

void Followers::commit(std::span<const std::uint32_t> replaced) {
  for (const std::uint32_t t : replaced) first_[t] = kEnd;
  for (std::size_t i = 0; i < gathered_.size(); ++i) {
    next_[gathered_[i]] = first_[home_[i]];
    first_[home_[i]] = gathered_[i];
  }
}

}  // namespace argil::io
