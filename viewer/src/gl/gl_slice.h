// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/result.h"

#include "gl/gl_clay.h"
#include "gl/gl_program.h"
#include "gl/gl_stream.h"
#include "picture/renderer.h"

namespace argil::viewer {

/// What has to go so that an eye sees a slice: all on the eye's side of it.
BoundPlane cut_by(const SlicePicture& slice, const Lens& lens) noexcept;

/// Draws a slice of the field; one without values is nothing.
class GlSlice {
 public:
  static Result<GlSlice> make(ObjectCount& count);

  /// Takes the values to draw, for all eyes of a picture.
  void take(ObjectCount& count, const SlicePicture& slice);
  void draw(const SlicePicture& slice, const EyeView& eye) const;

 private:
  GlProgram program_;
  GlStream stream_;
  GlTexture distances_;
};

}  // namespace argil::viewer
