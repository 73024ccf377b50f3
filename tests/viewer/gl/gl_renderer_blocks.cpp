// SPDX-License-Identifier: GPL-3.0-or-later
// What is uploaded, kept, left out and freed.
#include <cstdint>
#include <map>
#include <random>
#include <utility>

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "argil/engine/display_surface.h"

#include "gl/gl_renderer.h"
#include "support/bumpy_clay.h"
#include "support/effort.h"
#include "support/stroke_maker.h"
#include "viewer/support/scene.h"

namespace argil::test {
namespace {

/// Triangles are sent with their room, a multiple of 16.
std::int64_t upload_of(const BlockMesh& block) {
  const std::size_t room = (block.triangles.size() + 15) / 16 * 16;
  return static_cast<std::int64_t>(24 * block.vertices.size() + 12 * room + block.mask.size());
}

/// A small copy of a ball at a node of a lattice.
BlockMesh small_ball(int i, int j, int splits = 1) {
  BlockMesh block = ball_block(0.4, splits, 0, {i - 9.5, 0.0, j - 9.5});
  block.id.origin = {8 * i, 0, 8 * j};
  return block;
}

/// What OpenGL itself knows of in this context. Names are given from 1 on and used again.
std::int64_t live_objects() {
  constexpr GLuint kMostNames = 1U << 14;
  std::int64_t count = 0;
  for (GLuint name = 1; name <= kMostNames; ++name) {
    count += glIsBuffer(name) + glIsVertexArray(name) + glIsTexture(name) + glIsFramebuffer(name) +
             glIsRenderbuffer(name) + glIsProgram(name);
  }
  return count;
}

constexpr int kBeyondAnyCard = 1 << 20;  // pixels

class RendererBlocksGl : public RendererScene {};

TEST_F(RendererBlocksGl, UploadsTheChangedBlocksAndNothingElse) {
  auto made = bumpy_ball(16.0, 0.5);
  ASSERT_TRUE(made.ok());
  Clay clay = std::move(made).value();
  DisplaySurface surface;
  ASSERT_TRUE(surface.update(clay).ok());
  std::int64_t expected = 0;
  for (const BlockMesh& block : blocks_of(clay)) {
    put(block);
    expected += upload_of(block);
  }
  const auto all = renderer_->counts();
  EXPECT_EQ(all.blocks, surface.stats().blocks);
  EXPECT_EQ(all.triangles, surface.stats().triangles);
  EXPECT_EQ(all.uploaded_bytes, expected);

  ASSERT_TRUE(clay.apply(stroke_of(Action::carve, 2.0, 1.0, {{0.0, -16.0, 0.0}})).ok());
  ASSERT_TRUE(surface.update(clay).ok());
  ASSERT_FALSE(surface.changed().empty());
  expected = 0;
  for (const BlockId& id : surface.gone()) renderer_->drop(0, id);
  for (const BlockId& id : surface.changed()) {
    const DisplayBlock from = surface.block(id);
    const BlockMesh block{id,
                          {from.vertices.begin(), from.vertices.end()},
                          {from.triangles.begin(), from.triangles.end()},
                          {},
                          from.bounds_mm};
    expected += upload_of(block);
    put(block);
  }
  const auto after = renderer_->counts();
  EXPECT_EQ(after.uploaded_bytes - all.uploaded_bytes, expected);
  EXPECT_LT(expected, all.uploaded_bytes / 4);
  EXPECT_EQ(after.triangles, surface.stats().triangles);
  EXPECT_EQ(after.blocks, surface.stats().blocks);
}

TEST_F(RendererBlocksGl, HeldVerticesAreAByteEach) {
  BlockMesh block = small_ball(3, 4);
  block.mask.assign(block.vertices.size(), 200);
  put(block);
  EXPECT_EQ(renderer_->counts().uploaded_bytes, upload_of(block));
}

TEST_F(RendererBlocksGl, AnEditedBlockTakesThePlaceOfTheOld) {
  put(small_ball(0, 0));
  const auto before = renderer_->counts();
  put(small_ball(0, 0, 3));
  const auto after = renderer_->counts();
  EXPECT_EQ(after.blocks, 1);
  EXPECT_EQ(after.triangles, 512);
  EXPECT_EQ(after.memory_bytes, before.memory_bytes);
  BlockMesh empty;
  empty.id = small_ball(0, 0).id;
  put(empty);
  EXPECT_EQ(renderer_->counts().blocks, 0);
}

TEST_F(RendererBlocksGl, APictureIsDrawnAgainOnlyWhenItOrTheBlocksChanged) {
  const BlockMesh ball = ball_block(5.0, 3);
  put(ball);
  look_at(10.0);
  std::int64_t drawn = 0;
  const auto draws = [&](const Picture& picture) {
    draw(picture);
    return renderer_->counts().pictures - std::exchange(drawn, renderer_->counts().pictures);
  };
  Picture picture;
  EXPECT_EQ(draws(picture), 1);
  const Image first = draw(picture);
  EXPECT_EQ(draws(picture), 0);
  EXPECT_EQ(draw(picture).rgb, first.rgb);
  EXPECT_EQ(renderer_->read_depth().depth_mm.size(), std::size_t{kWidth} * kHeight);

  picture.rings.push_back({{0.0, -5.0, 0.0}, {0.0, -1.0, 0.0}, 2.0});
  EXPECT_EQ(draws(picture), 1);
  EXPECT_EQ(draws(picture), 0);
  put(ball);
  EXPECT_EQ(draws(picture), 1);
  renderer_->drop(0, ball.id);
  EXPECT_EQ(draws(picture), 1);
  renderer_->clear();
  EXPECT_EQ(draws(picture), 1);
  EXPECT_EQ(draws(picture), 0);
  camera_.orbit(10.0, 0.0);
  EXPECT_EQ(draws(picture), 1);
}

TEST_F(RendererBlocksGl, DropAndClearFreeMemory) {
  const auto bare = renderer_->counts();
  EXPECT_EQ(bare.memory_bytes, 0);
  for (int i = 0; i < 20; ++i) put(small_ball(i, i));
  EXPECT_GT(renderer_->counts().memory_bytes, 0);
  EXPECT_GT(renderer_->counts().objects, bare.objects);
  for (int i = 0; i < 20; ++i) renderer_->drop(0, small_ball(i, i).id);
  EXPECT_EQ(renderer_->counts().memory_bytes, 0);
  EXPECT_EQ(renderer_->counts().objects, bare.objects);

  for (int i = 0; i < 20; ++i) put(small_ball(i, i));
  renderer_->clear();
  const auto cleared = renderer_->counts();
  EXPECT_EQ(cleared.memory_bytes, 0);
  EXPECT_EQ(cleared.objects, bare.objects);
  EXPECT_EQ(cleared.blocks, 0);
  EXPECT_EQ(cleared.triangles, 0);
}

TEST_F(RendererBlocksGl, ABlockLargerThanAPageHasOneOfItsOwn) {
  const BlockMesh large = ball_block(10.0, 9);  // 2 million triangles
  put(large);
  put(small_ball(1, 1));
  draw({});
  const auto counts = renderer_->counts();
  EXPECT_EQ(counts.drawn_triangles, counts.triangles);
  EXPECT_GE(counts.memory_bytes, upload_of(large));
}

TEST_F(RendererBlocksGl, LeavesOutBlocksBehindTheCameraAndBesideThePicture) {
  put(ball_block(2.0, 2));
  BlockMesh behind = ball_block(2.0, 2, 0, {0.0, -500.0, 0.0});
  behind.id.origin = {1, 0, 0};
  put(behind);
  BlockMesh beside = ball_block(2.0, 2, 0, {300.0, 0.0, 0.0});
  beside.id.origin = {2, 0, 0};
  put(beside);
  draw({});
  EXPECT_EQ(renderer_->counts().drawn_triangles, 128);
  EXPECT_EQ(renderer_->counts().triangles, 3 * 128);
}

TEST_F(RendererBlocksGl, LeavesOutNothingThatIsSeen) {
  // With all blocks in one there is nothing to leave out: both must give the same depth.
  const Clay clay = bumpy_ball(10.0, 0.5).value();
  const auto blocks = blocks_of(clay);
  BlockMesh whole;
  for (const BlockMesh& block : blocks) {
    const auto base = static_cast<std::uint32_t>(whole.vertices.size());
    whole.vertices.insert(whole.vertices.end(), block.vertices.begin(), block.vertices.end());
    for (const Triangle& t : block.triangles)
      whole.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    whole.bounds_mm.include(block.bounds_mm.min);
    whole.bounds_mm.include(block.bounds_mm.max);
  }
  for (const bool is_parallel : {false, true}) {
    look_at(12.0);
    camera_.set_parallel(is_parallel);
    camera_.zoom(6.0, {250.0, 60.0});
    renderer_->clear();
    put(whole);
    draw({});
    const auto expected = renderer_->read_depth().depth_mm;
    renderer_->clear();
    for (const BlockMesh& block : blocks) put(block);
    draw({});
    EXPECT_EQ(renderer_->read_depth().depth_mm, expected);
    EXPECT_LT(renderer_->counts().drawn_triangles, renderer_->counts().triangles / 2);
  }
}

TEST_F(RendererBlocksGl, ManyEditsInAnyOrderShowTheLastOfEach) {
  std::mt19937 random(3);
  RecordProperty("seed", 3);
  std::map<BlockId, BlockMesh> kept;
  for (int edit = 0; edit < 2000; ++edit) {
    const int i = static_cast<int>(random() % 20);
    const int j = static_cast<int>(random() % 20);
    BlockMesh block = small_ball(i, j, 1 + static_cast<int>(random() % 3));
    if (random() % 3 == 0) block.mask.assign(block.vertices.size(), 255);
    if (random() % 4 == 0) {
      renderer_->drop(0, block.id);
      kept.erase(block.id);
    } else {
      put(block);
      kept[block.id] = block;
    }
  }
  const Image edited = draw({});
  std::int64_t triangles = 0;
  for (const auto& [id, block] : kept)
    triangles += static_cast<std::int64_t>(block.triangles.size());
  EXPECT_EQ(renderer_->counts().triangles, triangles);
  EXPECT_EQ(renderer_->counts().blocks, static_cast<std::int64_t>(kept.size()));
  renderer_->clear();
  for (const auto& [id, block] : kept) put(block);
  EXPECT_EQ(draw({}).rgb, edited.rgb);
}

/// Usually thirty.
TEST_F(RendererBlocksGl, AHundredRenderersLeaveNoObject) {
  renderer_.reset();
  const std::int64_t before = live_objects();
  EXPECT_EQ(before, 2) << "what stands for the window, and its colour";
  for (int i = 0; i < effort(30, 100); ++i) {
    auto made = viewer::make_gl_renderer();
    ASSERT_TRUE(made.ok());
    renderer_ = std::move(made).value();
    put(small_ball(i % 20, i % 20));
    Picture picture;
    picture.shading = viewer::Shading::plain;
    picture.slice = viewer::SlicePicture{
        {-5.0, 0.0, 5.0}, {10.0, 0.0, 0.0}, {0.0, 0.0, -10.0}, 2, 2, {1.0F, 1.0F, 1.0F, 1.0F}};
    draw(picture);
    EXPECT_EQ(renderer_->counts().objects, live_objects() - before);
    EXPECT_EQ(renderer_->counts().errors, 0) << renderer_->last_error();
    renderer_.reset();
    EXPECT_EQ(live_objects(), before);
  }
}

TEST_F(RendererBlocksGl, AnotherSizeTakesTheSameObjects) {
  put(small_ball(9, 9));
  Picture picture;
  picture.shading = viewer::Shading::plain;
  draw(picture);
  const std::int64_t objects = renderer_->counts().objects;
  for (const auto& [width, height] : {std::pair{101, 77}, {1, 1}, {0, 0}, {kWidth, kHeight}}) {
    picture.lens = camera_.lens(content_mm_);
    EXPECT_TRUE(renderer_->draw(picture, screen_->framebuffer(), width, height).ok());
    EXPECT_EQ(renderer_->counts().objects, objects);
  }
}

TEST_F(RendererBlocksGl, SaysWhatSizeTheDriverCannotDrawAndDrawsAnother) {
  put(small_ball(9, 9));
  Picture picture;
  picture.shading = viewer::Shading::plain;
  const Image good = draw(picture);
  picture.lens = camera_.lens(content_mm_);
  for (int time = 0; time < 2; ++time) {
    const auto refused = renderer_->draw(picture, screen_->framebuffer(), kBeyondAnyCard, kHeight);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::device);
    for (const char* word : {"1048576 x 240 pixels (OpenGL's status", "pixels a side", "smaller"})
      EXPECT_NE(refused.error().message.find(word), std::string::npos) << refused.error().message;
    EXPECT_FALSE(renderer_->holds(picture, kBeyondAnyCard, kHeight));
    EXPECT_TRUE(renderer_->read_depth().depth_mm.empty());
  }
  EXPECT_EQ(renderer_->counts().pictures, 1);
  EXPECT_EQ(draw(picture).rgb, good.rgb);
  EXPECT_GT(renderer_->counts().errors, 0) << "a debug context hears of it too";
  renderer_.reset();
}

TEST_F(RendererBlocksGl, SaysHowManySamplesItAskedFor) {
  renderer_.reset();
  auto made = viewer::make_gl_renderer_with({4, false});
  ASSERT_TRUE(made.ok()) << made.error().message;
  const auto refused = made.value()->draw({}, screen_->framebuffer(), kBeyondAnyCard, kHeight);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("1048576 x 240 pixels with 4 samples each"),
            std::string::npos)
      << refused.error().message;
  EXPECT_EQ(made.value()->counts().pictures, 0);
}

TEST_F(RendererBlocksGl, CountsWhatADebugContextReports) {
  glEnable(0xFFFF);
  EXPECT_EQ(renderer_->counts().errors, 1);
  EXPECT_FALSE(renderer_->last_error().empty());
  renderer_.reset();
}

}  // namespace
}  // namespace argil::test
