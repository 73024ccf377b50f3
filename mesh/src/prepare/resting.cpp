// SPDX-License-Identifier: GPL-3.0-or-later
// Rolling, as seen from the solid: what turns is the plane below it, whose outward normal is
// `down`. It turns from contact to contact toward the side where the centre of mass overhangs.
#include "prepare/resting.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "prepare/flat_hull.h"

namespace argil::mesh {
namespace {

class Rolling {
 public:
  Rolling(std::span<const Vec3> points, const Vec3& centre, const Vec3& up)
      : points_(points), centre_(centre), down_(-up) {
    Box3 box;
    for (const Vec3& p : points) box.include(p);
    near_ = 1e-7 * length(box.size());
  }

  Vec3 rest() {
    // Each roll lowers the centre of mass, so that no facet comes twice; this ends rounding.
    constexpr int kMostRolls = 100;
    for (int roll = 0; roll < kMostRolls; ++roll) {
      if (!roll_once()) break;
    }
    return -down_;
  }

 private:
  bool roll_once();
  bool turn_toward(const Vec3& side, const Vec3& pivot);
  std::vector<Vec3> contacts() const;

  std::span<const Vec3> points_;
  Vec3 centre_;
  Vec3 down_;
  double near_ = 0.0;  ///< mm
};

/// The points that lie on the plane.
std::vector<Vec3> Rolling::contacts() const {
  double lowest = dot(points_[0], down_);
  for (const Vec3& p : points_) lowest = std::max(lowest, dot(p, down_));
  std::vector<Vec3> found;
  for (const Vec3& p : points_) {
    if (dot(p, down_) >= lowest - near_) found.push_back(p);
  }
  return found;
}

/// Turns the plane about a line through `pivot`, toward `side`, until it meets another point.
bool Rolling::turn_toward(const Vec3& side, const Vec3& pivot) {
  double least_tangent = 0.0;
  bool is_found = false;
  Vec3 next = down_;
  for (const Vec3& p : points_) {
    const double along = dot(p - pivot, side);
    if (along <= near_) continue;
    const double above = std::max(0.0, -dot(p - pivot, down_));
    const double tangent = above / along;
    if (is_found && tangent >= least_tangent) continue;
    is_found = true;
    least_tangent = tangent;
    next = normalized(along * down_ + above * side);
  }
  down_ = next;
  return is_found;
}

/// Whether it rolled; false where it rests.
bool Rolling::roll_once() {
  const std::vector<Vec3> touching = contacts();
  assert(!touching.empty());
  // The plane's own frame: u, v, down.
  const Vec3 any = std::abs(down_.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 u = normalized(cross(down_, any));
  const Vec3 v = cross(down_, u);
  const auto in_plane = [&](const Vec3& p) { return Vec3{dot(p, u), dot(p, v), 0.0}; };
  const Vec3 centre = in_plane(centre_);
  std::vector<Vec3> flat;
  for (const Vec3& p : touching) flat.push_back(in_plane(p));
  const std::vector<Vec3> hull = flat_hull(flat);
  if (depth_within(hull, centre) >= 0.0) return false;
  // Of the hull's edges, the one that the centre lies farthest beyond; of one that is a line or a
  // point, the side on which the centre is.
  Vec3 side;
  Vec3 pivot_flat = hull[0];
  double farthest = 0.0;
  for (std::size_t i = 0; i < hull.size() && hull.size() > 1; ++i) {
    const Vec3 edge = normalized(hull[(i + 1) % hull.size()] - hull[i]);
    const Vec3 outward{edge.y, -edge.x, 0.0};
    const double beyond = dot(centre - hull[i], outward);
    if (beyond <= farthest) continue;
    farthest = beyond;
    side = outward;
    pivot_flat = hull[i];
  }
  if (hull.size() == 1) side = normalized(centre - hull[0]);
  // Balanced on a point or an edge: it falls to either side.
  if (side == Vec3{}) {
    const Vec3 edge = hull.size() == 1 ? Vec3{1.0, 0.0, 0.0} : normalized(hull[1] - hull[0]);
    side = {edge.y, -edge.x, 0.0};
  }
  const double depth = dot(touching[0], down_);
  const Vec3 pivot = pivot_flat.x * u + pivot_flat.y * v + depth * down_;
  return turn_toward(side.x * u + side.y * v, pivot);
}

}  // namespace

Vec3 rested_up(std::span<const Vec3> points, const Vec3& centre, const Vec3& up) {
  assert(!points.empty());
  return Rolling(points, centre, up).rest();
}

}  // namespace argil::mesh
