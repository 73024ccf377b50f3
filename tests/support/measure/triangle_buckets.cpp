// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/measure/triangle_buckets.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace argil::test {

double distance_to(const Vec3& p, const std::array<Vec3, 3>& t) {
  const Vec3 n = normalized(cross(t[1] - t[0], t[2] - t[0]));
  bool inside = n != Vec3{};
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 side = t[(k + 1) % 3] - t[k];
    if (dot(cross(n, side), p - t[k]) < 0.0) inside = false;
    const double square = dot(side, side);
    const double along = square > 0.0 ? std::clamp(dot(p - t[k], side) / square, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, length(p - (t[k] + along * side)));
  }
  return inside ? std::abs(dot(n, p - t[0])) : nearest;
}

TriangleBuckets::TriangleBuckets(const TriangleMesh& mesh, double side) : mesh_(mesh), side_(side) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Box3 box;
    for (const std::uint32_t v : mesh.triangles[t]) box.include(mesh.positions[v]);
    const Key low = key(box.min);
    const Key high = key(box.max);
    for (int x = low[0]; x <= high[0]; ++x) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int z = low[2]; z <= high[2]; ++z) boxes_[{x, y, z}].push_back(t);
      }
    }
  }
}

TriangleBuckets::Key TriangleBuckets::key(const Vec3& p) const {
  const auto of = [&](double x) { return static_cast<int>(std::floor(x / side_)); };
  return {of(p.x), of(p.y), of(p.z)};
}

double TriangleBuckets::distance(const Vec3& p) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (int ring = 0; nearest > (ring - 1) * side_; ++ring) look_in_ring(p, ring, nearest);
  return nearest;
}

void TriangleBuckets::look_in_ring(const Vec3& p, int ring, double& nearest) const {
  const Key at = key(p);
  for (int x = -ring; x <= ring; ++x) {
    for (int y = -ring; y <= ring; ++y) {
      const bool rim = std::abs(x) == ring || std::abs(y) == ring;
      for (int z = -ring; z <= ring; z += rim || ring == 0 ? 1 : 2 * ring) {
        look_in_box(p, {at[0] + x, at[1] + y, at[2] + z}, nearest);
      }
    }
  }
}

/// A box that is farther than what was found has nothing nearer.
void TriangleBuckets::look_in_box(const Vec3& p, const Key& box, double& nearest) const {
  Vec3 beyond;
  for (std::size_t k = 0; k < 3; ++k) {
    beyond[k] = std::max({side_ * box[k] - p[k], p[k] - side_ * (box[k] + 1), 0.0});
  }
  if (dot(beyond, beyond) >= nearest * nearest) return;
  const auto found = boxes_.find(box);
  if (found == boxes_.end()) return;
  for (const std::uint32_t t : found->second) {
    const auto& [a, b, c] = mesh_.triangles[t];
    nearest = std::min(
        nearest, distance_to(p, {mesh_.positions[a], mesh_.positions[b], mesh_.positions[c]}));
  }
}

}  // namespace argil::test
