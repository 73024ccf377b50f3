// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "argil/core/vec3.h"
#include "argil/engine/stroke.h"

#include "edits/shape.h"

namespace argil::evaluation {

/// What a sculptor does; each program has a tool of its own for it.
enum class Brush { draw, smooth, crease, grab };
inline constexpr std::array kBrushes{Brush::draw, Brush::smooth, Brush::crease, Brush::grab};
const char* brush_name(Brush brush);

/// Of a stroke. What one dab costs is the difference between strokes of these lengths, so that what
/// a stroke costs once is in neither.
inline constexpr int kShortDabs = 4;
inline constexpr int kLongDabs = 16;

/// The same stroke for all programs: on the ball's middle surface, a dab every quarter radius along
/// a great circle. Grab pulls along the tangent instead, a sixteenth at a time, by a radius in all.
struct StrokePlan {
  Brush brush = Brush::draw;
  double radius_mm = 0.0;    ///< of the part of the surface that a dab covers
  std::vector<Vec3> points;  ///< kLongDabs
};

/// `covered`: vertices under a dab, of `vertices` on the whole ball. The part of a sphere within a
/// chord r of a point of it has the area pi r^2.
StrokePlan stroke_plan(Brush brush, double covered, double vertices);

/// The stroke as Argil makes it with this action. Tools that displace or move stand on the surface;
/// those that stamp a ball dig in, or build up, by half its radius, and are so much larger that
/// they cover the same.
Stroke argil_stroke(const StrokePlan& plan, Action action);

/// What add and carve stamp: the ball that is swept along the stroke's samples.
double distance_to_swept_ball(const Stroke& stroke, const Vec3& p) noexcept;

/// Whether a point lies within so many radii of where the dabs were.
bool is_near(const StrokePlan& plan, const Vec3& p, double radii) noexcept;

}  // namespace argil::evaluation
