// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/support/offscreen.h"

#include <epoxy/gl.h>
// epoxy/egl.h must come alone: OpenGL's own names are known by then.
#include <epoxy/egl.h>

namespace argil::test {
namespace {

EGLDisplay open_display(std::string& why_not) {
  if (!epoxy_has_egl()) {
    why_not = "libEGL.so.1 is missing; install libegl1";
    return EGL_NO_DISPLAY;
  }
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    why_not = "EGL has no EGL_MESA_platform_surfaceless; install libegl-mesa0";
    return EGL_NO_DISPLAY;
  }
  const EGLDisplay display =
      eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
    why_not = "EGL finds no driver; install libgl1-mesa-dri";
    return EGL_NO_DISPLAY;
  }
  return display;
}

EGLContext open_context(EGLDisplay display) {
  constexpr EGLint kAttributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                    3,
                                    EGL_CONTEXT_MINOR_VERSION,
                                    3,
                                    EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                    EGL_CONTEXT_OPENGL_DEBUG,
                                    EGL_TRUE,
                                    EGL_NONE};
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return EGL_NO_CONTEXT;
  const EGLContext context =
      eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes);
  if (context == EGL_NO_CONTEXT) return context;
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE) return context;
  eglDestroyContext(display, context);
  return EGL_NO_CONTEXT;
}

}  // namespace

std::unique_ptr<Offscreen> Offscreen::make(int width, int height, std::string& why_not) {
  const EGLDisplay display = open_display(why_not);
  if (display == EGL_NO_DISPLAY) return nullptr;
  const EGLContext context = open_context(display);
  if (context == EGL_NO_CONTEXT) {
    why_not = "EGL has no OpenGL 3.3 core debug context";
    return nullptr;
  }
  std::unique_ptr<Offscreen> made(new Offscreen);
  made->display_ = display;
  made->context_ = context;
  made->width_ = width;
  made->height_ = height;
  glGenFramebuffers(1, &made->framebuffer_);
  glGenRenderbuffers(1, &made->color_);
  glBindRenderbuffer(GL_RENDERBUFFER, made->color_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, made->framebuffer_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, made->color_);
  return made;
}

Offscreen::~Offscreen() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteRenderbuffers(1, &color_);
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

}  // namespace argil::test
