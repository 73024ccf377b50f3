// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/stroke_mode.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace argil::viewer {
namespace {

using GuidePixel = Camera::Pixel;

double way_between(const GuidePixel& a, const GuidePixel& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

GuidePixel mixed(const GuidePixel& a, const GuidePixel& b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/// Before the first point and behind the last one the curve goes on as a mirror image would.
GuidePixel beyond(const GuidePixel& end, const GuidePixel& next) { return mixed(next, end, 2.0); }

/// Between b and c, by Neville's scheme over knots whose distances are square roots of lengths.
GuidePixel on_piece(const std::array<GuidePixel, 4>& p, double part) {
  std::array<double, 4> knots{};
  for (std::size_t n = 1; n < 4; ++n) {
    knots[n] = knots[n - 1] + std::sqrt(way_between(p[n - 1], p[n]));
  }
  const double t = knots[1] + part * (knots[2] - knots[1]);
  const auto at = [&](const GuidePixel& a, const GuidePixel& b, std::size_t from, std::size_t to) {
    return mixed(a, b, (t - knots[from]) / (knots[to] - knots[from]));
  };
  const GuidePixel first = at(p[0], p[1], 0, 1);
  const GuidePixel middle = at(p[1], p[2], 1, 2);
  const GuidePixel last = at(p[2], p[3], 2, 3);
  return at(at(first, middle, 0, 2), at(middle, last, 1, 3), 1, 2);
}

}  // namespace

Camera::Pixel line_end(const Camera::Pixel& from, const Camera::Pixel& to, bool in_steps) {
  if (!in_steps) return to;
  constexpr double kStep = std::numbers::pi / 12.0;
  const double far = way_between(from, to);
  const double angle = kStep * std::round(std::atan2(to.y - from.y, to.x - from.x) / kStep);
  return {from.x + far * std::cos(angle), from.y + far * std::sin(angle)};
}

std::vector<Camera::Pixel> curve_through(const std::vector<Camera::Pixel>& points) {
  constexpr double kLeastPixels = 1e-3;
  constexpr double kStepPixels = 3.0;
  std::vector<GuidePixel> apart;
  for (const GuidePixel& point : points) {
    if (apart.empty() || way_between(apart.back(), point) > kLeastPixels) apart.push_back(point);
  }
  if (apart.size() < 3) return apart;
  std::vector<GuidePixel> curve{apart.front()};
  for (std::size_t n = 0; n + 1 < apart.size(); ++n) {
    const GuidePixel& from = apart[n];
    const GuidePixel& to = apart[n + 1];
    const std::array<GuidePixel, 4> piece{n > 0 ? apart[n - 1] : beyond(from, to), from, to,
                                          n + 2 < apart.size() ? apart[n + 2] : beyond(to, from)};
    const int steps = std::max(4, static_cast<int>(way_between(from, to) / kStepPixels));
    for (int step = 1; step < steps; ++step) {
      curve.push_back(on_piece(piece, static_cast<double>(step) / steps));
    }
    curve.push_back(to);
  }
  return curve;
}

std::vector<Camera::Pixel> close_points(const std::vector<Camera::Pixel>& way, double most_pixels) {
  assert(most_pixels > 0.0);
  std::vector<GuidePixel> close;
  for (const GuidePixel& point : way) {
    if (!close.empty()) {
      const GuidePixel from = close.back();
      const int steps = static_cast<int>(std::ceil(way_between(from, point) / most_pixels));
      for (int step = 1; step < steps; ++step) {
        close.push_back(mixed(from, point, static_cast<double>(step) / steps));
      }
    }
    close.push_back(point);
  }
  return close;
}

std::vector<Camera::Pixel> pixels_of(const StrokeGuide& guide, const Camera& camera,
                                     bool is_stereo) {
  if (guide.mode == StrokeMode::line) return guide.ends;
  const std::vector<WindowPart> parts = parts_of(camera, is_stereo);
  const WindowPart& part = parts[std::min(guide.eye, parts.size() - 1)];
  std::vector<GuidePixel> pixels;
  for (const Vec3& place : guide.places_mm) {
    const GuidePixel inside = part.camera.pixel_of(place);
    pixels.push_back({inside.x + part.left, inside.y});
  }
  return pixels;
}

std::string words_of(StrokeMode mode, std::size_t points) {
  switch (mode) {
    case StrokeMode::space:
      break;
    case StrokeMode::dots:
      return "Dots: each move of the hand is a dab";
    case StrokeMode::drag_dot:
      return "Drag dot: press and drag the dab to its place   |   Esc: none";
    case StrokeMode::anchored:
      return "Anchored: press where its middle shall be, drag for size and turn   |   Esc: none";
    case StrokeMode::line:
      return "Line: drag from one end to the other   |   Alt: steps of 15 degrees   |   Esc: none";
    case StrokeMode::curve:
      if (points == 0) return "Curve: click points on the clay";
      return "Curve, " + std::to_string(points) + (points == 1 ? " point" : " points") +
             ": click more   |   Enter: apply   |   Backspace: one less   |   Esc: none";
  }
  return {};
}

}  // namespace argil::viewer
