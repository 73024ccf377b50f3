// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/stereo.h"

#include <algorithm>
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

/// What of half a side is free where panels begin so far beyond its end, or before it (below 0).
double share_of_half(double beyond, int side) {
  constexpr double kLeastShare = 0.25;
  const double half = 0.5 * side;
  return std::clamp((half + beyond) / half, kLeastShare, 1.0);
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

void frame_in_each(Camera& camera, bool is_stereo, const Box3& box_mm,
                   const std::optional<FreeRoom>& room) {
  const int width = camera.width();
  const FreeRoom free = room.value_or(FreeRoom{0.0, 0.0, 1.0 * width, 1.0 * camera.height()});
  const WindowPart first = parts_of(camera, is_stereo).front();
  const WindowPart last = parts_of(camera, is_stereo).back();
  const double width_share =
      std::min(share_of_half(first.left - free.left, first.camera.width()),
               share_of_half(free.right - last.left - last.camera.width(), last.camera.width()));
  const double height_share =
      std::min(share_of_half(-free.top, camera.height()),
               share_of_half(free.bottom - camera.height(), camera.height()));
  if (is_stereo) camera.resize(left_half(width), camera.height());
  camera.frame(box_mm, width_share, height_share);
  camera.resize(width, camera.height());
}

}  // namespace argil::viewer
