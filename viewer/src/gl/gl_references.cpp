// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_references.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

#include "gl/gl_clay_shaders.h"
#include "gl/gl_mark_shaders.h"
#include "gl/gl_state.h"

namespace argil::viewer {
namespace {

struct ReferenceVertex {
  std::array<float, 3> position;
  std::array<float, 2> texel;
};

/// Its colours are those of the screen already.
constexpr const char* kReferenceFragment = R"(
in vec2 uv;
uniform sampler2D image;
uniform float opacity;
out vec4 picture;
void main() {
  vec4 color = texture(image, uv);
  picture = vec4(color.rgb, color.a * opacity);
}
)";

/// What is drawn smaller than it is would glitter without the smaller ones, which are there: to
/// have them made here would hold up the frame four times as long. An image of more pixels a side
/// than the card takes begins with the first that it takes.
void upload(const ReferencePixels& pixels) {
  GLint most_side = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most_side);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  GLint level = 0;
  const auto put = [&](const PixelLevel& each) {
    if (std::max(each.width, each.height) > most_side) return;
    glTexImage2D(GL_TEXTURE_2D, level++, GL_RGBA8, each.width, each.height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, each.rgba.data());
  };
  put(pixels);
  for (const PixelLevel& each : pixels.smaller) put(each);
  set_texture(GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
}

}  // namespace

GlTexture texture_of(ObjectCount& count, const ReferencePixels& pixels) {
  assert(pixels.width > 0 && pixels.height > 0);
  assert(pixels.rgba.size() ==
         4 * static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height));
  GlTexture texture(count);
  bind_texture(0, texture.name());
  upload(pixels);
  bind_texture(0, 0);
  return texture;
}

Result<GlReferences> GlReferences::make(ObjectCount& count) {
  GlReferences made;
  auto program =
      GlProgram::make(count, {"reference", kColorFunctions, kSliceVertex, kReferenceFragment});
  if (!program) return program.error();
  made.program_ = std::move(program).value();
  made.stream_ = GlStream(count, {3, 2});
  return made;
}

void GlReferences::take(ObjectCount& count, const std::vector<ReferenceMark>& marks) {
  // First: another image may have the address of one that is gone.
  std::erase_if(textures_, [](const auto& kept) { return kept.second.pixels.expired(); });
  for (const ReferenceMark& mark : marks) {
    assert(mark.pixels);
    if (textures_.contains(mark.pixels.get())) continue;
    textures_.emplace(mark.pixels.get(), Kept{mark.pixels, texture_of(count, *mark.pixels)});
  }
}

void GlReferences::draw(const std::vector<ReferenceMark>& marks, bool is_over,
                        const EyeView& eye) const {
  const bool has_any = std::any_of(marks.begin(), marks.end(), [is_over](const ReferenceMark& m) {
    return m.is_over == is_over;
  });
  if (!has_any) return;
  // It stands in the middle of the clay: neither plane of the lens may cut it off.
  Lens lens = eye.lens;
  const double away = dot(lens.eye_mm, lens.back);
  lens.near_mm = std::min(lens.near_mm, lens.is_parallel ? away - 1.0 : 0.5 * away);
  lens.far_mm = std::max(lens.far_mm, away + 1.0);
  program_.use();
  program_.set("view_projection", view_projection(lens));
  program_.set("image", 0);
  glDisable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  blend_over();
  for (const ReferenceMark& mark : marks) {
    if (mark.is_over != is_over) continue;
    const auto kept = textures_.find(mark.pixels.get());
    assert(kept != textures_.end());
    std::array<ReferenceVertex, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i) {
      const float along = (i & 1U) != 0 ? 1.0F : 0.0F;
      const float down = (i & 2U) != 0 ? 1.0F : 0.0F;
      const Vec3 p = mark.corner_mm + static_cast<double>(along) * mark.along_mm +
                     static_cast<double>(down) * mark.down_mm;
      corners[i] = {{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)},
                    {along, down}};
    }
    program_.set("opacity", mark.opacity);
    bind_texture(0, kept->second.texture.name());
    stream_.draw<ReferenceVertex>(GL_TRIANGLE_STRIP, corners);
  }
  bind_texture(0, 0);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

}  // namespace argil::viewer
