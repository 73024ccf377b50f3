// SPDX-License-Identifier: GPL-3.0-or-later
// Explicit Euler steps along the displacement, with the mask at their beginning.
#include "brush/masked_displacement.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil {

MaskedDisplacement::MaskedDisplacement(const Mask* mask, const Box3& box_mm) : mask_(mask) {
  if (mask_ == nullptr || mask_->is_zero_in(box_mm)) {
    mask_ = nullptr;
    return;
  }
  slope_per_mm_ = mask_->slope_in(box_mm);
}

Vec3 MaskedDisplacement::along(const Vec3& from, const Vec3& displacement) const {
  if (mask_ == nullptr || displacement == Vec3{}) return from + displacement;
  assert(is_finite(from) && is_finite(displacement));
  constexpr double kMostMaskSteps = 256.0;
  const double wanted = std::ceil(2.0 * slope_per_mm_ * length(displacement));
  const double steps = std::clamp(wanted, 1.0, kMostMaskSteps);
  double gone = 0.0;
  bool is_masked = false;
  for (double step = 0.0; step < steps; step += 1.0) {
    const double masked = mask_->at(from + gone * displacement);
    is_masked = is_masked || masked > 0.0;
    gone += (1.0 - masked) / steps;
  }
  // Free displacements end in the bits they have without a mask.
  if (!is_masked) return from + displacement;
  return gone == 0.0 ? from : from + gone * displacement;
}

}  // namespace argil
