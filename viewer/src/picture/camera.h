// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "argil/core/vec3.h"
#include "argil/engine/display_surface.h"
#include "argil/engine/pick.h"

namespace argil::viewer {

/// A 4 x 4 matrix, column by column, as OpenGL takes it.
using Matrix = std::array<float, 16>;

/// What a renderer needs to know of a camera: where it is, which way it looks, what it shows.
struct Lens {
  Vec3 eye_mm;
  Vec3 right;  ///< unit, as `up` and `back`; the camera looks along -back
  Vec3 up;
  Vec3 back;
  double near_mm = 1.0;
  double far_mm = 1000.0;
  double tan_x = 0.3;  ///< of half the field of view; of a parallel lens half the width in mm
  double tan_y = 0.2;
  bool is_parallel = false;
  // Of a part of a picture: how far its middle lies to the right of and above the way the lens
  // looks, as tan_x has it.
  double shift_x = 0.0;
  double shift_y = 0.0;

  friend bool operator==(const Lens&, const Lens&) = default;

  Matrix view() const noexcept;        ///< from mm to the camera's frame
  Matrix projection() const noexcept;  ///< from there to OpenGL's clip space
};

/// What a lens shows from `left` to `right` and from `bottom` to `top` of its picture, 0 to 1, or
/// beyond. The planes near and far stay.
Lens cropped(const Lens& lens, double left, double right, double bottom, double top) noexcept;

/// The camera turns about a target, as in other modelling programs. z is up.
class Camera {
 public:
  /// Pixels from the picture's upper left corner, y down.
  struct Pixel {
    double x = 0.0;
    double y = 0.0;
  };

  void resize(int width, int height) noexcept;
  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }

  /// Turns so that the surface follows the hand: a drag across the whole width of the picture is
  /// half a turn.
  void orbit(double dx_pixels, double dy_pixels) noexcept;
  /// Moves so that what is at the target's depth follows the hand.
  void pan(double dx_pixels, double dy_pixels) noexcept;
  /// Comes nearer where the factor is above 1; the point under the pixel stays there.
  void zoom(double factor, const Pixel& at) noexcept;

  /// Looks from a direction at the same target: `toward` from the target to the camera, unit
  /// length.
  void look_from(const Vec3& toward, const Vec3& up) noexcept;
  /// All of a box in the picture, from the same direction; or in the part of it about its middle
  /// that is so much of its width and of its height, each above 0 to 1.
  void frame(const Box3& box_mm, double width_share = 1.0, double height_share = 1.0) noexcept;
  void set_target(const Vec3& target_mm) noexcept { target_mm_ = target_mm; }
  void set_parallel(bool is_parallel) noexcept { is_parallel_ = is_parallel; }
  bool is_parallel() const noexcept { return is_parallel_; }
  const Vec3& target_mm() const noexcept { return target_mm_; }
  double distance_mm() const noexcept { return distance_mm_; }

  /// The lens that holds `content_mm` between its near and far plane.
  Lens lens(const Box3& content_mm) const noexcept;

  /// The camera of one eye: moved to the right by this fraction of the distance, and turned to look
  /// at the same target (stereo).
  Camera eye(double offset) const noexcept;

  Ray ray_at(const Pixel& pixel) const noexcept;
  double pixel_mm_at(const Vec3& point_mm) const noexcept;
  /// Where a point is seen, also outside of the picture; the inverse of ray_at. Of a point behind
  /// the eye: far away.
  Pixel pixel_of(const Vec3& point_mm) const noexcept;
  DisplayView display_view() const noexcept;

 private:
  Vec3 eye_mm() const noexcept { return target_mm_ + distance_mm_ * back_; }
  double half_height() const noexcept;  ///< of the picture over the distance

  Vec3 target_mm_;
  double distance_mm_ = 200.0;
  Vec3 right_{1.0, 0.0, 0.0};
  Vec3 up_{0.0, 0.0, 1.0};
  Vec3 back_{0.0, -1.0, 0.0};
  double field_of_view_rad_ = 0.6;
  bool is_parallel_ = false;
  int width_ = 1280;
  int height_ = 800;
};

}  // namespace argil::viewer
