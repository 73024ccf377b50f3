// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "argil/core/result.h"

#include "picture/renderer.h"

namespace argil::viewer {

/// With OpenGL 3.3 core or later; its context must be current and outlive the renderer.
/// Errors  device when the context is older or a shader does not compile, with OpenGL's words.
Result<std::unique_ptr<Renderer>> make_gl_renderer();

struct GlRendererOptions {
  int samples = 0;  ///< a pixel; 0: no multisampling
  /// Picture::is_moving is drawn with about a third of the triangles, and without multisampling
  /// also with a quarter of the pixels.
  bool has_coarse = false;
};

/// As make_gl_renderer, which chooses by the card. Tests draw also as it would not.
Result<std::unique_ptr<Renderer>> make_gl_renderer_with(const GlRendererOptions& options);

}  // namespace argil::viewer
