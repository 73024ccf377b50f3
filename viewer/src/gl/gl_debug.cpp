// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_debug.h"

#include <epoxy/gl.h>

namespace argil::viewer {
namespace {

// NOLINTNEXTLINE(readability-function-size): OpenGL's own signature
void on_message(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum severity, GLsizei /*length*/,
                const GLchar* message, const void* user) {
  if (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH) return;
  // OpenGL hands the pointer back as const; GlDebug gave a mutable one.
  static_cast<GlDebug*>(const_cast<void*>(user))->add(message);
}

}  // namespace

GlDebug::GlDebug() {
  GLint flags = 0;
  glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
  listens_ = (flags & GL_CONTEXT_FLAG_DEBUG_BIT) != 0 && epoxy_has_gl_extension("GL_KHR_debug");
  if (!listens_) return;
  glEnable(GL_DEBUG_OUTPUT);
  // So that an error is counted before the call that made it returns.
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(on_message, this);
}

GlDebug::~GlDebug() {
  if (listens_) glDebugMessageCallback(nullptr, nullptr);
}

void GlDebug::add(const char* message) {
  ++errors_;
  last_error_ = message;
}

}  // namespace argil::viewer
