// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/camera.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace argil::viewer {
namespace {

/// Limits of the distance to the target: what float depth and float vertices still resolve.
constexpr double kNearestMm = 1e-3;
constexpr double kFarthestMm = 1e6;
/// What a frame leaves free around its content.
constexpr double kFrameMargin = 1.05;

/// Rodrigues' rotation of `v` about a unit axis.
Vec3 turned(const Vec3& v, const Vec3& axis, double angle) noexcept {
  assert(std::abs(length(axis) - 1.0) < 1e-6);
  const double c = std::cos(angle);
  return c * v + std::sin(angle) * cross(axis, v) + (1.0 - c) * dot(axis, v) * axis;
}

/// Corner 0 to 7 of a box: bit n of the number chooses the larger end along axis n.
Vec3 corner_of(const Box3& box, unsigned corner) noexcept {
  return {(corner & 1U) != 0 ? box.max.x : box.min.x, (corner & 2U) != 0 ? box.max.y : box.min.y,
          (corner & 4U) != 0 ? box.max.z : box.min.z};
}

/// The nearest and farthest a box reaches along the view, from the eye.
std::pair<double, double> depths(const Box3& box, const Vec3& eye, const Vec3& back) noexcept {
  double least = kFarthestMm;
  double most = -kFarthestMm;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const double depth = dot(eye - corner_of(box, corner), back);
    least = std::min(least, depth);
    most = std::max(most, depth);
  }
  return {least, most};
}

}  // namespace

Matrix Lens::view() const noexcept {
  Matrix m{};
  // The rows of the rotation are the camera's axes; the matrix is stored column by column.
  const Vec3* rows[3] = {&right, &up, &back};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      m[4 * column + row] = static_cast<float>((*rows[row])[column]);
    }
    m[12 + row] = static_cast<float>(-dot(*rows[row], eye_mm));
  }
  m[15] = 1.0F;
  return m;
}

Matrix Lens::projection() const noexcept {
  Matrix m{};
  assert(tan_x > 0.0 && tan_y > 0.0 && far_mm > near_mm);
  m[0] = static_cast<float>(1.0 / tan_x);
  m[5] = static_cast<float>(1.0 / tan_y);
  // In perspective what is shifted grows with the distance, and so does the clip space's w.
  m[is_parallel ? 12 : 8] = static_cast<float>((is_parallel ? -1.0 : 1.0) * shift_x / tan_x);
  m[is_parallel ? 13 : 9] = static_cast<float>((is_parallel ? -1.0 : 1.0) * shift_y / tan_y);
  // OpenGL's clip space: depth -1 at the near plane to 1 at the far plane.
  const double span = far_mm - near_mm;
  if (is_parallel) {
    m[10] = static_cast<float>(-2.0 / span);
    m[14] = static_cast<float>(-(far_mm + near_mm) / span);
    m[15] = 1.0F;
  } else {
    m[10] = static_cast<float>(-(far_mm + near_mm) / span);
    m[11] = -1.0F;
    m[14] = static_cast<float>(-2.0 * far_mm * near_mm / span);
  }
  return m;
}

Lens cropped(const Lens& lens, double left, double right, double bottom, double top) noexcept {
  assert(right > left && top > bottom);
  Lens part = lens;
  part.shift_x += lens.tan_x * (left + right - 1.0);
  part.shift_y += lens.tan_y * (bottom + top - 1.0);
  part.tan_x *= right - left;
  part.tan_y *= top - bottom;
  return part;
}

void Camera::resize(int width, int height) noexcept {
  width_ = std::max(width, 1);
  height_ = std::max(height, 1);
}

void Camera::orbit(double dx_pixels, double dy_pixels) noexcept {
  // Sideways about the vertical axis and not about the picture's own, so that the piece stays
  // upright.
  const double per_pixel = std::numbers::pi / width_;
  const Vec3 z{0.0, 0.0, 1.0};
  const double turn = -dx_pixels * per_pixel;
  right_ = turned(right_, z, turn);
  back_ = turned(back_, z, turn);
  // Over the poles the picture would stand on its head; at them rounding decides.
  constexpr double kMostTilt = 0.5 * std::numbers::pi - 1e-6;
  const double tilt = std::asin(std::clamp(back_.z, -1.0, 1.0));
  const double wanted = std::clamp(tilt + dy_pixels * per_pixel, -kMostTilt, kMostTilt);
  back_ = normalized(turned(back_, right_, tilt - wanted));
  up_ = normalized(cross(back_, right_));
  right_ = normalized(cross(up_, back_));
}

double Camera::half_height() const noexcept { return std::tan(0.5 * field_of_view_rad_); }

void Camera::pan(double dx_pixels, double dy_pixels) noexcept {
  const double mm = pixel_mm_at(target_mm_);
  target_mm_ += -dx_pixels * mm * right_ + dy_pixels * mm * up_;
}

