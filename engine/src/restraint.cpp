// SPDX-License-Identifier: GPL-3.0-or-later
#include "restraint.h"

#include <algorithm>
#include <cmath>

namespace argil {

Restraint::Restraint(const Mask* mask, const Box3& box_mm) : mask_(mask) {
  if (mask_ == nullptr || mask_->is_zero_in(box_mm)) {
    mask_ = nullptr;
    return;
  }
  slope_per_mm_ = mask_->slope_in(box_mm);
}

Vec3 Restraint::along(const Vec3& from, const Vec3& way) const {
  if (mask_ == nullptr || way == Vec3{}) return from + way;
  constexpr double kMostSlides = 256.0;
  const double wanted = std::ceil(2.0 * slope_per_mm_ * length(way));
  const double steps = std::clamp(wanted, 1.0, kMostSlides);
  double gone = 0.0;
  bool is_held = false;
  for (double step = 0.0; step < steps; step += 1.0) {
    const double held = mask_->at(from + gone * way);
    is_held = is_held || held > 0.0;
    gone += (1.0 - held) / steps;
  }
  // Free ways end in the bits they have without a mask.
  if (!is_held) return from + way;
  return gone == 0.0 ? from : from + gone * way;
}

}  // namespace argil
