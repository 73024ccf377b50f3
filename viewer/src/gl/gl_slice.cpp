// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_slice.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "gl/gl_clay_shaders.h"
#include "gl/gl_mark_shaders.h"
#include "gl/gl_state.h"

namespace argil::viewer {
namespace {

struct SliceVertex {
  std::array<float, 3> position;
  std::array<float, 2> texel;
};

}  // namespace

/// The half space that stays: what lies between the eye and the slice is cut away.
BoundPlane cut_by(const SlicePicture& slice, const Lens& lens) noexcept {
  const Vec3 normal = normalized(cross(slice.along_mm, slice.down_mm));
  const double to_eye =
      lens.is_parallel ? dot(normal, lens.back) : dot(normal, lens.eye_mm - slice.corner_mm);
  const Vec3 kept = to_eye > 0.0 ? -normal : normal;
  return {kept, -dot(kept, slice.corner_mm)};
}

Result<GlSlice> GlSlice::make(ObjectCount& count) {
  GlSlice made;
  auto program = GlProgram::make(count, {"slice", kColorFunctions, kSliceVertex, kSliceFragment});
  if (!program) return program.error();
  made.program_ = std::move(program).value();
  made.stream_ = GlStream(count, {3, 2});
  return made;
}

/// Uploads the values as they are: 4 bytes each, interpolated by the card.
void GlSlice::take(ObjectCount& count, const SlicePicture& slice) {
  assert(slice.distance_mm.size() ==
         static_cast<std::size_t>(slice.columns) * static_cast<std::size_t>(slice.rows));
  assert(slice.columns > 0 && slice.rows > 0);
  if (!distances_.is_there()) distances_ = GlTexture(count);
  bind_texture(0, distances_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, slice.columns, slice.rows, 0, GL_RED, GL_FLOAT,
               slice.distance_mm.data());
  set_texture(GL_LINEAR);
  bind_texture(0, 0);
}

void GlSlice::draw(const SlicePicture& slice, const EyeView& eye) const {
  assert(distances_.is_there());
  std::array<SliceVertex, 4> corners{};
  for (std::size_t i = 0; i < 4; ++i) {
    const double along = (i & 1U) != 0 ? 1.0 : 0.0;
    const double down = (i & 2U) != 0 ? 1.0 : 0.0;
    const Vec3 p = slice.corner_mm + along * slice.along_mm + down * slice.down_mm;
    // The first and last value of a row lie on the edges: in the middle of their texels.
    corners[i] = {{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)},
                  {static_cast<float>((0.5 + along * (slice.columns - 1)) / slice.columns),
                   static_cast<float>((0.5 + down * (slice.rows - 1)) / slice.rows)}};
  }
  program_.use();
  program_.set("view_projection", view_projection(eye.lens));
  program_.set("distance_mm", 0);
  // So far apart from line to line, whatever the screen's scale.
  constexpr double kLeastPixels = 8.0;
  constexpr double kPictureHeights = 0.011;
  program_.set("hatch_pixels", std::max(kLeastPixels, kPictureHeights * eye.part.height));
  bind_texture(0, distances_.name());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  blend_over();
  stream_.draw<SliceVertex>(GL_TRIANGLE_STRIP, corners);
  glDisable(GL_BLEND);
  bind_texture(0, 0);
}

}  // namespace argil::viewer
