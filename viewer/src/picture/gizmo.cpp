// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/gizmo.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "picture/piece_frame.h"

namespace argil::viewer {
namespace {

using Kind = GizmoPart::Kind;

// Of the gizmo's length.
constexpr double kRing = 0.85;
constexpr double kArrowFrom = 0.95;
constexpr double kArrowTo = 1.35;
constexpr double kSizeRing = 1.5;
constexpr double kSquareFrom = 0.3;
constexpr double kSquareTo = 0.5;

constexpr double kReachPixels = 9.0;  // how near the pointer must be to a line
/// Cosine between a ring's or square's normal and the view, below which it is seen from its edge;
/// and the sine of an arrow.
constexpr double kLeastOpen = 0.12;
constexpr double kSnapMm = 1.0;
constexpr double kSnapDeg = 15.0;
constexpr double kSnapFactor = 0.05;
constexpr double kMostFactor = 100.0;
constexpr int kRingPoints = 96;

constexpr std::array<Vec3, 3> kAxes{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
constexpr std::array<Vec3, 3> kColors{{{0.85, 0.06, 0.07}, {0.16, 0.52, 0.04}, {0.06, 0.20, 0.90}}};
const Vec3 kSizeColor{0.75, 0.75, 0.75};
const Vec3 kChosenColor{1.0, 0.80, 0.25};

/// Two axes that are right-handed with a third.
const Vec3& first_beside(std::size_t axis) { return kAxes[(axis + 1) % 3]; }
const Vec3& second_beside(std::size_t axis) { return kAxes[(axis + 2) % 3]; }

Vec3 to_eye(const Lens& lens, const Vec3& point) {
  return lens.is_parallel ? lens.back : normalized(lens.eye_mm - point);
}

Vec3 ring_point(const Gizmo& gizmo, std::size_t axis, int n) {
  const double turn = 2.0 * std::numbers::pi * n / kRingPoints;
  return gizmo.center_mm +
         kRing * gizmo.length_mm *
             (std::cos(turn) * first_beside(axis) + std::sin(turn) * second_beside(axis));
}

/// Lines of a ring's nearer half; of one that faces the eye, all of it.
std::vector<std::vector<Vec3>> ring_lines(const Gizmo& gizmo, std::size_t axis, const Lens& lens) {
  constexpr double kBehind = -0.1;  // of the ring's radius: a little more than the half
  const Vec3 toward = to_eye(lens, gizmo.center_mm);
  const auto is_near = [&](int n) {
    const Vec3 out = ring_point(gizmo, axis, n) - gizmo.center_mm;
    return dot(out, toward) >= kBehind * kRing * gizmo.length_mm;
  };
  // Begun behind, so that the nearer half is one line.
  int start = 0;
  while (start < kRingPoints && is_near(start)) ++start;
  std::vector<std::vector<Vec3>> lines;
  bool goes_on = false;
  for (int n = start; n <= start + kRingPoints; ++n) {
    if (!is_near(n % kRingPoints)) {
      goes_on = false;
      continue;
    }
    if (!std::exchange(goes_on, true)) lines.emplace_back();
    lines.back().push_back(ring_point(gizmo, axis, n % kRingPoints));
  }
  return lines;
}

/// The ring that scales: across the way to the eye, closed.
std::vector<Vec3> size_ring(const Gizmo& gizmo, const Lens& lens) {
  const Vec3 toward = to_eye(lens, gizmo.center_mm);
  const Vec3 across = normalized(cross(lens.up, toward));
  const Vec3 up = cross(toward, across);
  std::vector<Vec3> points;
  for (int n = 0; n <= kRingPoints; ++n) {
    const double turn = 2.0 * std::numbers::pi * n / kRingPoints;
    points.push_back(gizmo.center_mm +
                     kSizeRing * gizmo.length_mm * (std::cos(turn) * across + std::sin(turn) * up));
  }
  return points;
}

std::vector<Vec3> square_corners(const Gizmo& gizmo, std::size_t axis) {
  std::vector<Vec3> corners;
  for (const auto& [along, up] : {std::array{kSquareFrom, kSquareFrom},
                                  {kSquareTo, kSquareFrom},
                                  {kSquareTo, kSquareTo},
                                  {kSquareFrom, kSquareTo}}) {
    corners.push_back(gizmo.center_mm +
                      gizmo.length_mm * (along * first_beside(axis) + up * second_beside(axis)));
  }
  return corners;
}

/// Where a ray meets the plane through the middle across an axis; nothing from the edge.
std::optional<Vec3> on_plane(const Gizmo& gizmo, std::size_t axis, const Ray& ray) {
  const double slope = dot(ray.direction, kAxes[axis]);
  if (std::abs(slope) < kLeastOpen * length(ray.direction)) return std::nullopt;
  return ray.origin_mm + dot(gizmo.center_mm - ray.origin_mm, kAxes[axis]) / slope * ray.direction;
}

/// How far along an axis from the middle a ray comes nearest to it.
double along_axis(const Gizmo& gizmo, std::size_t axis, const Ray& ray) {
  const Vec3 way = normalized(ray.direction);
  const Vec3 between = gizmo.center_mm - ray.origin_mm;
  const double slope = dot(way, kAxes[axis]);
  return (slope * dot(way, between) - dot(kAxes[axis], between)) /
         std::max(1.0 - slope * slope, kLeastOpen * kLeastOpen);
}

double pixels_from_line(const Camera::Pixel& at, const Camera::Pixel& a, const Camera::Pixel& b) {
  const double x = b.x - a.x;
  const double y = b.y - a.y;
  const double square = x * x + y * y;
  const double t =
      square > 0.0 ? std::clamp(((at.x - a.x) * x + (at.y - a.y) * y) / square, 0.0, 1.0) : 0.0;
  return std::hypot(a.x + t * x - at.x, a.y + t * y - at.y);
}

/// How far a pixel is from a handle, in pixels; infinite from one that cannot be taken hold of.
double distance_to(const Gizmo& gizmo, const GizmoPart& part, const Camera& camera,
                   const Camera::Pixel& pixel) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const Lens lens = camera.lens({});
  const double facing = std::abs(dot(to_eye(lens, gizmo.center_mm), kAxes[part.axis]));
  if (part.kind == Kind::along) {
    if (1.0 - facing * facing < kLeastOpen * kLeastOpen) return kFar;
    const auto end = [&](double length) {
      return camera.pixel_of(gizmo.center_mm + length * gizmo.length_mm * kAxes[part.axis]);
    };
    return pixels_from_line(pixel, end(kArrowFrom), end(kArrowTo));
  }
  if (part.kind == Kind::across) {
    const auto hit = on_plane(gizmo, part.axis, camera.ray_at(pixel));
    if (!hit) return kFar;
    const Vec3 from = (*hit - gizmo.center_mm) / gizmo.length_mm;
    const auto is_within = [](double x) { return x >= kSquareFrom && x <= kSquareTo; };
    const bool is_on = is_within(dot(from, first_beside(part.axis))) &&
                       is_within(dot(from, second_beside(part.axis)));
    return is_on ? 0.0 : kFar;
  }
  double least = kFar;
  const bool is_size = part.kind == Kind::size;
  const auto lines = is_size ? std::vector<std::vector<Vec3>>{size_ring(gizmo, lens)}
                             : ring_lines(gizmo, part.axis, lens);
  for (const std::vector<Vec3>& line : lines) {
    for (std::size_t n = 0; n + 1 < line.size(); ++n) {
      least = std::min(
          least, pixels_from_line(pixel, camera.pixel_of(line[n]), camera.pixel_of(line[n + 1])));
    }
  }
  return least;
}

double rounded_to(double value, double step) { return step * std::round(value / step); }

}  // namespace

Gizmo gizmo_at(const Vec3& center_mm, const Camera& camera) {
  const double pixels = std::clamp(0.17 * camera.height(), 60.0, 170.0);
  return {center_mm, pixels * camera.pixel_mm_at(center_mm)};
}

Box3 bounds_of(const Gizmo& gizmo) {
  const double reach = 1.05 * kSizeRing * gizmo.length_mm;
  const Vec3 half{reach, reach, reach};
  return {gizmo.center_mm - half, gizmo.center_mm + half};
}

std::optional<GizmoPart> part_under(const Gizmo& gizmo, const Camera& camera,
                                    const Camera::Pixel& pixel) {
  std::optional<GizmoPart> best;
  double least = kReachPixels;
  for (const Kind kind : {Kind::across, Kind::along, Kind::around, Kind::size}) {
    for (std::size_t axis = 0; axis < (kind == Kind::size ? 1U : 3U); ++axis) {
      const GizmoPart part{kind, axis};
      const double pixels = distance_to(gizmo, part, camera, pixel);
      if (!(pixels < least)) continue;
      least = pixels;
      best = part;
    }
  }
  return best;
}

void add_gizmo(const Gizmo& gizmo, const Lens& lens, const std::optional<GizmoPart>& chosen,
               Picture& picture) {
  const bool is_size = chosen && chosen->kind == Kind::size;
  picture.handles.push_back({size_ring(gizmo, lens), is_size ? kChosenColor : kSizeColor, false});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto color_of = [&](Kind kind) {
      return chosen == GizmoPart{kind, axis} ? kChosenColor : kColors[axis];
    };
    const double facing = std::abs(dot(to_eye(lens, gizmo.center_mm), kAxes[axis]));
    for (std::vector<Vec3>& line : ring_lines(gizmo, axis, lens)) {
      picture.handles.push_back({std::move(line), color_of(Kind::around), false});
    }
    if (facing >= kLeastOpen) {
      picture.handles.push_back({square_corners(gizmo, axis), color_of(Kind::across), true});
    }
    if (1.0 - facing * facing >= kLeastOpen * kLeastOpen) {
      const Vec3 way = gizmo.length_mm * kAxes[axis];
      picture.arrows.push_back({gizmo.center_mm + kArrowFrom * way,
                                gizmo.center_mm + kArrowTo * way, color_of(Kind::along)});
    }
  }
}

