// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/result.h"

#include "gl_clay.h"
#include "gl_program.h"
#include "gl_targets.h"

namespace argil::viewer {

/// Ambient occlusion from the kept depth of a picture.
class GlOcclusion {
 public:
  static Result<GlOcclusion> make(ObjectCount& count);

  /// Darkens an eye's part of the picture. Needs an empty vertex array bound.
  void darken(ObjectCount& count, const GlTargets& targets, const EyeView& eye);

 private:
  /// One channel at half the picture's size.
  struct Half {
    GlTexture texture;
    GlFramebuffer framebuffer;
  };
  void resize(ObjectCount& count, int width, int height);

  GlProgram occlusion_;
  GlProgram blur_;
  GlProgram darken_;
  Half raw_;
  Half smooth_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace argil::viewer
