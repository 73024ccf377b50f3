// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/pressure_curve.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>

namespace argil::viewer {
namespace {

/// The slope at a point between two pieces: of Fritsch and Carlson's it is the harmonic mean, with
/// which the curve never leaves the range of its points (F. Fritsch, J. Butland, 1984).
double slope_between(double before, double after) {
  return before > 0.0 && after > 0.0 ? 2.0 * before * after / (before + after) : 0.0;
}

}  // namespace

double shaped_pressure(const PressureCurve& curve, double pressure) noexcept {
  assert(curve == in_range(curve));
  if (curve == PressureCurve()) return pressure;
  const double p = std::clamp(pressure, 0.0, 1.0);
  const std::array<PressureCurve::Point, 4> at{
      {{0.0, curve.start}, curve.points[0], curve.points[1], {1.0, 1.0}}};
  std::array<double, 3> rise{};
  for (std::size_t n = 0; n < 3; ++n) {
    rise[n] = (at[n + 1].y - at[n].y) / (at[n + 1].x - at[n].x);
  }
  const std::array<double, 4> slope{rise[0], slope_between(rise[0], rise[1]),
                                    slope_between(rise[1], rise[2]), rise[2]};
  std::size_t n = 0;
  while (n < 2 && p > at[n + 1].x) ++n;
  const double wide = at[n + 1].x - at[n].x;
  const double t = (p - at[n].x) / wide;
  const double u = 1.0 - t;
  const double value = u * u * (1.0 + 2.0 * t) * at[n].y + t * t * (1.0 + 2.0 * u) * at[n + 1].y +
                       t * u * wide * (u * slope[n] - t * slope[n + 1]);
  return std::clamp(value, 0.0, 1.0);
}

PressureCurve in_range(PressureCurve curve) noexcept {
  constexpr double kApart = PressureCurve::kLeastApart;
  auto& [first, second] = curve.points;
  curve.start = std::clamp(curve.start, 0.0, 1.0);
  first.x = std::clamp(first.x, kApart, 1.0 - 2.0 * kApart);
  // Not clamp: rounding may put the lower bound beyond the upper one.
  second.x = std::min(std::max(second.x, first.x + kApart), 1.0 - kApart);
  first.y = std::clamp(first.y, curve.start, 1.0);
  second.y = std::clamp(second.y, first.y, 1.0);
  return curve;
}

std::string text_of(const PressureCurve& curve) {
  char text[160];
  std::snprintf(text, sizeof text, "%.6f %.6f %.6f %.6f %.6f", curve.start, curve.points[0].x,
                curve.points[0].y, curve.points[1].x, curve.points[1].y);
  return text;
}

std::optional<PressureCurve> pressure_of(std::string_view text) {
  std::array<double, 5> numbers{};
  for (double& number : numbers) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  if (!text.empty()) return std::nullopt;
  const PressureCurve read{numbers[0], {{{numbers[1], numbers[2]}, {numbers[3], numbers[4]}}}};
  // Rounded when it was written.
  const PressureCurve good = in_range(read);
  const auto is_near = [](double a, double b) { return std::abs(a - b) < 1e-5; };
  const bool is_good =
      is_near(good.start, read.start) && is_near(good.points[0].x, read.points[0].x) &&
      is_near(good.points[0].y, read.points[0].y) && is_near(good.points[1].x, read.points[1].x) &&
      is_near(good.points[1].y, read.points[1].y);
  if (!is_good) return std::nullopt;
  return good;
}

}  // namespace argil::viewer
