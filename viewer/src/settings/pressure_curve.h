// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace argil::viewer {

/// What a pen's pressure counts as: a curve that never falls, through (0, start), two points and
/// (1, 1). A mouse presses with 1, which stays 1.
struct PressureCurve {
  struct Point {
    double x = 0.0;
    double y = 0.0;
    friend bool operator==(const Point&, const Point&) = default;
  };
  double start = 0.0;  ///< of no pressure; 0 to 1
  /// From left to right, at least kLeastApart apart and from the ends; heights that do not fall.
  std::array<Point, 2> points{{{1.0 / 3.0, 1.0 / 3.0}, {2.0 / 3.0, 2.0 / 3.0}}};
  static constexpr double kLeastApart = 0.05;
  friend bool operator==(const PressureCurve&, const PressureCurve&) = default;
};

/// A little does much; as it is; much is needed.
inline constexpr PressureCurve kSoftPressure{0.0, {{{0.2, 0.5}, {0.5, 0.82}}}};
inline constexpr PressureCurve kLinearPressure{};
inline constexpr PressureCurve kFirmPressure{0.0, {{{0.5, 0.18}, {0.8, 0.5}}}};

/// The curve at a pressure, 0 to 1; of the linear one the pressure itself.
/// Source  F. Fritsch, R. Carlson, "Monotone piecewise cubic interpolation" (1980).
double shaped_pressure(const PressureCurve& curve, double pressure) noexcept;

/// The same with numbers moved into their ranges, the points where they were put as far as those
/// leave room.
PressureCurve in_range(PressureCurve curve) noexcept;

/// Five numbers parted by blanks, and back; nothing for what is no such text or out of range.
std::string text_of(const PressureCurve& curve);
std::optional<PressureCurve> pressure_of(std::string_view text);

}  // namespace argil::viewer
