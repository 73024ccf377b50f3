// SPDX-License-Identifier: GPL-3.0-or-later
// Where the dabs of a stroke fall, and with which tool they are the same in Argil.
#include "edits/stroke_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace argil::evaluation {
namespace {

constexpr double kSpacing = 0.25;     ///< between dabs, in radii
constexpr double kPull = 1.0 / 16.0;  ///< of grab, at each dab
constexpr double kDepth = 0.5;        ///< of a stamped ball's centre above or below the surface

/// A direction and a tangent that lie askew to the lattice and to the cube of quad_ball.
const Vec3 kUp = normalized(Vec3{0.83, 0.47, 0.31});
const Vec3 kAhead = normalized(cross(kUp, Vec3{0.36, 0.48, 0.8}));

double height_of(Action action) {
  if (action == Action::carve) return kDepth;
  return action == Action::add ? -kDepth : 0.0;
}

/// The radius R of a ball whose centre is k R above a sphere of radius B and that covers as much of
/// it as pi r^2: R^2 (1 - k^2) B = r^2 (B + k R).
double stamping_radius(double covering_mm, double k) {
  const double r2 = covering_mm * covering_mm;
  const double a = (1.0 - k * k) * kBallMm;
  return (k * r2 + std::sqrt(k * k * r2 * r2 + 4.0 * a * kBallMm * r2)) / (2.0 * a);
}

double distance_to_segment(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 along = b - a;
  const double squared = dot(along, along);
  const double t = squared > 0.0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
  return length(p - a - t * along);
}

template <class Place>
double distance_to_path(std::size_t points, const Place& place, const Vec3& p) {
  assert(points > 0);
  double least = length(p - place(0));
  for (std::size_t i = 1; i < points; ++i) {
    least = std::min(least, distance_to_segment(place(i - 1), place(i), p));
  }
  return least;
}

}  // namespace

const char* brush_name(Brush brush) {
  switch (brush) {
    case Brush::draw:
      return "draw";
    case Brush::smooth:
      return "smooth";
    case Brush::crease:
      return "crease";
    case Brush::grab:
      break;
  }
  return "grab";
}

StrokePlan stroke_plan(Brush brush, double covered, double vertices) {
  assert(covered > 0.0 && covered < vertices);
  StrokePlan plan{brush, 2.0 * kBallMm * std::sqrt(covered / vertices), {}};
  const double turn = 2.0 * std::asin(0.5 * kSpacing * plan.radius_mm / kBallMm);
  for (int i = 0; i < kLongDabs; ++i) {
    const double angle = turn * i;
    plan.points.push_back(brush == Brush::grab ? kBallMm * kUp + kPull * plan.radius_mm * i * kAhead
                                               : kBallMm * std::cos(angle) * kUp +
                                                     kBallMm * std::sin(angle) * kAhead);
  }
  return plan;
}

Stroke argil_stroke(const StrokePlan& plan, Action action) {
  const double height = height_of(action);
  const double radius = height == 0.0 ? plan.radius_mm : stamping_radius(plan.radius_mm, height);
  Stroke stroke;
  stroke.tool.action = action;
  stroke.tool.radii_mm = {radius, radius, radius};
  for (const Vec3& point : plan.points) {
    StrokeSample sample;
    sample.time_s = 0.01 * static_cast<double>(stroke.samples.size());
    sample.position_mm = point + height * radius * normalized(point);
    stroke.samples.push_back(sample);
  }
  const double step = length(stroke.samples[1].position_mm - stroke.samples[0].position_mm);
  // A little less than the samples are apart, so that each makes its dab.
  stroke.spacing = 0.9999 * step / radius;
  return stroke;
}

double distance_to_swept_ball(const Stroke& stroke, const Vec3& p) noexcept {
  const auto place = [&](std::size_t i) { return stroke.samples[i].position_mm; };
  return distance_to_path(stroke.samples.size(), place, p) - smallest_radius(stroke.tool);
}

bool is_near(const StrokePlan& plan, const Vec3& p, double radii) noexcept {
  assert(radii > 0.0);
  const double reach = radii * plan.radius_mm;
  // Most of a ball is farther from the first dab than the whole stroke reaches.
  const Vec3& first = plan.points.front();
  if (length(p - first) > length(plan.points.back() - first) + reach) return false;
  const auto place = [&](std::size_t i) { return plan.points[i]; };
  return distance_to_path(plan.points.size(), place, p) <= reach;
}

}  // namespace argil::evaluation
