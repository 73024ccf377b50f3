// SPDX-License-Identifier: GPL-3.0-or-later
#include "force/tool_kernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "math/unit.h"

namespace argil::haptics {
namespace {

// Notation, in the tool's frame: q a point, d the inverse squares of the reach along each axis, t =
// 1 - sum of d q^2 the profile that the kernel is a power of. A capsule's axis runs from -segment
// to +segment along z; `bend` is the point of it that is nearest to q, and `arm` leads from there
// to q.

constexpr double kPi = std::numbers::pi;
/// Integrals of the profiles over their unit supports: (1 - r^2)^4 over the ball and the disc, (1 -
/// x^2)^3 over [-1, 1].
constexpr double kBallIntegral = 4.0 * kPi / 3.0 * 128.0 / 1155.0;
constexpr double kDiscIntegral = kPi / 5.0;
constexpr double kLineIntegral = 32.0 / 35.0;

constexpr double component_product(const Vec3& v) noexcept { return v.x * v.y * v.z; }

}  // namespace

ToolKernel::ToolKernel(const ForceTool& tool) noexcept : shape_(tool.shape) {
  assert(tool.radii_mm.x > 0.0 && tool.radii_mm.y > 0.0 && tool.radii_mm.z > 0.0);
  const double support = shape_ == ToolShape::box ? kBoxSupport : kKernelSupport;
  reach_mm_ = support * tool.radii_mm;
  if (shape_ == ToolShape::capsule) {
    segment_mm_ = std::max(tool.radii_mm.z - tool.radii_mm.x, 0.0);
    reach_mm_.y = reach_mm_.x;
    reach_mm_.z = reach_mm_.x + segment_mm_;
  }
  const Vec3 scale =
      shape_ == ToolShape::capsule ? Vec3{reach_mm_.x, reach_mm_.x, reach_mm_.x} : reach_mm_;
  inverse_square_ = {1.0 / (scale.x * scale.x), 1.0 / (scale.y * scale.y),
                     1.0 / (scale.z * scale.z)};
}

bool ToolKernel::at(const Vec3& q, KernelValue& out) const noexcept {
  const Vec3& d = inverse_square_;
  if (shape_ == ToolShape::box) {
    const Vec3 t{1.0 - q.x * q.x * d.x, 1.0 - q.y * q.y * d.y, 1.0 - q.z * q.z * d.z};
    if (!(t.x > 0.0 && t.y > 0.0 && t.z > 0.0)) return false;
    const double square = component_product(t) * component_product(t);
    out.weight = square * component_product(t);
    out.slope = {-6.0 * square * t.y * t.z * d.x * q.x, -6.0 * square * t.x * t.z * d.y * q.y,
                 -6.0 * square * t.x * t.y * d.z * q.z};
    out.twist = cross(q, out.slope);
    return true;
  }
  const double bend = std::clamp(q.z, -segment_mm_, segment_mm_);
  const Vec3 arm{q.x, q.y, q.z - bend};
  const double t = 1.0 - (arm.x * arm.x * d.x + arm.y * arm.y * d.y + arm.z * arm.z * d.z);
  if (!(t > 0.0)) return false;
  const double cube = t * t * t;  // of t^4 and its slope, 4 t^3 grad t = -8 t^3 d q
  out.weight = cube * t;
  out.slope = -8.0 * cube * Vec3{d.x * arm.x, d.y * arm.y, d.z * arm.z};
  // q x slope, written so that equal radii give exactly zero.
  const Vec3 turn{arm.y * arm.z * (d.z - d.y), arm.z * arm.x * (d.x - d.z),
                  arm.x * arm.y * (d.y - d.x)};
  out.twist = -8.0 * cube * turn + cross(Vec3{0.0, 0.0, bend}, out.slope);
  return true;
}

Vec3 ToolKernel::extent_mm(const std::array<Vec3, 3>& axes) const noexcept {
  Vec3 extent;
  for (std::size_t world = 0; world < 3; ++world) {
    double sum = 0.0;
    double square = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double part = std::abs(axes[a][world]) * reach_mm_[a];
      sum += part;
      square += part * part;
    }
    extent[world] = shape_ == ToolShape::box ? sum : std::sqrt(square);
    if (shape_ == ToolShape::capsule) {
      extent[world] = reach_mm_.x + std::abs(axes[2][world]) * segment_mm_;
    }
  }
  return extent;
}

double ToolKernel::integral_mm3() const noexcept {
  if (shape_ == ToolShape::box) return component_product(kLineIntegral * reach_mm_);
  const Vec3 ball = reach_mm_ - Vec3{0.0, 0.0, segment_mm_};
  return kBallIntegral * component_product(ball) +
         kDiscIntegral * ball.x * ball.y * 2.0 * segment_mm_;
}

double ToolKernel::support_mm3() const noexcept {
  if (shape_ == ToolShape::box) return 8.0 * component_product(reach_mm_);
  const Vec3 ball = reach_mm_ - Vec3{0.0, 0.0, segment_mm_};
  return kPi * (4.0 / 3.0 * component_product(ball) + 2.0 * ball.x * ball.y * segment_mm_);
}

std::array<Vec3, 3> axes_of(const Quat& orientation) noexcept {
  assert(is_unit(orientation));
  return {rotate(orientation, {1.0, 0.0, 0.0}), rotate(orientation, {0.0, 1.0, 0.0}),
          rotate(orientation, {0.0, 0.0, 1.0})};
}

}  // namespace argil::haptics
