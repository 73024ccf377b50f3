// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/flat_triangle.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "field/leaf.h"

namespace argil {
namespace {

/// Offsets are told to 2^-30 voxel, so that a node that lies as far along an axis as a corner does
/// so exactly, whatever was rounded before.
constexpr double kSnapping = 1.5 * (1 << 22);
/// A side longer than this is counted from that of its ends which is nearer: floats are finest
/// about 0.
constexpr double kLongVoxels = 32.0;
/// Of what is linear in floats, over a leaf.
constexpr double kReachRounding = 1e-4;
constexpr float kNoSide = -1e12F;

/// A unit vector across another.
Vec3 any_across(const Vec3& unit) noexcept {
  const Vec3 axis = std::abs(unit.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  return normalized(cross(unit, axis));
}

double snapped(double value) noexcept { return (value + kSnapping) - kSnapping; }

}  // namespace

FlatTriangle::FlatTriangle(const Vec3& a, const Vec3& b, const Vec3& c, double voxel_mm) noexcept
    : voxel_mm_(voxel_mm), corner_mm_{a, b, c} {
  for (const Vec3& corner : corner_mm_) bounds_mm_.include(corner);
  const auto square = [](const Vec3& v) { return dot(v, v); };
  const double ab = square(b - a);
  const double bc = square(c - b);
  const double ca = square(a - c);
  if (bc > ab && bc >= ca) {
    corner_mm_ = {b, c, a};
  } else if (ca > ab) {
    corner_mm_ = {c, a, b};
  }
  const Vec3 base = corner_mm_[1] - corner_mm_[0];
  const Vec3 side = corner_mm_[2] - corner_mm_[0];
  const Vec3 along = normalized(base);
  const Vec3 area = cross(base, side);
  const Vec3 across_base = area - along * dot(area, along);
  normal_ = dot(across_base, across_base) > 0.0 ? normalized(across_base) : any_across(along);
  const Vec3 up = cross(normal_, along);
  // The sides in the plane of `along` and `up`.
  const double length = dot(base, along);
  const double x = dot(side, along);
  const double y = std::max(dot(side, up), 0.0);
  const std::array<std::pair<double, double>, 3> sides{{{length, 0.0}, {x - length, y}, {-x, -y}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [dx, dy] = sides[i];
    const double size = std::sqrt(dx * dx + dy * dy);
    length_voxels_[i] = size / voxel_mm;
    if (!(size > 0.0)) {
      outward_[i] = along_[i] = Vec3{};
      continue;
    }
    along_[i] = along * (dx / size) + up * (dy / size);
    outward_[i] = along * (dy / size) - up * (dx / size);
  }
}

Vec3 FlatTriangle::offset_from(std::size_t corner, const Vec3& point_mm) const noexcept {
  const Vec3 offset = (point_mm - corner_mm_[corner]) / voxel_mm_;
  return {snapped(offset.x), snapped(offset.y), snapped(offset.z)};
}

LatticeFunction FlatTriangle::function(const Vec3& unit, const Vec3& offset) noexcept {
  return {static_cast<float>(dot(unit, offset)),
          {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z)}};
}

bool FlatTriangle::may_reach(const Vec3& middle_mm, double half_voxels,
                             double reach_voxels) const noexcept {
  const auto most = [&](const Vec3& unit) {
    return reach_voxels + kReachRounding +
           half_voxels * (std::abs(unit.x) + std::abs(unit.y) + std::abs(unit.z));
  };
  const Vec3 first = (middle_mm - corner_mm_[0]) / voxel_mm_;
  if (std::abs(dot(normal_, first)) > most(normal_)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 offset = (middle_mm - corner_mm_[i]) / voxel_mm_;
    if (dot(outward_[i], offset) > most(outward_[i])) return false;
  }
  return true;
}

FlatTriangle::Ball FlatTriangle::ball_from(const Vec3& origin_mm) const noexcept {
  // Around the middle of the longest side: of an obtuse triangle no ball is smaller.
  const Vec3 middle = (corner_mm_[0] + corner_mm_[1]) * 0.5;
  const Vec3 at = (middle - origin_mm) / voxel_mm_;
  const double radius =
      std::max(0.5 * length_voxels_[0], length(corner_mm_[2] - middle) / voxel_mm_);
  constexpr double kRounding = 1.0 + 1e-6;
  return {{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)},
          static_cast<float>(radius * kRounding)};
}

LeafTriangle FlatTriangle::seen_from(const Vec3& origin_mm, double reach_voxels) const noexcept {
  constexpr double kMiddle = 0.5 * (kLeafSide - 1);
  LeafTriangle seen;
  seen.height = function(normal_, offset_from(0, origin_mm));
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 offset = offset_from(i, origin_mm);
    seen.beyond[i] = function(outward_[i], offset);
    const double length = length_voxels_[i];
    if (!(length > 0.0)) seen.beyond[i].first = kNoSide;
    const Vec3& unit = along_[i];
    const double middle = dot(unit, offset) + kMiddle * (unit.x + unit.y + unit.z);
    const bool is_by_end = length > kLongVoxels && middle > 0.5 * length;
    seen.along[i] = function(unit, is_by_end ? offset_from((i + 1) % 3, origin_mm) : offset);
    seen.from[i] = is_by_end ? -static_cast<float>(length) : 0.0F;
    seen.to[i] = is_by_end ? 0.0F : static_cast<float>(length);
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double low = (bounds_mm_.min[axis] - origin_mm[axis]) / voxel_mm_ - reach_voxels;
    const double high = (bounds_mm_.max[axis] - origin_mm[axis]) / voxel_mm_ + reach_voxels;
    seen.first[axis] =
        static_cast<int>(std::clamp(std::floor(low), 0.0, static_cast<double>(kLeafSide)));
    seen.last[axis] =
        static_cast<int>(std::clamp(std::ceil(high), -1.0, static_cast<double>(kLeafSide - 1)));
  }
  return seen;
}

}  // namespace argil
