// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "picture/camera.h"

namespace argil::test {

/// Where a camera shows a point, in pixels from the upper left corner; z is its depth in mm along
/// the view, negative behind the camera. The inverse of Camera::ray_at, worked out from the lens.
inline Vec3 projected(const viewer::Camera& camera, const Vec3& point_mm) {
  const viewer::Lens lens = camera.lens({});
  const Vec3 from_eye = point_mm - lens.eye_mm;
  const double depth = -dot(from_eye, lens.back);
  const double over = lens.is_parallel ? 1.0 : depth;
  return {0.5 * camera.width() * (1.0 + dot(from_eye, lens.right) / (over * lens.tan_x)),
          0.5 * camera.height() * (1.0 - dot(from_eye, lens.up) / (over * lens.tan_y)), depth};
}

}  // namespace argil::test
