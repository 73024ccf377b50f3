// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_overlay.h"

#include <cassert>

#include "gl/gl_clay_shaders.h"
#include "gl/gl_screen_shaders.h"
#include "gl/gl_state.h"

namespace argil::viewer {
namespace {

constexpr int kDepthUnit = 0;
constexpr int kValuesUnit = 1;
/// Values of a point that is neither ridge nor valley, and of one that sees the whole sky.
constexpr double kFlat = 0.5;
constexpr double kOpen = 1.0;

/// Takes a program into use with the uniforms of kPositionFunctions and the two textures.
void use(const GlProgram& program, const EyeView& eye) {
  program.use();
  program.set("depth", kDepthUnit);
  program.set("values", kValuesUnit);
  program.set("part", eye.part.x, eye.part.y, eye.part.width, eye.part.height);
  program.set("lens", eye.lens.near_mm, eye.lens.far_mm, eye.lens.tan_x, eye.lens.tan_y);
  program.set("shift", eye.lens.shift_x, eye.lens.shift_y);
  program.set("is_parallel", eye.lens.is_parallel ? 1 : 0);
}

/// The part of a picture of half the size that holds this one.
void set_half_viewport(const PixelRect& part) {
  const int x = part.x / 2;
  const int y = part.y / 2;
  glViewport(x, y, (part.x + part.width + 1) / 2 - x, (part.y + part.height + 1) / 2 - y);
}

}  // namespace

Result<GlOverlay> GlOverlay::make(ObjectCount& count) {
  GlOverlay made;
  const struct {
    GlProgram& program;
    const char* name;
    const char* fragment;
  } parts[] = {{made.occlusion_, "occlusion", kOcclusionFragment},
               {made.bend_, "bend", kBendFragment},
               {made.smoothing_, "smoothing", kSmoothingFragment},
               {made.darken_, "darkening", kDarkenFragment},
               {made.contrast_, "contrast", kContrastFragment}};
  for (const auto& part : parts) {
    const std::string fragment = std::string(kPositionFunctions) + part.fragment;
    auto program =
        GlProgram::make(count, {part.name, kColorFunctions, kScreenVertex, fragment.c_str()});
    if (!program) return program.error();
    part.program = std::move(program).value();
  }
  return made;
}

Result<void> GlOverlay::resize(ObjectCount& count, int width, int height) {
  if (width == width_ && height == height_) return {};
  assert(width > 0 && height > 0);
  width_ = 0;
  height_ = 0;
  for (Half* half : {&first_, &second_}) {
    half->texture = GlTexture(count);
    half->framebuffer = GlFramebuffer(count);
    bind_texture(kValuesUnit, half->texture.name());
    // 8 bits are enough: the values are smoothed and multiplied into 8 bits of colour.
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, nullptr);
    set_texture(GL_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, half->framebuffer.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                           half->texture.name(), 0);
    if (auto made = check_framebuffer(width, height, 0); !made) {
      bind_texture(kValuesUnit, 0);
      return made;
    }
  }
  width_ = width;
  height_ = height;
  return {};
}

/// One blur from one half-sized picture into the other; `nothing` is the value where no clay is.
void GlOverlay::smooth(const Half& from, const Half& to, const EyeView& eye, double nothing) const {
  glBindFramebuffer(GL_FRAMEBUFFER, to.framebuffer.name());
  bind_texture(kValuesUnit, from.texture.name());
  use(smoothing_, eye);
  smoothing_.set("nothing", nothing);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

Result<void> GlOverlay::draw(ObjectCount& count, Overlay overlay, const GlTargets& targets,
                             const EyeView& eye) {
  // At half the size both ways: a quarter of the work, and neither occlusion nor curvature has
  // finer detail.
  auto made = resize(count, (targets.width() + 1) / 2, (targets.height() + 1) / 2);
  if (!made) return made;
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  const bool is_curvature = overlay == Overlay::curvature;
  if (is_curvature) targets.keep_color();
  bind_texture(kDepthUnit, targets.kept_depth());
  bind_texture(kValuesUnit, is_curvature ? targets.kept_color() : 0);
  set_half_viewport(eye.part);
  glBindFramebuffer(GL_FRAMEBUFFER, first_.framebuffer.name());
  use(is_curvature ? bend_ : occlusion_, eye);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  const double nothing = is_curvature ? kFlat : kOpen;
  smooth(first_, second_, eye, nothing);
  // Faces are flatter than the clay: their bends need a wider mean.
  if (is_curvature) smooth(second_, first_, eye, nothing);

  targets.bind_clay();
  glViewport(eye.part.x, eye.part.y, eye.part.width, eye.part.height);
  bind_texture(kValuesUnit, is_curvature ? first_.texture.name() : second_.texture.name());
  blend_product();
  use(is_curvature ? contrast_ : darken_, eye);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
  bind_texture(kValuesUnit, 0);
  bind_texture(kDepthUnit, 0);
  return {};
}

}  // namespace argil::viewer
