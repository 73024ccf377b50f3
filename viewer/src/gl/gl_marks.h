// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/result.h"

#include "gl/gl_clay.h"
#include "gl/gl_program.h"
#include "gl/gl_stream.h"
#include "gl/gl_targets.h"
#include "picture/renderer.h"

namespace argil::viewer {

/// Rings, lines, arrows, planes and pins over a drawn picture, whose depth stays the clay's.
class GlMarks {
 public:
  static Result<GlMarks> make(ObjectCount& count);

  void draw(const Picture& picture, const EyeView& eye, const GlTargets& targets) const;

 private:
  void draw_planes(const Picture& picture, const EyeView& eye) const;
  void draw_rings(const Picture& picture, const EyeView& eye) const;
  void draw_arrows(const Picture& picture, const EyeView& eye) const;
  void draw_handles(const Picture& picture, const EyeView& eye) const;
  void draw_pins(const Picture& picture, const EyeView& eye, const GlTargets& targets) const;

  GlProgram lines_;
  GlProgram solids_;
  GlProgram pins_;
  GlStream line_stream_;
  GlStream solid_stream_;
  GlStream pin_stream_;
};

}  // namespace argil::viewer
