// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/stereo.h"

#include <cassert>

namespace argil::viewer {
namespace {

/// Half the distance of the eyes, of that to the target.
constexpr double kHalfEyes = 0.03;

WindowPart eye_of(const Camera& camera, double offset, std::size_t eye, int left, int right) {
  WindowPart part{camera.eye(offset), eye, left};
  part.camera.resize(right - left, camera.height());
  return part;
}

}  // namespace

std::vector<WindowPart> parts_of(const Camera& camera, bool is_stereo) {
  if (!is_stereo) return {WindowPart{camera}};
  const int half = left_half(camera.width());
  return {eye_of(camera, -kHalfEyes, 0, 0, half),
          eye_of(camera, kHalfEyes, 1, half, camera.width())};
}

WindowPart part_at(const Camera& camera, bool is_stereo, const Camera::Pixel& pixel) {
  const std::vector<WindowPart> parts = parts_of(camera, is_stereo);
  assert(!parts.empty());
  return pixel.x < parts.back().left ? parts.front() : parts.back();
}

Camera::Pixel between_eyes(const Camera& camera, bool is_stereo, const Camera::Pixel& pixel) {
  if (!is_stereo) return pixel;
  const Ray ray = part_at(camera, is_stereo, pixel).ray_at(pixel);
  const Lens lens = camera.lens({});
  const Vec3 target = camera.target_mm();
  const double along = dot(target - ray.origin_mm, lens.back) / dot(ray.direction, lens.back);
  const Vec3 beside = ray.origin_mm + along * ray.direction - target;
  const double mm = camera.pixel_mm_at(target);
  return {0.5 * camera.width() + dot(beside, lens.right) / mm,
          0.5 * camera.height() - dot(beside, lens.up) / mm};
}

void frame_in_each(Camera& camera, bool is_stereo, const Box3& box_mm) {
  const int width = camera.width();
  if (is_stereo) camera.resize(left_half(width), camera.height());
  camera.frame(box_mm);
  camera.resize(width, camera.height());
}

}  // namespace argil::viewer
