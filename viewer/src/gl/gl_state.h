// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include <epoxy/gl.h>

// What several passes set alike. Included by sources only: epoxy stays out of headers' users.
namespace argil::viewer {

/// Fragments cover the picture by their alpha. The picture's own alpha stays as it is: windows show
/// it on some systems.
inline void blend_over() {
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
}

/// Fragments multiply the picture, whose alpha becomes theirs.
inline void blend_product() {
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ONE, GL_ZERO);
}

/// How the bound texture is read: without mip levels, its edge beyond it.
inline void set_texture(GLint filter) {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/// An offset into the bound buffer, as OpenGL takes it: in a pointer.
inline const void* buffer_offset(std::int64_t bytes) {
  return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr): see above
}

inline void bind_texture(int unit, unsigned texture) {
  glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_2D, texture);
}

}  // namespace argil::viewer