GizmoDrag::GizmoDrag(const Gizmo& gizmo, const GizmoPart& part, const Camera& camera,
                     const Camera::Pixel& pixel, const Placement& before)
    : gizmo_(gizmo), part_(part), camera_(camera), start_(pixel), before_(before) {
  assert(part.axis < 3);
  if (part_.kind == Kind::around) last_deg_ = angle_at(pixel);
}

Vec3 GizmoDrag::shift_to(const Camera::Pixel& pixel) const {
  const Ray from = camera_.ray_at(start_);
  const Ray to = camera_.ray_at(pixel);
  if (part_.kind == Kind::along) {
    const double by = along_axis(gizmo_, part_.axis, to) - along_axis(gizmo_, part_.axis, from);
    return by * kAxes[part_.axis];
  }
  const auto begin = on_plane(gizmo_, part_.axis, from);
  const auto end = on_plane(gizmo_, part_.axis, to);
  // Beyond the horizon of the plane it stays where it is.
  return begin && end ? *end - *begin : Vec3{};
}

/// Of the pointer around the axis, in degrees, within the ring's plane; of a ring that is seen from
/// its edge, by how far the pointer is along it.
double GizmoDrag::angle_at(const Camera::Pixel& pixel) const {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const Vec3 toward = to_eye(camera_.lens({}), gizmo_.center_mm);
  const double facing = std::abs(dot(toward, kAxes[part_.axis]));
  const auto hit = facing < 2.0 * kLeastOpen ? std::nullopt
                                             : on_plane(gizmo_, part_.axis, camera_.ray_at(pixel));
  if (hit) {
    const Vec3 from = *hit - gizmo_.center_mm;
    return kDegrees *
           std::atan2(dot(from, second_beside(part_.axis)), dot(from, first_beside(part_.axis)));
  }
  // Its nearest point moves across the view as the axis turns.
  const Vec3 way = normalized(cross(kAxes[part_.axis], toward));
  const double radius = kRing * gizmo_.length_mm;
  const Camera::Pixel middle = camera_.pixel_of(gizmo_.center_mm);
  const Camera::Pixel end = camera_.pixel_of(gizmo_.center_mm + radius * way);
  const double x = end.x - middle.x;
  const double y = end.y - middle.y;
  return kDegrees * ((pixel.x - middle.x) * x + (pixel.y - middle.y) * y) / (x * x + y * y);
}

