// SPDX-License-Identifier: GPL-3.0-or-later
// Several pieces in one picture: each is drawn where it stands, from blocks in its own frame.
#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "gl/gl_renderer.h"
#include "picture/piece_frame.h"
#include "support/bumpy_clay.h"
#include "viewer/support/scene.h"

namespace argil::test {
namespace {

using viewer::placed;
using viewer::ShownPiece;

/// The fraction of pixels in which two pictures differ by more than rounding.
double different(const Image& a, const Image& b) {
  std::size_t count = 0;
  for (std::size_t n = 0; n + 2 < a.rgb.size(); n += 3) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c)
      most = std::max(most, std::abs(a.rgb[n + c] - b.rgb[n + c]));
    if (most > 6) ++count;
  }
  return static_cast<double>(count) / (static_cast<double>(a.rgb.size()) / 3.0);
}

std::array<float, 3> moved_point(const Placement& placement, const std::array<float, 3>& p,
                                 bool is_direction) {
  Vec3 v{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  v = is_direction ? viewer::turned(placement, v) : placed(placement, v);
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// The same block as if its piece had been made where it stands.
BlockMesh stood(BlockMesh block, const Placement& placement) {
  for (DisplayVertex& vertex : block.vertices) {
    vertex.position_mm = moved_point(placement, vertex.position_mm, false);
    vertex.normal = moved_point(placement, vertex.normal, true);
  }
  block.bounds_mm = placed(placement, block.bounds_mm);
  return block;
}

class RendererPiecesGl : public RendererScene {
 protected:
  void SetUp() override {
    RendererScene::SetUp();
    if (renderer_ == nullptr) return;
    const auto made = bumpy_ball(6.0, 0.25);
    ASSERT_TRUE(made.ok());
    blocks_ = blocks_of(made.value());
    look_at(16.0);
    camera_.look_from(normalized(Vec3{0.4, -1.0, 0.5}), {0.0, 0.0, 1.0});
  }

  void put_all(viewer::PieceKey piece) {
    for (const BlockMesh& block : blocks_) ASSERT_TRUE(renderer_->put(piece, block).ok());
  }
  /// The first in its place, the second turned and moved; strokes go to the first.
  Picture two() const {
    Picture picture;
    picture.pieces = {ShownPiece{1}, ShownPiece{2, beside_}};
    picture.pieces[1].is_active = false;
    return picture;
  }

  const Placement beside_ =
      viewer::turned_about({{7.0, 3.0, 4.0}, {}}, {7.0, 3.0, 4.0}, normalized(Vec3{1, 2, 3}), 70.0);
  std::vector<BlockMesh> blocks_;
};

TEST_F(RendererPiecesGl, EachIsDrawnWhereItStandsAsOneClayOfBothWouldBe) {
  for (BlockMesh block : blocks_) {
    ASSERT_TRUE(renderer_->put(0, block).ok());
    block = stood(std::move(block), beside_);
    block.id.origin[0] += 8000;
    ASSERT_TRUE(renderer_->put(0, block).ok());
  }
  for (const viewer::Shading shading : {viewer::Shading::matcap, viewer::Shading::plain,
                                        viewer::Shading::curvature, viewer::Shading::level}) {
    Picture one;
    one.shading = shading;
    const Image merged = draw(one);
    const viewer::DepthMap depth = renderer_->read_depth();
    EXPECT_TRUE(depth.is_other.empty());
    put_all(1);
    put_all(2);
    Picture both = two();
    both.shading = shading;
    EXPECT_LT(different(merged, draw(both)), 0.004) << static_cast<int>(shading);
    const viewer::DepthMap own = renderer_->read_depth();
    std::size_t wrong = 0;
    for (std::size_t n = 0; n < own.depth_mm.size(); ++n) {
      const bool is_same = std::isinf(own.depth_mm[n]) == std::isinf(depth.depth_mm[n]) &&
                           !(std::abs(own.depth_mm[n] - depth.depth_mm[n]) > 0.02F);
      wrong += is_same ? 0 : 1;
    }
    EXPECT_LT(wrong, own.depth_mm.size() / 500);
    renderer_->drop(1);
    renderer_->drop(2);
  }
}

TEST_F(RendererPiecesGl, MovingAPieceUploadsNothingAndShowsItThere) {
  put_all(1);
  put_all(2);
  Picture picture = two();
  const Image before = draw(picture);
  const auto uploaded = renderer_->counts().uploaded_bytes;
  picture.pieces[1].placement = viewer::moved(beside_, {-12.0, 0.0, -2.0});
  const Image after = draw(picture);
  EXPECT_EQ(renderer_->counts().uploaded_bytes, uploaded);
  EXPECT_GT(different(before, after), 0.05);
  renderer_->clear();
  put_all(1);
  put_all(2);
  EXPECT_EQ(draw(picture).rgb, after.rgb);
}

TEST_F(RendererPiecesGl, AnEditOfATurnedPieceDrawsWhatAllOfThePictureWould) {
  put_all(1);
  put_all(2);
  draw(two());
  const auto whole = renderer_->counts().whole_pictures;
  // The block of the turned piece that is seen best.
  const auto nearest =
      std::min_element(blocks_.begin(), blocks_.end(), [&](const BlockMesh& a, const BlockMesh& b) {
        const Vec3 eye = camera_.lens({}).eye_mm;
        return length(placed(beside_, a.bounds_mm.center()) - eye) <
               length(placed(beside_, b.bounds_mm.center()) - eye);
      });
  BlockMesh changed = *nearest;
  for (DisplayVertex& vertex : changed.vertices) vertex.normal = {0.0F, 0.0F, 1.0F};
  ASSERT_TRUE(renderer_->put(2, changed).ok());
  const Image after = draw(two());
  EXPECT_EQ(renderer_->counts().whole_pictures, whole) << "only a part was drawn";
  Picture again = two();
  again.has_occlusion = false;  // of another picture: all is drawn
  EXPECT_EQ(draw(again).rgb, after.rgb);
  EXPECT_GT(renderer_->counts().whole_pictures, whole);
}

TEST_F(RendererPiecesGl, AColourIsThatOfItsPieceAlone) {
  put_all(1);
  put_all(2);
  Picture picture = two();
  picture.pieces[1].color = Vec3{0.05, 0.1, 0.8};
  const Image image = draw(picture);
  const auto at = [&](const Vec3& point) {
    const auto pixel = camera_.pixel_of(point);
    return rgb_at(image, static_cast<int>(pixel.x), static_cast<int>(pixel.y));
  };
  const Rgb clay = at({-3.0, 0.0, 0.0});
  EXPECT_GT(clay.red, clay.blue);
  const Rgb blue = at(beside_.position_mm);
  EXPECT_GT(blue.blue, 2 * blue.red);
}

TEST_F(RendererPiecesGl, TheDepthTellsWhereAnotherPieceIsInFront) {
  put_all(1);
  put_all(2);
  draw(two());
  const auto is_other = [&](const Vec3& point) {
    const viewer::DepthMap map = renderer_->read_depth();
    const auto pixel = camera_.pixel_of(point);
    return static_cast<int>(map.is_other.at(static_cast<std::size_t>(pixel.y) * kWidth +
                                            static_cast<std::size_t>(pixel.x)));
  };
  EXPECT_EQ(is_other({-3.0, 0.0, 0.0}), 0);
  EXPECT_EQ(is_other(beside_.position_mm), 1);
  // A copy that lies in its original hides nothing of it.
  Picture copy = two();
  copy.pieces[1].placement = {};
  draw(copy);
  const viewer::DepthMap map = renderer_->read_depth();
  EXPECT_EQ(std::count(map.is_other.begin(), map.is_other.end(), 1), 0);
  // Hidden ones are not there.
  copy.pieces.pop_back();
  draw(copy);
  EXPECT_TRUE(renderer_->read_depth().is_other.empty());
}

}  // namespace
}  // namespace argil::test
