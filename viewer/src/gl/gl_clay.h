// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "argil/core/result.h"

#include "gl/gl_blocks.h"
#include "gl/gl_program.h"
#include "gl/gl_targets.h"
#include "picture/renderer.h"

namespace argil::viewer {

/// One eye's view: a lens and its part of the picture.
struct EyeView {
  Lens lens;
  PixelRect part;
};

/// From mm to clip space, multiplied in double.
Matrix view_projection(const Lens& lens) noexcept;

/// A pixel's height in mm at a point, for this eye.
double pixel_mm_at(const EyeView& eye, const Vec3& place_mm) noexcept;

/// What a picture cuts away so that its slice is seen: all on the negative side.
using ClipPlane = std::optional<BoundPlane>;

/// The planes that bound what an eye sees in a part of its picture.
std::vector<BoundPlane> bounds_of(const EyeView& eye, const PixelRect& area, const ClipPlane& cut);

/// The part of an eye's picture that holds all of a box, and two pixels around it: rounding and
/// what is smoothed along edges. All of the picture for a box that reaches behind the eye.
PixelRect area_of(const EyeView& eye, const Box3& box_mm);

/// Draws blocks in each shading, and their edges.
class GlClay {
 public:
  static Result<GlClay> make(ObjectCount& count);

  void draw(const GlBlocks& blocks, const Picture& picture, const EyeView& eye,
            const ClipPlane& cut) const;

 private:
  std::array<GlProgram, 4> shadings_;
  GlProgram wires_;
};

}  // namespace argil::viewer