/// Pixels from the gizmo's middle.
double GizmoDrag::from_middle(const Camera::Pixel& pixel) const {
  const Camera::Pixel middle = camera_.pixel_of(gizmo_.center_mm);
  return std::hypot(pixel.x - middle.x, pixel.y - middle.y);
}

Placement GizmoDrag::to(const Camera::Pixel& pixel, bool snaps) {
  if (part_.kind == Kind::size) {
    // The ring is some hundred pixels from the middle: never taken hold of at it.
    const double factor = from_middle(pixel) / std::max(1.0, from_middle(start_));
    factor_ = std::clamp(snaps ? rounded_to(factor, kSnapFactor) : factor, 1.0 / kMostFactor,
                         kMostFactor);
    return scaled_about(before_, gizmo_.center_mm, factor_);
  }
  if (part_.kind != Kind::around) {
    Vec3 by = shift_to(pixel);
    if (snaps) {
      for (std::size_t axis = 0; axis < 3; ++axis) by[axis] = rounded_to(by[axis], kSnapMm);
    }
    return moved(before_, by);
  }
  const double now = angle_at(pixel);
  turned_deg_ += std::remainder(now - last_deg_, 360.0);
  last_deg_ = now;
  const double by = snaps ? rounded_to(turned_deg_, kSnapDeg) : turned_deg_;
  return turned_about(before_, gizmo_.center_mm, kAxes[part_.axis], by);
}

}  // namespace argil::viewer
