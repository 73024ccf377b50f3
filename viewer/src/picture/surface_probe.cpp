// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/surface_probe.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace argil::viewer {

SurfaceProbe::SurfaceProbe(DepthMap depth, const WindowPart& part)
    : depth_(std::move(depth)), part_(part) {
  assert(depth_.depth_mm.size() ==
         static_cast<std::size_t>(depth_.width) * static_cast<std::size_t>(depth_.height));
  assert(depth_.is_other.empty() || depth_.is_other.size() == depth_.depth_mm.size());
  // A stroke is about one piece: what covers it is as far away as nothing.
  for (std::size_t n = 0; n < depth_.is_other.size(); ++n) {
    if (depth_.is_other[n] != 0) depth_.depth_mm[n] = std::numeric_limits<float>::infinity();
  }
}

/// The window's pixels may be fewer than the framebuffer's.
Camera::Pixel SurfaceProbe::in_picture(const Camera::Pixel& pixel) const {
  return {part_.inside(pixel).x * depth_.width / part_.camera.width(),
          pixel.y * depth_.height / part_.camera.height()};
}

bool SurfaceProbe::is_other_at(const Camera::Pixel& pixel) const {
  const auto [x, y] = in_picture(pixel);
  if (depth_.is_other.empty() || !(x >= 0.0 && y >= 0.0 && x < depth_.width && y < depth_.height)) {
    return false;
  }
  return depth_.is_other[static_cast<std::size_t>(y) * static_cast<std::size_t>(depth_.width) +
                         static_cast<std::size_t>(x)] != 0;
}

/// The depth interpolated between the four pixels around where they show one surface; across an
/// edge, where a mean would lie on neither surface, that of the nearest pixel.
std::optional<double> SurfaceProbe::depth_at(double x, double y) const {
  if (depth_.width < 2 || depth_.height < 2) return std::nullopt;  // a window of no size
  const double column = std::clamp(x - 0.5, 0.0, depth_.width - 1.0);
  const double row = std::clamp(y - 0.5, 0.0, depth_.height - 1.0);
  if (!(x >= 0.0 && y >= 0.0 && x <= depth_.width && y <= depth_.height)) return std::nullopt;
  const int left = std::min(static_cast<int>(column), depth_.width - 2);
  const int top = std::min(static_cast<int>(row), depth_.height - 2);
  const auto value = [&](int c, int r) {
    return static_cast<double>(
        depth_.depth_mm[static_cast<std::size_t>(r) * static_cast<std::size_t>(depth_.width) +
                        static_cast<std::size_t>(c)]);
  };
  const double u = column - left;
  const double v = row - top;
  const std::array<double, 4> d{value(left, top), value(left + 1, top), value(left, top + 1),
                                value(left + 1, top + 1)};
  const auto [least, most] = std::minmax_element(d.begin(), d.end());
  // Steeper than this within a pixel is an edge in front of something else.
  constexpr double kMostSteps = 8.0;
  const Ray ray = part_.camera.ray_at({x, y});
  const double pixel = part_.camera.pixel_mm_at(ray.origin_mm + *least * ray.direction);
  if (std::isfinite(*most) && *most - *least < kMostSteps * pixel) {
    return (1.0 - v) * ((1.0 - u) * d[0] + u * d[1]) + v * ((1.0 - u) * d[2] + u * d[3]);
  }
  const double nearest = d[(v < 0.5 ? 0U : 2U) + (u < 0.5 ? 0U : 1U)];
  if (!std::isfinite(nearest)) return std::nullopt;
  return nearest;
}

std::optional<Vec3> SurfaceProbe::position_at(double x, double y) const {
  const auto depth = depth_at(x, y);
  if (!depth) return std::nullopt;
  // The lens of any content: its planes near and far do not matter to a ray.
  const Lens lens = part_.camera.lens({});
  const double sx = 2.0 * x / depth_.width - 1.0;
  const double sy = 1.0 - 2.0 * y / depth_.height;
  const double over = lens.is_parallel ? 1.0 : *depth;
  return lens.eye_mm - *depth * lens.back + over * (sx * lens.tan_x * lens.right) +
         over * (sy * lens.tan_y * lens.up);
}

std::optional<SurfaceHit> SurfaceProbe::at(const Camera::Pixel& pixel, double radius_mm) const {
  assert(radius_mm >= 0.0);
  const Camera& camera = part_.camera;
  const auto [x, y] = in_picture(pixel);
  const auto middle = position_at(x, y);
  if (!middle) return std::nullopt;
  const double mm = camera.pixel_mm_at(*middle) * camera.height() / depth_.height;
  const double reach = std::clamp(0.6 * radius_mm / mm, 1.5, 0.25 * depth_.height);
  constexpr int kSpokes = 12;
  std::array<std::optional<Vec3>, kSpokes> circle;
  for (int n = 0; n < kSpokes; ++n) {
    const double angle = 2.0 * std::numbers::pi * n / kSpokes;
    const auto point = position_at(x + reach * std::cos(angle), y + reach * std::sin(angle));
    // What lies far off in depth is another surface.
    if (point && length(*point - *middle) < 4.0 * reach * mm)
      circle[static_cast<std::size_t>(n)] = point;
  }
  // The area vector of the fan about the middle: large triangles count for more.
  Vec3 sum;
  for (std::size_t n = 0; n < kSpokes; ++n) {
    const auto& a = circle[n];
    const auto& b = circle[(n + 1) % kSpokes];
    if (a && b) sum += cross(*b - *middle, *a - *middle);
  }
  SurfaceHit hit{*middle, normalized(sum)};
  // Too few points around, or a normal that looks away, which nothing visible has.
  const Lens lens = camera.lens({});
  const Vec3 to_eye = lens.is_parallel ? lens.back : normalized(lens.eye_mm - *middle);
  if (hit.normal == Vec3{} || dot(hit.normal, to_eye) <= 0.0) hit.normal = to_eye;
  return hit;
}

}  // namespace argil::viewer
