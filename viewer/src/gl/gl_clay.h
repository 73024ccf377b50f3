// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>

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

/// A piece as an eye sees it. Lens and cut are in the piece's own frame, as its blocks are: what
/// moves is the view, and no block is changed.
struct PieceView {
  PieceKey piece = 0;
  const GlBlocks* blocks = nullptr;  ///< null: it has none yet
  EyeView eye;
  ClipPlane cut;
  std::optional<Vec3> color;
};
PieceView view_of_piece(const ShownPiece& piece, const GlBlocks* blocks, const EyeView& eye,
                        const ClipPlane& cut);

/// The planes that bound what an eye sees in a part of its picture.
std::vector<BoundPlane> bounds_of(const EyeView& eye, const PixelRect& area, const ClipPlane& cut);

/// The part of an eye's picture that holds all of a box, and two pixels around it: rounding and
/// what is smoothed along edges. All of the picture for a box that reaches behind the eye.
PixelRect area_of(const EyeView& eye, const Box3& box_mm);

/// Draws blocks in each shading, and their edges.
class GlClay {
 public:
  static Result<GlClay> make(ObjectCount& count);

  /// What each has chosen (GlBlocks::choose). `is_behind`: they do not cover what is drawn already
  /// where both lie at the same depth.
  void draw(std::span<const PieceView> pieces, const Picture& picture, bool is_behind) const;

 private:
  void draw_wires(std::span<const PieceView> pieces) const;

  std::array<GlProgram, 4> shadings_;
  GlProgram wires_;
};

}  // namespace argil::viewer
