// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "argil/core/result.h"

#include "picture/renderer.h"

namespace argil::viewer {

/// With OpenGL 3.3 core or later; its context must be current and outlive the renderer.
/// Errors  device when the context is older or a shader does not compile, with OpenGL's words.
Result<std::unique_ptr<Renderer>> make_gl_renderer();

/// As make_gl_renderer, with so many samples a pixel: 0 for no multisampling. Tests draw with
/// several where make_gl_renderer would not.
Result<std::unique_ptr<Renderer>> make_gl_renderer_with(int samples);

}  // namespace argil::viewer