void Camera::zoom(double factor, const Pixel& at) noexcept {
  assert(factor > 0.0);
  const double to = std::clamp(distance_mm_ / factor, kNearestMm, kFarthestMm);
  const double shrink = to / distance_mm_;
  // The point of the target's plane that is under the pixel stays there.
  const double mm = pixel_mm_at(target_mm_);
  const Vec3 under =
      target_mm_ + (at.x - 0.5 * width_) * mm * right_ - (at.y - 0.5 * height_) * mm * up_;
  target_mm_ = under + shrink * (target_mm_ - under);
  distance_mm_ = to;
}

void Camera::look_from(const Vec3& toward, const Vec3& up) noexcept {
  assert(std::abs(length(toward) - 1.0) < 1e-6 && length(cross(up, toward)) > 0.0);
  back_ = normalized(toward);
  right_ = normalized(cross(up, back_));
  up_ = cross(back_, right_);
}

void Camera::frame(const Box3& box_mm, double width_share, double height_share) noexcept {
  assert(width_share > 0.0 && width_share <= 1.0 && height_share > 0.0 && height_share <= 1.0);
  if (!(length(box_mm.size()) > 0.0)) return;
  target_mm_ = box_mm.center();
  // Far enough for each corner of the box to be seen.
  const double tan_y = height_share * half_height();
  const double tan_x = width_share * half_height() * width_ / height_;
  double distance = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 p = corner_of(box_mm, corner) - target_mm_;
    const double across = std::max(std::abs(dot(p, right_)) / tan_x, std::abs(dot(p, up_)) / tan_y);
    distance = std::max(distance, across + (is_parallel_ ? 0.0 : dot(p, back_)));
  }
  distance_mm_ = std::clamp(kFrameMargin * distance, kNearestMm, kFarthestMm);
}

/// Toed in: both eyes look at the target and keep their own frames. At a few degrees the difference
/// from shifted parallel axes is not seen.
Camera Camera::eye(double offset) const noexcept {
  assert(std::isfinite(offset));
  Camera eye = *this;
  const Vec3 from_target = distance_mm_ * (back_ + offset * right_);
  eye.distance_mm_ = length(from_target);
  eye.back_ = normalized(from_target);
  eye.right_ = normalized(cross(up_, eye.back_));
  eye.up_ = cross(eye.back_, eye.right_);
  return eye;
}

Lens Camera::lens(const Box3& content_mm) const noexcept {
  Lens lens;
  const Vec3 eye = eye_mm();
  lens.back = back_;
  lens.right = right_;
  lens.up = up_;
  lens.eye_mm = eye;
  lens.is_parallel = is_parallel_;
  lens.tan_y = half_height() * (is_parallel_ ? distance_mm_ : 1.0);
  lens.tan_x = lens.tan_y * width_ / height_;
  const bool has_content = length(content_mm.size()) > 0.0;
  auto [near, far] = has_content ? depths(content_mm, eye, lens.back)
                                 : std::pair{0.5 * distance_mm_, 2.0 * distance_mm_};
  // A margin of 2 %, so that nothing is clipped by rounding; content behind the eye still needs a
  // range to be drawn in.
  far = std::max(1.02 * far, 2e-3 * distance_mm_);
  // Never nearer than a thousandth of the far plane, or the depth buffer loses its precision.
  lens.near_mm = is_parallel_ ? near - 0.02 * std::abs(near) : std::max(0.98 * near, 1e-3 * far);
  lens.far_mm = std::max(far, lens.near_mm + 1e-3 * distance_mm_);
  assert(lens.far_mm > lens.near_mm);
  return lens;
}

Ray Camera::ray_at(const Pixel& pixel) const noexcept {
  const double y = half_height() * (1.0 - 2.0 * pixel.y / height_);
  const double x = half_height() * (2.0 * pixel.x / width_ - 1.0) * width_ / height_;
  if (is_parallel_) {
    // From far enough back that nothing lies behind it.
    return {eye_mm() + distance_mm_ * (x * right_ + y * up_) + 100.0 * distance_mm_ * back_,
            -back_};
  }
  return {eye_mm(), normalized(x * right_ + y * up_ - back_)};
}

double Camera::pixel_mm_at(const Vec3& point_mm) const noexcept {
  const double depth = is_parallel_ ? distance_mm_ : std::abs(dot(eye_mm() - point_mm, back_));
  return 2.0 * half_height() * depth / height_;
}

Camera::Pixel Camera::pixel_of(const Vec3& point_mm) const noexcept {
  const Vec3 from = point_mm - eye_mm();
  const double depth = is_parallel_ ? distance_mm_ : std::max(-dot(from, back_), 1e-9);
  const double over = half_height() * depth;
  return {0.5 * width_ + 0.5 * height_ * dot(from, right_) / over,
          0.5 * height_ - 0.5 * height_ * dot(from, up_) / over};
}

DisplayView Camera::display_view() const noexcept {
  DisplayView view;
  view.eye_mm = eye_mm();
  // The size of a pixel: an angle in perspective, a length in a parallel lens.
  const double per_distance = 2.0 * half_height() / height_;
  if (is_parallel_) {
    view.pixel_mm = per_distance * distance_mm_;
  } else {
    view.pixel_rad = per_distance;
  }
  return view;
}

}  // namespace argil::viewer
