// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn anew, and what is left out: the picture must be the one that all of it would give.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "argil/engine/display_surface.h"

#include "gl/gl_renderer.h"
#include "picture/stereo.h"
#include "support/bumpy_clay.h"
#include "support/stroke_maker.h"
#include "viewer/support/scene.h"

namespace argil::test {
namespace {

constexpr double kBallRadiusMm = 20.0;

/// How many pixels of two pictures of the same size differ.
std::size_t count_different(const Image& a, const Image& b) {
  std::size_t count = 0;
  for (std::size_t n = 0; n + 2 < a.rgb.size(); n += 3) {
    if (!std::equal(&a.rgb[n], &a.rgb[n] + 3, &b.rgb[n])) ++count;
  }
  return count;
}

/// A renderer that follows a clay.
class RendererPartsGl : public RendererScene {
 protected:
  void SetUp() override {
    RendererScene::SetUp();
    if (renderer_ == nullptr) return;
    auto made = bumpy_ball(kBallRadiusMm, 0.25);
    ASSERT_TRUE(made.ok());
    clay_.emplace(std::move(made).value());
    look_at(1.2 * kBallRadiusMm);
    take_all();
  }

  void take_all() {
    ASSERT_TRUE(surface_.update(*clay_).ok());
    renderer_->clear();
    for (const BlockMesh& block : blocks_of(*clay_)) put(block);
  }

  /// A dab on the side that is looked at, and what it changed. `x_mm` across the picture.
  void carve_at(double x_mm) {
    const Vec3 at{x_mm, -std::sqrt(kBallRadiusMm * kBallRadiusMm - x_mm * x_mm), 0.0};
    ASSERT_TRUE(clay_->apply(stroke_of(Action::carve, 1.0, 1.0, {at})).ok());
    ASSERT_TRUE(surface_.update(*clay_).ok());
    for (const BlockId& id : surface_.gone()) renderer_->drop(0, id);
    for (const BlockId& id : surface_.changed()) {
      const DisplayBlock from = surface_.block(id);
      put({id,
           {from.vertices.begin(), from.vertices.end()},
           {from.triangles.begin(), from.triangles.end()},
           {},
           from.bounds_mm});
    }
  }

  Image draw_stereo(Picture picture, bool is_stereo) {
    if (!is_stereo) return draw(std::move(picture));
    const auto parts = viewer::parts_of(camera_, true);
    picture.lens = parts[0].camera.lens(content_mm_);
    picture.right_lens = parts[1].camera.lens(content_mm_);
    EXPECT_TRUE(renderer_->draw(picture, screen_->framebuffer(), kWidth, kHeight).ok());
    return renderer_->read_image(screen_->framebuffer(), kWidth, kHeight);
  }

