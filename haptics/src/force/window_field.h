// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "argil/core/field_window.h"
#include "argil/core/vec3.h"

namespace argil::haptics {

/// Whether the window has as many values as nodes; for asserts.
inline bool is_consistent(const FieldWindowView& window) noexcept {
  std::size_t nodes = 1;
  for (const int along : window.nodes) nodes *= static_cast<std::size_t>(along);
  return window.distance_mm.size() == nodes;
}

/// grad phi at a node by central differences, one-sided on the faces of the window, which has at
/// least 2 nodes along each axis. No unit: mm/mm.
Vec3 node_gradient(const FieldWindowView& window, int i, int j, int k) noexcept;

/// phi and grad phi at a position, both trilinear between the nodes, so that the gradient is
/// continuous and second-order accurate (the gradient of the trilinear phi itself is neither).
struct FieldSample {
  double phi_mm = 0.0;
  Vec3 gradient;
  bool inside = false;  ///< false: the position is outside the window, or not finite; all is zero
};
FieldSample sample_field(const FieldWindowView& window, const Vec3& position_mm) noexcept;

/// Whether a position lies in the box of the window's nodes; false for NaN.
bool is_inside(const FieldWindowView& window, const Vec3& position_mm) noexcept;

/// phi tricubic (Catmull-Rom) and its own gradient. Not inside where one of its 4^3 nodes is
/// missing.
FieldSample sample_cubic(const FieldWindowView& window, const Vec3& position_mm) noexcept;

}  // namespace argil::haptics
