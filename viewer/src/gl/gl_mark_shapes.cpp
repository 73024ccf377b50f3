// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_mark_shapes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace argil::viewer {
namespace {

constexpr int kRingPoints = 128;
constexpr int kArrowSides = 24;
constexpr double kShaftPixels = 2.6;  // radius
constexpr double kHeadPixels = 7.5;   // radius
constexpr double kHeadLength = 2.6;   // of its radii
/// A short arrow is all head, and no longer than it is.
constexpr double kMostHead = 0.6;

Float3 narrow(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Float4 narrow(const Vec3& color, double alpha) {
  return {static_cast<float>(color.x), static_cast<float>(color.y), static_cast<float>(color.z),
          static_cast<float>(alpha)};
}

/// Two unit vectors that make a right-handed frame with a unit normal.
std::pair<Vec3, Vec3> frame_of(const Vec3& normal) {
  const Vec3 other = std::abs(normal.z) < 0.9 ? Vec3{0.0, 0.0, 1.0} : Vec3{1.0, 0.0, 0.0};
  const Vec3 u = normalized(cross(other, normal));
  return {u, cross(normal, u)};
}

/// A corner with its normal.
struct Ended {
  Vec3 position;
  Vec3 normal;
};

void add_quad(std::vector<SolidVertex>& to, const std::array<Ended, 4>& corners,
              const Float4& color) {
  for (const std::size_t i : {0U, 1U, 2U, 0U, 2U, 3U})
    to.push_back({narrow(corners[i].position), narrow(corners[i].normal), color});
}

/// A surface of revolution about an axis between two circles; `slope` is the normals' fraction
/// along the axis.
void add_frustum(std::vector<SolidVertex>& to, const std::array<Vec3, 2>& middles,
                 const std::array<double, 2>& radii, double slope, const Float4& color) {
  const Vec3 axis = normalized(middles[1] - middles[0]);
  const auto [u, v] = frame_of(axis);
  for (int i = 0; i < kArrowSides; ++i) {
    std::array<Vec3, 2> out;
    for (int k = 0; k < 2; ++k) {
      const double turn = 2.0 * std::numbers::pi * (i + k) / kArrowSides;
      out[static_cast<std::size_t>(k)] = std::cos(turn) * u + std::sin(turn) * v;
    }
    const auto corner = [&](std::size_t end, std::size_t side) {
      return Ended{middles[end] + radii[end] * out[side], normalized(out[side] + slope * axis)};
    };
    add_quad(to, {corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)}, color);
  }
}

}  // namespace

void add_loop(std::vector<LineVertex>& to, const std::vector<Vec3>& points, const Vec3& color) {
  const std::size_t count = points.size();
  assert(count >= 3);
  const auto vertex = [&](std::size_t i, float side) {
    return LineVertex{narrow(points[(i + count - 1) % count]), narrow(points[i % count]),
                      narrow(points[(i + 1) % count]), narrow(color, 1.0), side};
  };
  // Two triangles a segment, each vertex with its neighbours, from which the shader works out the
  // mitre.
  for (std::size_t i = 0; i < count; ++i) {
    for (const auto& [step, side] :
         {std::pair{0U, -1.0F}, {1U, -1.0F}, {1U, 1.0F}, {0U, -1.0F}, {1U, 1.0F}, {0U, 1.0F}})
      to.push_back(vertex(i + step, side));
  }
}

void add_line(std::vector<LineVertex>& to, const std::vector<Vec3>& points, const Vec3& color) {
  if (points.size() < 2) return;
  const auto vertex = [&](std::size_t i, float side) {
    return LineVertex{narrow(points[i > 0 ? i - 1 : 0]), narrow(points[i]),
                      narrow(points[std::min(i + 1, points.size() - 1)]), narrow(color, 1.0), side};
  };
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    for (const auto& [step, side] :
         {std::pair{0U, -1.0F}, {1U, -1.0F}, {1U, 1.0F}, {0U, -1.0F}, {1U, 1.0F}, {0U, 1.0F}})
      to.push_back(vertex(i + step, side));
  }
}

std::vector<Vec3> ring_points(const RingMark& ring) {
  assert(ring.radius_mm >= 0.0);
  const auto [u, v] = frame_of(normalized(ring.normal));
  std::vector<Vec3> points;
  for (int i = 0; i < kRingPoints; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kRingPoints;
    points.push_back(ring.center_mm + ring.radius_mm * (std::cos(turn) * u + std::sin(turn) * v));
  }
  return points;
}

std::vector<Vec3> plane_corners(const PlaneMark& plane) {
  const auto [u, v] = frame_of(normalized(plane.normal));
  const double s = plane.half_side_mm;
  return {plane.point_mm - s * u - s * v, plane.point_mm + s * u - s * v,
          plane.point_mm + s * u + s * v, plane.point_mm - s * u + s * v};
}

void add_fill(std::vector<SolidVertex>& to, const std::vector<Vec3>& corners, const Vec3& color,
              double alpha) {
  assert(corners.size() >= 3);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    for (const Vec3& p : {corners[0], corners[i], corners[i + 1]})
      to.push_back({narrow(p), {}, narrow(color, alpha)});
  }
}

void add_arrow(std::vector<SolidVertex>& to, const ArrowMark& arrow, double pixel_mm) {
  const Vec3 path = arrow.to_mm - arrow.from_mm;
  const double whole = length(path);
  if (!(whole > 0.0)) return;
  assert(pixel_mm >= 0.0);
  const Float4 color = narrow(arrow.color, 1.0);
  const double head = std::min(kHeadLength * kHeadPixels * pixel_mm, kMostHead * whole);
  const double radius = head / kHeadLength;
  const double shaft = radius * kShaftPixels / kHeadPixels;
  const Vec3 neck = arrow.to_mm - (head / whole) * path;
  add_frustum(to, {arrow.from_mm, neck}, {shaft, shaft}, 0.0, color);
  add_frustum(to, {neck, arrow.to_mm}, {radius, 0.0}, 1.0 / kHeadLength, color);
  // The head's base and the shaft's end, seen from behind.
  const Vec3 back = (-1.0 / whole) * path;
  const auto [u, v] = frame_of(back);
  for (const auto& [middle, size] : {std::pair{neck, radius}, {arrow.from_mm, shaft}}) {
    for (int i = 0; i < kArrowSides; ++i) {
      const double a = 2.0 * std::numbers::pi * i / kArrowSides;
      const double b = 2.0 * std::numbers::pi * (i + 1) / kArrowSides;
      for (const Vec3& p : {middle, middle + size * (std::cos(a) * u + std::sin(a) * v),
                            middle + size * (std::cos(b) * u + std::sin(b) * v)})
        to.push_back({narrow(p), narrow(back), color});
    }
  }
}

/// Corners are in pixels from the point, so that a pin is as large wherever it stands.
void add_pin(std::vector<PinVertex>& to, const PinMark& pin) {
  constexpr float kHalfWidth = 11.0F;
  constexpr float kTop = 32.0F;
  constexpr float kBottom = -2.0F;
  const std::array<std::array<float, 2>, 6> corners{{{-kHalfWidth, kBottom},
                                                     {kHalfWidth, kBottom},
                                                     {kHalfWidth, kTop},
                                                     {-kHalfWidth, kBottom},
                                                     {kHalfWidth, kTop},
                                                     {-kHalfWidth, kTop}}};
  for (const auto& corner : corners) to.push_back({narrow(pin.at_mm), corner, narrow(pin.color)});
}

}  // namespace argil::viewer
