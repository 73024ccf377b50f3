// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_object.h"

#include <cassert>

#include <epoxy/gl.h>

namespace argil::viewer {

void ObjectCount::add(int objects) noexcept {
  here_ += objects;
  assert(here_ >= 0);
}

unsigned make_object(ObjectKind kind) {
  GLuint name = 0;
  switch (kind) {
    case ObjectKind::buffer:
      glGenBuffers(1, &name);
      break;
    case ObjectKind::vertex_array:
      glGenVertexArrays(1, &name);
      break;
    case ObjectKind::texture:
      glGenTextures(1, &name);
      break;
    case ObjectKind::framebuffer:
      glGenFramebuffers(1, &name);
      break;
    case ObjectKind::renderbuffer:
      glGenRenderbuffers(1, &name);
      break;
    case ObjectKind::program:
      name = glCreateProgram();
      break;
  }
  return name;
}

void free_object(ObjectKind kind, unsigned name) noexcept {
  switch (kind) {
    case ObjectKind::buffer:
      glDeleteBuffers(1, &name);
      break;
    case ObjectKind::vertex_array:
      glDeleteVertexArrays(1, &name);
      break;
    case ObjectKind::texture:
      glDeleteTextures(1, &name);
      break;
    case ObjectKind::framebuffer:
      glDeleteFramebuffers(1, &name);
      break;
    case ObjectKind::renderbuffer:
      glDeleteRenderbuffers(1, &name);
      break;
    case ObjectKind::program:
      glDeleteProgram(name);
      break;
  }
}

}  // namespace argil::viewer
