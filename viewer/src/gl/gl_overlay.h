// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/result.h"

#include "gl/gl_clay.h"
#include "gl/gl_program.h"
#include "gl/gl_targets.h"

namespace argil::viewer {

/// What a picture is multiplied by after the clay was drawn.
enum class Overlay {
  occlusion,  ///< how much sky a point sees, from the kept depth
  curvature   ///< what Shading::curvature wrote into the picture's alpha, smoothed
};

/// Passes over the picture: one value for each 2 x 2 pixels, smoothed where depth is alike, then
/// multiplied.
class GlOverlay {
 public:
  static Result<GlOverlay> make(ObjectCount& count);

  /// Multiplies an eye's part of the picture. Needs kept depth and a vertex array without
  /// attributes bound. Errors  as check_framebuffer.
  Result<void> draw(ObjectCount& count, Overlay overlay, const GlTargets& targets,
                    const EyeView& eye);

 private:
  /// One channel at half the picture's size.
  struct Half {
    GlTexture texture;
    GlFramebuffer framebuffer;
  };
  Result<void> resize(ObjectCount& count, int width, int height);
  void smooth(const Half& from, const Half& to, const EyeView& eye, double nothing) const;

  GlProgram occlusion_;
  GlProgram bend_;
  GlProgram smoothing_;
  GlProgram darken_;
  GlProgram contrast_;
  Half first_;
  Half second_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace argil::viewer
