// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "argil/core/vec3.h"

namespace argil {

/// What of the surface under a tool is too fine for its window: heights of the finest surface over
/// a plane patch, less what of them nodes as far apart as the window's can follow.
///
/// Node (i, j) lies at origin_mm + i * step_x_mm + j * step_y_mm, and heights count along the
/// normal, out of the clay. Trivially copyable, of fixed size: it travels in a WindowSlot.
///
/// Units  mm in the clay's frame.
struct SurfaceDetail {
  static constexpr int kSide = 32;  ///< nodes along each side

  /// There is something to feel: the clay is finer than the window, and its surface is under the
  /// tool. What follows means nothing otherwise.
  bool is_known = false;
  Vec3 origin_mm;  ///< of node (0, 0)
  Vec3 step_x_mm;  ///< the two steps are as long as each other, and at right angles ...
  Vec3 step_y_mm;  ///< ... to each other
  Vec3 normal;     ///< ... and to this, of unit length
  std::array<float, kSide * kSide> height_mm{};  ///< j runs fastest

  float at(int i, int j) const noexcept {
    return height_mm[static_cast<std::size_t>(i) * kSide + static_cast<std::size_t>(j)];
  }
};

}  // namespace argil