  std::optional<Clay> clay_;
  DisplaySurface surface_;
};

TEST_F(RendererPartsGl, MarksThatMoveDrawNoClay) {
  renderer_.reset();
  auto made = viewer::make_gl_renderer_with({4, false});
  ASSERT_TRUE(made.ok()) << made.error().message;
  renderer_ = std::move(made).value();
  take_all();
  Picture picture;
  picture.arrows.push_back({{0.0, -28.0, 6.0}, {0.0, -20.0, 0.0}, {0.2, 0.5, 1.0}});
  draw(picture);
  const std::int64_t whole = renderer_->counts().whole_pictures;
  picture.rings.push_back({{4.0, -19.6, 0.0}, {0.2, -0.98, 0.0}, 2.0, {1.0, 0.5, 0.2}, true});
  picture.planes.push_back({{}, {1.0, 0.0, 0.0}, 24.0});
  picture.pins.push_back({{0.0, -20.0, 8.0}});
  const Image moved = draw(picture);
  const auto depth = renderer_->read_depth().depth_mm;
  EXPECT_EQ(renderer_->counts().whole_pictures, whole);
  take_all();
  EXPECT_EQ(count_different(draw(picture), moved), 0U);
  EXPECT_TRUE(renderer_->read_depth().depth_mm == depth);
  EXPECT_EQ(renderer_->counts().whole_pictures, whole + 1);
}

/// Without several samples a pixel: at the edges of parts llvmpipe leaves out samples, not pixels.
TEST_F(RendererPartsGl, ADabDrawsThePartsThatItTouchedAndTheRestIsAsItWas) {
  for (const bool is_parallel : {false, true}) {
    for (const bool is_stereo : {false, true}) {
      SCOPED_TRACE(testing::Message() << "parallel " << is_parallel << ", stereo " << is_stereo);
      camera_.set_parallel(is_parallel);
      const Image before = draw_stereo({}, is_stereo);
      const auto counts = renderer_->counts();
      // On both sides, as with a plane of symmetry.
      carve_at(-8.0);
      carve_at(8.0);
      const Image after = draw_stereo({}, is_stereo);
      EXPECT_GT(count_different(after, before), 20U);
      EXPECT_EQ(renderer_->counts().whole_pictures, counts.whole_pictures);
      EXPECT_LT(renderer_->counts().drawn_triangles, counts.drawn_triangles / 2);
      const auto depth = renderer_->read_depth().depth_mm;
      take_all();
      EXPECT_EQ(count_different(draw_stereo({}, is_stereo), after), 0U);
      EXPECT_TRUE(renderer_->read_depth().depth_mm == depth);
    }
  }
}

TEST_F(RendererPartsGl, ADabThatMeetsTheEyeOrWhatIsAroundItDrawsAllOfIt) {
  Picture plain;
  plain.shading = viewer::Shading::plain;
  draw(plain);
  const std::int64_t whole = renderer_->counts().whole_pictures;
  carve_at(0.0);
  const Image after = draw(plain);
  EXPECT_EQ(renderer_->counts().whole_pictures, whole + 1) << "occlusion reaches beyond it";
  take_all();
  EXPECT_EQ(count_different(draw(plain), after), 0U);

  camera_.zoom(60.0, {160.0, 120.0});
  draw({});
  carve_at(0.0);
  const Image near = draw({});
  take_all();
  EXPECT_EQ(count_different(draw({}), near), 0U);
}

/// Of a channel of a pixel, 0 to 255.
double mean_difference(const Image& a, const Image& b) {
  double sum = 0.0;
  for (std::size_t n = 0; n < a.rgb.size(); ++n) sum += std::abs(a.rgb[n] - b.rgb[n]);
  return sum / static_cast<double>(a.rgb.size());
}

TEST_F(RendererPartsGl, AMovingPictureHasFewerTrianglesAndPixelsAndNoHole) {
  renderer_.reset();
  auto made = viewer::make_gl_renderer_with({0, true});
  ASSERT_TRUE(made.ok()) << made.error().message;
  renderer_ = std::move(made).value();
  take_all();
  Picture picture;
  const Image still = draw(picture);
  const auto fine = renderer_->read_depth().depth_mm;
  const std::int64_t triangles = renderer_->counts().drawn_triangles;
  picture.is_moving = true;
  const Image moving = draw(picture);
  const viewer::DepthMap coarse = renderer_->read_depth();
  EXPECT_LT(renderer_->counts().drawn_triangles, triangles / 2);
  EXPECT_EQ(coarse.width, (kWidth + 1) / 2);
  ASSERT_EQ(coarse.depth_mm.size(), static_cast<std::size_t>(coarse.width * coarse.height));
  EXPECT_LT(mean_difference(moving, still), 4.0);
  // Where clay is on all sides of a pixel, there is clay in it, at about the same depth.
  std::size_t inside = 0;
  for (std::size_t n = 3 * kWidth; n + 3 * kWidth < fine.size(); ++n) {
    bool is_inside = true;
    for (const std::ptrdiff_t step : {-3 * kWidth, -3, 0, 3, 3 * kWidth})
      is_inside = is_inside && std::isfinite(fine[n + static_cast<std::size_t>(step)]);
    if (!is_inside) continue;
    ++inside;
    const std::size_t row = n / kWidth / 2;
    const std::size_t column = n % kWidth / 2;
    ASSERT_NEAR(coarse.depth_mm[row * static_cast<std::size_t>(coarse.width) + column], fine[n],
                2.5)
        << n;
  }
  EXPECT_GT(inside, 10'000U);
  picture.is_moving = false;
  EXPECT_EQ(count_different(draw(picture), still), 0U);
}

/// They are tested against a depth that was drawn in fewer pixels.
TEST_F(RendererPartsGl, MarksOfAMovingPictureAreHiddenByTheSameClay) {
  renderer_.reset();
  auto made = viewer::make_gl_renderer_with({0, true});
  ASSERT_TRUE(made.ok()) << made.error().message;
  renderer_ = std::move(made).value();
  take_all();
  const auto seen = [&](bool is_moving, double y_mm, bool is_pin) {
    Picture picture;
    picture.is_moving = is_moving;
    const Image without = draw(picture);
    if (is_pin) {
      picture.pins.push_back({{0.0, y_mm, 0.0}});
    } else {
      picture.rings.push_back({{0.0, y_mm, 0.0}, {0.0, -1.0, 0.0}, 8.0});
    }
    return mean_difference(draw(picture), without);
  };
  for (const bool is_pin : {false, true}) {
    const double before = seen(false, -24.0, is_pin);
    const double behind = seen(false, 24.0, is_pin);
    ASSERT_GT(before, 1.5 * behind);
    EXPECT_NEAR(seen(true, -24.0, is_pin), before, 0.1 * before);
    EXPECT_NEAR(seen(true, 24.0, is_pin), behind, 0.1 * behind);
  }
}

TEST_F(RendererPartsGl, WhatLooksAwayIsLeftOut) {
  for (const bool is_parallel : {false, true}) {
    camera_.set_parallel(is_parallel);
    draw({});
    const auto counts = renderer_->counts();
    EXPECT_LT(counts.drawn_triangles, 7 * counts.triangles / 10) << "bumps look aside";
    EXPECT_GT(counts.drawn_triangles, counts.triangles / 2);
  }
  // A cut shows it from inside.
  Picture cut;
  cut.slice = viewer::SlicePicture{
      {-24.0, 0.0, 24.0}, {48.0, 0.0, 0.0}, {0.0, 0.0, -48.0}, 2, 2, {1.0F, 1.0F, 1.0F, 1.0F}};
  draw(cut);
  const auto counts = renderer_->counts();
  EXPECT_GT(counts.drawn_triangles, 4 * counts.triangles / 10) << "the half behind the cut";
}

}  // namespace
}  // namespace argil::test
