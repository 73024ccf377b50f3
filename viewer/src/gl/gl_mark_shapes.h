// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "argil/core/vec3.h"

#include "picture/renderer.h"

// The vertices of marks, as gl_mark_shaders.h takes them. Nothing here calls OpenGL.
namespace argil::viewer {

using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;

struct LineVertex {
  Float3 before;
  Float3 at;
  Float3 after;
  Float4 color;
  float side;
};

struct SolidVertex {
  Float3 position;
  Float3 normal;  ///< 0: not lit
  Float4 color;
};

struct PinVertex {
  Float3 at;
  std::array<float, 2> corner;
  Float3 color;
};

/// Appends triangles of a closed line.
void add_loop(std::vector<LineVertex>& to, const std::vector<Vec3>& points, const Vec3& color);
/// The same of an open one; nothing of fewer than two points.
void add_line(std::vector<LineVertex>& to, const std::vector<Vec3>& points, const Vec3& color);
std::vector<Vec3> ring_points(const RingMark& ring);
std::vector<Vec3> plane_corners(const PlaneMark& plane);

/// Appends a convex shape's triangles, not lit.
void add_fill(std::vector<SolidVertex>& to, const std::vector<Vec3>& corners, const Vec3& color,
              double alpha);

/// Appends a shaft and a cone; `pixel_mm` is a pixel's size there. Nothing when its ends are the
/// same.
void add_arrow(std::vector<SolidVertex>& to, const ArrowMark& arrow, double pixel_mm);

void add_pin(std::vector<PinVertex>& to, const PinMark& pin);

}  // namespace argil::viewer
