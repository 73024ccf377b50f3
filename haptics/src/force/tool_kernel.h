// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "argil/core/vec3.h"
#include "argil/haptics/force/tool_force.h"

namespace argil::haptics {

/// The kernel of a tool at one point, in the tool's frame, not divided by the kernel's integral.
struct KernelValue {
  double weight = 0.0;
  Vec3 slope;  ///< its gradient, 1 / mm
  Vec3 twist;  ///< q x slope: zero for a ball, exactly
};

/// The smooth body that a tool is felt as. With t = 1 - (distance from the middle / reach)^2:
/// ellipsoid t^4, reach 1.61 radii; capsule t^4 about its axis; box the product of t^3 over its
/// axes, reach 1.73 half sides. Each has the second moment of the uniform body (the capsule's ends
/// and, within 7 %, its middle).
class ToolKernel {
 public:
  /// `tool`: only its shape and radii count.
  explicit ToolKernel(const ForceTool& tool) noexcept;

  /// The kernel at q. False where the kernel is zero.
  bool at(const Vec3& q, KernelValue& out) const noexcept;

  /// Half extents of the support along the tool's axes.
  const Vec3& reach_mm() const noexcept { return reach_mm_; }
  /// How far it reaches along the axes of the world, given the tool's axes there.
  Vec3 extent_mm(const std::array<Vec3, 3>& axes) const noexcept;
  /// Half length of the capsule's axis, else 0.
  double segment_mm() const noexcept { return segment_mm_; }
  /// The integral of the weight.
  double integral_mm3() const noexcept;
  /// Volume of the support: samples on a lattice = this / voxel^3.
  double support_mm3() const noexcept;

 private:
  ToolShape shape_;
  Vec3 reach_mm_;
  Vec3 inverse_square_;
  double segment_mm_ = 0.0;
};

/// The tool's axes in the world's frame.
std::array<Vec3, 3> axes_of(const Quat& orientation) noexcept;

}  // namespace argil::haptics
