// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "argil/core/vec3.h"

#include "picture/camera.h"
#include "picture/stereo.h"

namespace argil::viewer {

/// How a drag becomes a stroke; the names are Blender's.
enum class StrokeMode {
  space,     ///< dabs evenly along the drag
  dots,      ///< a dab for each move of the hand
  drag_dot,  ///< one dab, which follows the hand until it lets go
  anchored,  ///< one dab where the hand pressed; the drag says how large and how it is turned
  line,      ///< from the press straight to the release
  curve      ///< through points that are clicked, with Enter
};
inline constexpr std::array kStrokeModeNames{"Space",    "Dots", "Drag dot",
                                             "Anchored", "Line", "Curve"};

/// Whether the stroke is one dab that is laid anew until the hand lets go.
inline bool is_one_dab(StrokeMode mode) noexcept {
  return mode == StrokeMode::drag_dot || mode == StrokeMode::anchored;
}

/// A line or a curve that is being drawn over the picture, and not on the clay yet.
struct StrokeGuide {
  StrokeMode mode = StrokeMode::line;  ///< line or curve
  std::vector<Camera::Pixel> ends;     ///< of a line: of the window, where it begins and ends
  std::vector<Vec3> places_mm;         ///< of a curve: the points, in the sculpture's frame
  std::size_t eye = 0;                 ///< the picture that the curve is drawn in (WindowPart)
};

/// Where a line ends: at the pointer, or with `in_steps` as far away in the nearest direction that
/// is a multiple of 15 degrees.
Camera::Pixel line_end(const Camera::Pixel& from, const Camera::Pixel& to, bool in_steps);

/// A smooth line through all points, from the first to the last; of two it is straight. Points that
/// repeat the one before are left out.
/// Source  E. Catmull, R. Rom, "A class of local interpolating splines" (1974), centripetal: it has
///         no loops and no cusps between two points (C. Yuksel et al., "Parameterization and
///         applications of Catmull-Rom curves", 2011).
std::vector<Camera::Pixel> curve_through(const std::vector<Camera::Pixel>& points);

/// Points on the way that are no farther apart than that, its own among them.
std::vector<Camera::Pixel> close_points(const std::vector<Camera::Pixel>& way, double most_pixels);

/// A guide as it lies over the picture now: a line's ends, a curve's points.
std::vector<Camera::Pixel> pixels_of(const StrokeGuide& guide, const Camera& camera,
                                     bool is_stereo);

/// What the hand does in this mode, for the status line; empty for what needs no words.
std::string words_of(StrokeMode mode, std::size_t points);

}  // namespace argil::viewer
