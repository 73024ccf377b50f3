// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "argil/core/vec3.h"
#include "argil/engine/pick.h"

#include "picture/camera.h"

namespace argil::viewer {

/// A picture in the window and the camera that sees it: all of the window, or in stereo the half of
/// an eye.
struct WindowPart {
  Camera camera;        ///< of this part's own size
  std::size_t eye = 0;  ///< which picture, from left to right
  int left = 0;         ///< the column of the window where it begins

  /// A pixel of the window as the part's camera counts; outside of the part: beyond its edges.
  Camera::Pixel inside(const Camera::Pixel& pixel) const noexcept {
    return {pixel.x - left, pixel.y};
  }
  /// What the eye sees at a pixel of the window.
  Ray ray_at(const Camera::Pixel& pixel) const noexcept { return camera.ray_at(inside(pixel)); }
};

/// How many columns of a window are the left eye's; the rest, at least one, are the right eye's.
inline int left_half(int width) noexcept { return std::max(width / 2, 1); }

/// The pictures of a window that `camera` fills: one, or in stereo those of two eyes, side by side.
std::vector<WindowPart> parts_of(const Camera& camera, bool is_stereo);

/// The picture that a pixel of the window lies in: whoever points there means what that eye sees.
/// Beyond the window's edges the nearest.
WindowPart part_at(const Camera& camera, bool is_stereo, const Camera::Pixel& pixel);

/// Where the camera between the eyes shows the point of the target's plane that an eye shows at a
/// pixel: for Camera::zoom.
Camera::Pixel between_eyes(const Camera& camera, bool is_stereo, const Camera::Pixel& pixel);

/// The part of the window that no panel lies over, in pixels.
struct FreeRoom {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;
};

/// Camera::frame: all of a box in each picture of the window. With `room` within that: its middle
/// stays that of the picture, about which the view turns, and it is as large as the nearer panel
/// leaves it, though never less than a quarter.
void frame_in_each(Camera& camera, bool is_stereo, const Box3& box_mm,
                   const std::optional<FreeRoom>& room = {});

}  // namespace argil::viewer
