// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl_occlusion.h"

#include <epoxy/gl.h>

#include "gl_screen_shaders.h"

namespace argil::viewer {
namespace {

void set_eye(const GlProgram& program, const EyeView& eye) {
  program.use();
  program.set("depth", 0);
  program.set("occlusion", 1);
  program.set("part", eye.part.x, eye.part.y, eye.part.width, eye.part.height);
  program.set("lens", eye.lens.near_mm, eye.lens.far_mm, eye.lens.tan_x, eye.lens.tan_y);
  program.set("is_parallel", eye.lens.is_parallel ? 1 : 0);
}

void bind(int unit, unsigned texture) {
  glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_2D, texture);
}

/// The part of a picture of half the size that holds this one.
void set_half_viewport(const PixelRect& part) {
  const int x = part.x / 2;
  const int y = part.y / 2;
  glViewport(x, y, (part.x + part.width + 1) / 2 - x, (part.y + part.height + 1) / 2 - y);
}

}  // namespace

Result<GlOcclusion> GlOcclusion::make(ObjectCount& count) {
  GlOcclusion made;
  const struct {
    GlProgram& program;
    const char* name;
    const char* fragment;
  } parts[] = {{made.occlusion_, "occlusion", kOcclusionFragment},
               {made.blur_, "occlusion blur", kBlurFragment},
               {made.darken_, "darkening", kDarkenFragment}};
  for (const auto& part : parts) {
    const std::string fragment = std::string(kPlaceFunctions) + part.fragment;
    auto program = GlProgram::make(count, {part.name, "", kScreenVertex, fragment.c_str()});
    if (!program) return program.error();
    part.program = std::move(program).value();
  }
  return made;
}

void GlOcclusion::resize(ObjectCount& count, int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  for (Half* half : {&raw_, &smooth_}) {
    half->texture = GlTexture(count);
    half->framebuffer = GlFramebuffer(count);
    bind(1, half->texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindFramebuffer(GL_FRAMEBUFFER, half->framebuffer.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                           half->texture.name(), 0);
  }
}

void GlOcclusion::darken(ObjectCount& count, const GlTargets& targets, const EyeView& eye) {
  resize(count, (targets.width() + 1) / 2, (targets.height() + 1) / 2);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  bind(0, targets.kept_depth());
  set_half_viewport(eye.part);
  glBindFramebuffer(GL_FRAMEBUFFER, raw_.framebuffer.name());
  bind(1, 0);
  set_eye(occlusion_, eye);
  glDrawArrays(GL_TRIANGLES, 0, 3);

  glBindFramebuffer(GL_FRAMEBUFFER, smooth_.framebuffer.name());
  bind(1, raw_.texture.name());
  set_eye(blur_, eye);
  glDrawArrays(GL_TRIANGLES, 0, 3);

  targets.bind_picture();
  glViewport(eye.part.x, eye.part.y, eye.part.width, eye.part.height);
  bind(1, smooth_.texture.name());
  glEnable(GL_BLEND);
  glBlendFunc(GL_ZERO, GL_SRC_COLOR);
  set_eye(darken_, eye);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
  bind(1, 0);
  bind(0, 0);
}

}  // namespace argil::viewer
