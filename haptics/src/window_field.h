// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/field_window.h"
#include "argil/core/vec3.h"

namespace argil::haptics {

/// grad phi at a node by central differences, one-sided on the faces of the window. No unit: mm/mm.
Vec3 node_gradient(const FieldWindowView& window, int i, int j, int k) noexcept;

/// phi and grad phi at a place, both trilinear between the nodes, so that the gradient is
/// continuous and second-order accurate (the gradient of the trilinear phi itself is neither).
struct FieldSample {
  double phi_mm = 0.0;
  Vec3 gradient;
  bool inside = false;  ///< false: the place lies outside the window, or is not finite; all zero
};
FieldSample sample_field(const FieldWindowView& window, const Vec3& place_mm) noexcept;

}  // namespace argil::haptics
