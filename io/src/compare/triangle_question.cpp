// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/triangle_question.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace argil::io {
namespace {

/// Of the bound: boxes so small are not cut any more.
constexpr double kLeastBoxShare = 0.02;

/// Half the width of a box across planes with that normal.
double half_width(const Vec3& normal, const Vec3& half) noexcept {
  return std::abs(normal.x) * half.x + std::abs(normal.y) * half.y + std::abs(normal.z) * half.z;
}

/// Whether a triangle has an area to speak of: rounding does not turn its normal.
bool has_area(const mesh::Corners& c) noexcept {
  constexpr double kLeastShape = 1e-9;
  const double side = mesh::longest_side(c);
  return length(mesh::area_normal(c)) > kLeastShape * side * side;
}

Vec3 longest_way(const mesh::Corners& c) noexcept {
  Vec3 longest;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 along = c[(k + 1) % 3] - c[k];
    if (dot(along, along) > dot(longest, longest)) longest = along;
  }
  return longest;
}

/// Of unit length; of a triangle without an area to speak of any across its longest side.
Vec3 unit_normal(const mesh::Corners& c) noexcept {
  if (has_area(c)) return normalized(mesh::area_normal(c));
  const Vec3 longest = longest_way(c);
  const Vec3 size{std::abs(longest.x), std::abs(longest.y), std::abs(longest.z)};
  if (size.x <= std::min(size.y, size.z)) return normalized(cross(longest, {1.0, 0.0, 0.0}));
  if (size.y <= size.z) return normalized(cross(longest, {0.0, 1.0, 0.0}));
  return normalized(cross(longest, {0.0, 0.0, 1.0}));
}

}  // namespace

TriangleQuestion::TriangleQuestion(double bound_mm, double voxel_mm, FieldSampler& field)
    : bound_mm_(bound_mm), voxel_mm_(voxel_mm), field_(field) {
  assert(bound_mm > 0.0 && voxel_mm > 0.0);
}

void TriangleQuestion::take(const mesh::Corners& corners) {
  corners_ = corners;
  normal_ = unit_normal(corners);
  is_sliver_ = !has_area(corners);
  box_ = {};
  off_mm_ = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    box_.include(corners[k]);
    off_mm_ = std::max(off_mm_, std::abs(dot(normal_, corners[k] - corners[0])));
    inward_[k] = cross(normal_, corners[(k + 1) % 3] - corners[k]);
  }
}

bool TriangleQuestion::is_near(const mesh::Corners& corners) {
  take(corners);
  const double per_mm = 1.0 / voxel_mm_;
  const TriangleCells cells({per_mm * corners[0], per_mm * corners[1], per_mm * corners[2]});
  return cells.for_each([this](const CellIndex& index) { return is_cell_near(index); });
}

bool TriangleQuestion::is_cell_near(const CellIndex& index) {
  Around at;
  at.middle_mm = voxel_mm_ * Vec3{index[0] + 0.5, index[1] + 0.5, index[2] + 0.5};
  const FieldCell cell = field_.cell_at(at.middle_mm);
  at.fraction = cell.fraction;
  at.per_mm = cell.per_mm;
  at.phi = Trilinear(cell.corners);
  at.slope = cell.per_mm * dot(normal_, at.phi.slope(cell.fraction));
  const double half = 0.5 * voxel_mm_;
  return is_box_near(at, at.middle_mm, {half, half, half});
}

/// Whether the triangle may have a point in a box: it is not all to one side of the plane or beyond
/// a side of the triangle.
bool TriangleQuestion::may_pass(const Vec3& middle_mm, const Vec3& half_mm) const {
  const Vec3 from = middle_mm - corners_[0];
  if (std::abs(dot(normal_, from)) > half_width(normal_, half_mm) + off_mm_) return false;
  // No side tells of a sliver: its normal may be that of the other order of its corners.
  if (is_sliver_) return may_pass_sliver(middle_mm, half_mm);
  for (std::size_t k = 0; k < 3; ++k) {
    const double within = dot(inward_[k], middle_mm - corners_[k]);
    const double rounding = 1e-12 * dot(inward_[k], inward_[k]);
    if (within + half_width(inward_[k], half_mm) < -rounding) return false;
  }
  return true;
}

/// By the three sides, none of which a sliver leaves by more than it is thick.
bool TriangleQuestion::may_pass_sliver(const Vec3& middle_mm, const Vec3& half_mm) const {
  constexpr double kThick = 1e-8;  // of its length
  const double reach = length(half_mm) + kThick * length(longest_way(corners_));
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 along = corners_[(k + 1) % 3] - corners_[k];
    const double square = dot(along, along);
    const Vec3 from = middle_mm - corners_[k];
    const double part = square > 0.0 ? std::clamp(dot(from, along) / square, 0.0, 1.0) : 0.0;
    if (length(from - part * along) <= reach) return true;
  }
  return false;
}

bool TriangleQuestion::is_box_near(const Around& at, const Vec3& middle_mm,
                                   const Vec3& half_mm) const {
  const double plane = at.slope * dot(normal_, middle_mm - corners_[0]);
  const Vec3 rise =
      at.slope * Vec3{normal_.x * half_mm.x, normal_.y * half_mm.y, normal_.z * half_mm.z};
  double most = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 way{(corner & 4) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                   (corner & 1) != 0 ? 1.0 : -1.0};
    const Vec3 p = middle_mm + Vec3{way.x * half_mm.x, way.y * half_mm.y, way.z * half_mm.z};
    most = std::max(most, std::abs(at.phi_at(p) - plane - dot(way, rise)));
  }
  if (most + std::abs(at.slope) * off_mm_ <= bound_mm_) return true;
  if (!may_pass(middle_mm, half_mm)) return true;
  const double side = 2.0 * std::max({half_mm.x, half_mm.y, half_mm.z});
  if (side <= kLeastBoxShare * bound_mm_) return false;
  // Only what lies in the triangle's own box.
  Box3 part;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    part.min[axis] = std::max(middle_mm[axis] - half_mm[axis], box_.min[axis]);
    part.max[axis] = std::min(middle_mm[axis] + half_mm[axis], box_.max[axis]);
    if (part.min[axis] > part.max[axis]) return true;
  }
  const Vec3 quarter = 0.25 * part.size();
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3 shift{(octant & 4) != 0 ? quarter.x : -quarter.x,
                     (octant & 2) != 0 ? quarter.y : -quarter.y,
                     (octant & 1) != 0 ? quarter.z : -quarter.z};
    if (!is_box_near(at, part.center() + shift, quarter)) return false;
  }
  return true;
}

}  // namespace argil::io
