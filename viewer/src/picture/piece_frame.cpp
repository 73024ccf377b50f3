// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/piece_frame.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace argil::viewer {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// First b, then a.
Quat then_turned(const Quat& a, const Quat& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// Quarter turns to the last bit: they are what is typed most.
Quat turn_about(const Vec3& axis, double angle_deg) {
  assert(std::abs(length(axis) - 1.0) < 1e-6);
  const double quarters = angle_deg / 90.0;
  double half_sine = std::sin(0.5 * angle_deg * kDegree);
  double half_cosine = std::cos(0.5 * angle_deg * kDegree);
  if (quarters == std::round(quarters) && std::fmod(quarters, 2.0) == 0.0) {
    const double halves = std::round(quarters / 2.0);
    const bool is_odd = std::fmod(halves, 2.0) != 0.0;
    half_cosine = is_odd ? 0.0 : 1.0;
    half_sine = is_odd ? 1.0 : 0.0;
  }
  const Vec3 u = half_sine * axis;
  return {half_cosine, u.x, u.y, u.z};
}

}  // namespace

Vec3 turned(const Placement& placement, const Vec3& direction) noexcept {
  return rotate(placement.orientation, direction);
}

Vec3 turned_back(const Placement& placement, const Vec3& direction) noexcept {
  return rotate(conjugate(placement.orientation), direction);
}

Lens unplaced(const Placement& placement, const Lens& lens) noexcept {
  Lens seen = lens;
  seen.eye_mm = unplaced(placement, lens.eye_mm);
  seen.right = turned_back(placement, lens.right);
  seen.up = turned_back(placement, lens.up);
  seen.back = turned_back(placement, lens.back);
  return seen;
}

DisplayView unplaced(const Placement& placement, DisplayView view) noexcept {
  view.eye_mm = unplaced(placement, view.eye_mm);
  return view;
}

Ray unplaced(const Placement& placement, const Ray& ray) noexcept {
  return {unplaced(placement, ray.origin_mm), turned_back(placement, ray.direction)};
}

StrokeSample unplaced(const Placement& placement, StrokeSample sample) noexcept {
  // What stands where it was made gets the very bits that the hand had.
  if (are_same(placement, {})) return sample;
  sample.position_mm = unplaced(placement, sample.position_mm);
  sample.orientation =
      then_turned(conjugate(placement.orientation), normalized(sample.orientation));
  return sample;
}

Pick placed(const Placement& placement, Pick pick) noexcept {
  pick.point_mm = placed(placement, pick.point_mm);
  pick.normal = turned(placement, pick.normal);
  return pick;
}

Box3 placed(const Placement& placement, const Box3& box_mm) noexcept {
  Box3 around;
  if (box_mm.empty()) return around;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 p{(corner & 1U) != 0 ? box_mm.max.x : box_mm.min.x,
                 (corner & 2U) != 0 ? box_mm.max.y : box_mm.min.y,
                 (corner & 4U) != 0 ? box_mm.max.z : box_mm.min.z};
    around.include(placed(placement, p));
  }
  return around;
}

bool are_same(const Placement& a, const Placement& b) noexcept {
  return a.position_mm == b.position_mm && a.orientation == b.orientation;
}

Placement moved(Placement placement, const Vec3& by_mm) noexcept {
  placement.position_mm += by_mm;
  return placement;
}

Placement turned_about(const Placement& placement, const Vec3& point_mm, const Vec3& axis,
                       double angle_deg) noexcept {
  const Quat turn = turn_about(axis, angle_deg);
  return {point_mm + rotate(turn, placement.position_mm - point_mm),
          normalized(then_turned(turn, placement.orientation))};
}

Placement scaled_about(const Placement& placement, const Vec3& point_mm, double factor) noexcept {
  return {point_mm + factor * (placement.position_mm - point_mm), placement.orientation};
}

Lens shrunk(Lens lens, double scale) noexcept {
  assert(scale > 0.0);
  lens.eye_mm = lens.eye_mm / scale;
  lens.near_mm /= scale;
  lens.far_mm /= scale;
  if (!lens.is_parallel) return lens;
  lens.tan_x /= scale;
  lens.tan_y /= scale;
  lens.shift_x /= scale;
  lens.shift_y /= scale;
  return lens;
}

Quat orientation_of(const Vec3& turns_deg) noexcept {
  const Quat x = turn_about({1.0, 0.0, 0.0}, turns_deg.x);
  const Quat y = turn_about({0.0, 1.0, 0.0}, turns_deg.y);
  const Quat z = turn_about({0.0, 0.0, 1.0}, turns_deg.z);
  return normalized(then_turned(z, then_turned(y, x)));
}

Vec3 turns_of(const Quat& orientation) noexcept {
  // Where the axes of the piece point tells its turns: the matrix Rz Ry Rx, column by column.
  const Vec3 x = rotate(orientation, {1.0, 0.0, 0.0});
  const Vec3 y = rotate(orientation, {0.0, 1.0, 0.0});
  const Vec3 z = rotate(orientation, {0.0, 0.0, 1.0});
  Vec3 turns;
  turns.y = std::asin(std::clamp(-x.z, -1.0, 1.0));
  constexpr double kUpright = 1e-9;  // of the cosine: beyond it x and z turn about one axis
  if (std::hypot(x.x, x.y) > kUpright) {
    turns.x = std::atan2(y.z, z.z);
    turns.z = std::atan2(x.y, x.x);
  } else {
    turns.x = x.z < 0.0 ? std::atan2(y.x, y.y) : std::atan2(-y.x, y.y);
  }
  // Without the sign that a zero may have got.
  return turns / kDegree + Vec3{};
}

Vec3 linear_of(const Rgb8& color) noexcept {
  Vec3 linear;
  for (std::size_t n = 0; n < 3; ++n) {
    const double c = color[n] / 255.0;
    linear[n] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  return linear;
}

}  // namespace argil::viewer
