// SPDX-License-Identifier: GPL-3.0-or-later
// What each way to show clay does to its colours.
#include <cmath>
#include <initializer_list>

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "support/shapes.h"
#include "viewer/support/projected.h"
#include "viewer/support/scene.h"

namespace argil::test {
namespace {

using viewer::Shading;

constexpr Shading kShadings[] = {Shading::matcap, Shading::plain, Shading::curvature,
                                 Shading::level};

Picture picture_of(Shading shading) {
  Picture picture;
  picture.shading = shading;
  picture.has_occlusion = false;
  return picture;
}

class RendererShadingsGl : public RendererScene {
 protected:
  Rgb middle(const Image& image) { return rgb_at(image, kWidth / 2, kHeight / 2); }
};

TEST_F(RendererShadingsGl, MatcapIsWarmAndLitFromTheUpperLeft) {
  put(ball_block(10.0, 6));
  const Image image = draw(picture_of(Shading::matcap));
  const Rgb clay = middle(image);
  EXPECT_GT(clay.red, clay.green + 20);
  EXPECT_GT(clay.green, clay.blue);
  EXPECT_GT(rgb_at(image, kWidth / 2 - 25, kHeight / 2 - 25).sum(),
            rgb_at(image, kWidth / 2 + 25, kHeight / 2 + 25).sum() + 60);
}

TEST_F(RendererShadingsGl, PlainIsNearlyGreyAndDarkerInACorner) {
  // Two balls that touch: the sky is half hidden from where they do.
  put(ball_block(6.0, 6, 0, {-6.0, 0.0, 0.0}));
  BlockMesh other = ball_block(6.0, 6, 0, {6.0, 0.0, 0.0});
  other.id.origin = {1, 0, 0};
  put(other);
  // So far that both balls are within the reach of the occlusion, which is a share of the picture.
  camera_.zoom(0.75, {0.5 * kWidth, 0.5 * kHeight});
  const Image open = draw(picture_of(Shading::plain));
  Picture with = picture_of(Shading::plain);
  with.has_occlusion = true;
  const Image shut = draw(with);
  const Vec3 corner = projected(camera_, {-0.3, -1.87, 0.0});
  const int x = static_cast<int>(corner.x);
  const int y = static_cast<int>(corner.y);
  EXPECT_NEAR(rgb_at(open, x, y).red, rgb_at(open, x, y).blue, 16);
  EXPECT_LT(rgb_at(shut, x, y).sum(), 0.85 * rgb_at(open, x, y).sum());
  const Vec3 top = projected(camera_, {-6.0, -6.0, 0.0});
  const Rgb bare = rgb_at(open, static_cast<int>(top.x), static_cast<int>(top.y));
  EXPECT_GE(rgb_at(shut, static_cast<int>(top.x), static_cast<int>(top.y)).sum(),
            0.95 * bare.sum());
  EXPECT_EQ(rgb_at(shut, 5, 5), rgb_at(open, 5, 5)) << "the background has no occlusion";
}

TEST_F(RendererShadingsGl, CurvatureIsLightOnABallAndDarkInAHollow) {
  put(ball_block(10.0, 7));
  const int ridge = middle(draw(picture_of(Shading::curvature))).sum();
  renderer_->clear();
  // The inside of the ball's far half: the same ball turned inside out.
  BlockMesh hollow = ball_block(10.0, 7);
  for (Triangle& t : hollow.triangles) std::swap(t[1], t[2]);
  for (DisplayVertex& v : hollow.vertices)
    for (float& n : v.normal) n = -n;
  put(hollow);
  const int valley = middle(draw(picture_of(Shading::curvature))).sum();
  EXPECT_GT(ridge, valley + 60);
}

TEST_F(RendererShadingsGl, EachLevelHasAColourOfItsOwn) {
  std::vector<Rgb> colors;
  for (int level = 0; level < 7; ++level) {
    renderer_->clear();
    put(ball_block(10.0, 5, level));
    colors.push_back(middle(draw(picture_of(Shading::level))));
  }
  for (std::size_t a = 0; a < colors.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const int apart = std::abs(colors[a].red - colors[b].red) +
                        std::abs(colors[a].green - colors[b].green) +
                        std::abs(colors[a].blue - colors[b].blue);
      EXPECT_GT(apart, 60) << a << " and " << b;
    }
  }
}

TEST_F(RendererShadingsGl, HeldClayIsDarkerInEveryShading) {
  const BlockMesh free = ball_block(10.0, 6);
  BlockMesh masked = free;
  for (const DisplayVertex& v : free.vertices)
    masked.mask.push_back(v.position_mm[0] > 0.0F ? 255 : 0);
  for (const Shading shading : kShadings) {
    renderer_->clear();
    put(free);
    const Image bare = draw(picture_of(shading));
    put(masked);
    const Image dark = draw(picture_of(shading));
    EXPECT_EQ(rgb_at(dark, kWidth / 2 - 30, kHeight / 2),
              rgb_at(bare, kWidth / 2 - 30, kHeight / 2));
    EXPECT_LT(rgb_at(dark, kWidth / 2 + 30, kHeight / 2).sum(),
              0.75 * rgb_at(bare, kWidth / 2 + 30, kHeight / 2).sum());
    put(free);
    EXPECT_EQ(draw(picture_of(shading)).rgb, bare.rgb) << "let go again";
  }
}

TEST_F(RendererShadingsGl, WiresDarkenOnlyEdges) {
  put(ball_block(10.0, 2));
  for (const Shading shading : kShadings) {
    Picture picture = picture_of(shading);
    const Image bare = draw(picture);
    picture.has_wires = true;
    const Image wired = draw(picture);
    int darker = 0;
    int same = 0;
    for (int y = 60; y < 180; ++y) {
      for (int x = 100; x < 220; ++x) {
        const int change = rgb_at(wired, x, y).sum() - rgb_at(bare, x, y).sum();
        EXPECT_LE(change, 0);
        darker += change < -20 ? 1 : 0;
        same += change == 0 ? 1 : 0;
      }
    }
    EXPECT_GT(darker, 500);
    EXPECT_GT(same, 5000);
  }
}

TEST_F(RendererShadingsGl, BackgroundIsAQuietGreyGradient) {
  const Image image = draw({});
  const Rgb top = rgb_at(image, kWidth / 2, 0);
  const Rgb bottom = rgb_at(image, kWidth / 2, kHeight - 1);
  EXPECT_GT(top.sum(), bottom.sum() + 60);
  for (const Rgb& c : {top, bottom}) EXPECT_NEAR(c.red, c.blue, 12);
}

/// What those who draw in this context may leave on.
void leave_all_on() {
  for (const GLenum on : std::initializer_list<GLenum>{
           GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_BLEND, GL_CULL_FACE, GL_PRIMITIVE_RESTART,
           GL_FRAMEBUFFER_SRGB, GL_COLOR_LOGIC_OP, GL_RASTERIZER_DISCARD, GL_POLYGON_OFFSET_FILL,
           GL_CLIP_DISTANCE0})
    glEnable(on);
  glScissor(0, 0, 10, 10);
  glViewport(3, 3, 20, 20);
  glBlendFunc(GL_ZERO, GL_ZERO);
  glBlendEquation(GL_MIN);
  glStencilFunc(GL_NEVER, 0, 0);
  glCullFace(GL_FRONT);
  glFrontFace(GL_CW);
  glDepthFunc(GL_NEVER);
  glDepthMask(GL_FALSE);
  glDepthRange(1.0, 0.0);
  glClearDepth(0.0);
  glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
  glPolygonOffset(50.0F, 50.0F);
  glActiveTexture(GL_TEXTURE5);
}

TEST_F(RendererShadingsGl, WhatOthersLeftOnChangesNothing) {
  const BlockMesh ball = ball_block(10.0, 4);
  put(ball);
  Picture picture = picture_of(Shading::plain);
  picture.has_occlusion = picture.has_wires = true;
  picture.rings.push_back({{0.0, -10.0, 0.0}, {0.0, -1.0, 0.0}, 4.0});
  picture.arrows.push_back({{0.0, -10.0, 0.0}, {5.0, -12.0, 0.0}});
  const Image expected = draw(picture);
  leave_all_on();
  EXPECT_EQ(draw(picture).rgb, expected.rgb) << "shown again";
  put(ball);
  leave_all_on();
  EXPECT_EQ(draw(picture).rgb, expected.rgb) << "drawn again";
  EXPECT_EQ(renderer_->counts().pictures, 2);
}

TEST_F(RendererShadingsGl, APictureDrawnTwiceHasTheSameBits) {
  put(ball_block(10.0, 4));
  for (const Shading shading : kShadings) {
    Picture picture = picture_of(shading);
    picture.has_occlusion = true;
    const Image first = draw(picture);
    draw({});
    EXPECT_EQ(draw(picture).rgb, first.rgb);
  }
}

}  // namespace
}  // namespace argil::test
