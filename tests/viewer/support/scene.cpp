// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/support/scene.h"

#include <algorithm>
#include <cmath>

#include "argil/engine/display_surface.h"

#include "gl/gl_renderer.h"
#include "support/shapes.h"

namespace argil::test {
namespace {

std::array<float, 3> narrow(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

BlockMesh ball_block(double radius_mm, int splits, int level, const Vec3& center_mm) {
  const TriangleMesh mesh = ball_mesh(radius_mm, splits, center_mm);
  BlockMesh block;
  block.id.level = level;
  for (const Vec3& p : mesh.positions)
    block.vertices.push_back({narrow(p), narrow(normalized(p - center_mm))});
  block.triangles = mesh.triangles;
  block.bounds_mm = bounds(mesh);
  return block;
}

std::vector<BlockMesh> blocks_of(const Clay& clay, const std::optional<DisplayView>& view) {
  DisplaySurface surface;
  EXPECT_TRUE(surface.update(clay, view).ok());
  std::vector<BlockMesh> blocks;
  for (const BlockId& id : surface.blocks()) {
    const DisplayBlock from = surface.block(id);
    BlockMesh block{id,
                    {from.vertices.begin(), from.vertices.end()},
                    {from.triangles.begin(), from.triangles.end()},
                    {},
                    from.bounds_mm};
    bool is_masked = false;
    for (const DisplayVertex& v : from.vertices) {
      const auto& p = v.position_mm;
      const double masked = clay.mask_at(
          {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
      block.mask.push_back(static_cast<std::uint8_t>(std::lround(255.0 * masked)));
      is_masked = is_masked || masked > 0.0;
    }
    if (!is_masked) block.mask.clear();
    blocks.push_back(std::move(block));
  }
  return blocks;
}

Rgb rgb_at(const Image& image, int x, int y) {
  const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x));
  return {image.rgb.at(at), image.rgb.at(at + 1), image.rgb.at(at + 2)};
}

void RendererScene::SetUp() {
  std::string why_not;
  screen_ = Offscreen::make(kWidth, kHeight, why_not);
  if (screen_ == nullptr) GTEST_SKIP() << why_not;
  auto made = viewer::make_gl_renderer_with({});
  ASSERT_TRUE(made.ok()) << made.error().message;
  renderer_ = std::move(made).value();
  camera_.resize(kWidth, kHeight);
  look_at(12.0);
}

void RendererScene::TearDown() {
  if (renderer_ == nullptr) return;
  EXPECT_EQ(renderer_->counts().errors, 0) << renderer_->last_error();
  renderer_.reset();
}

void RendererScene::put(const BlockMesh& block) {
  const auto done = renderer_->put(0, block);
  ASSERT_TRUE(done.ok()) << done.error().message;
}

void RendererScene::look_at(double half_size_mm) {
  const double s = half_size_mm;
  content_mm_ = {{-s, -s, -s}, {s, s, s}};
  camera_.look_from({0.0, -1.0, 0.0}, {0.0, 0.0, 1.0});
  camera_.frame(content_mm_);
}

Image RendererScene::draw(Picture picture) {
  picture.lens = camera_.lens(content_mm_);
  const auto drawn = renderer_->draw(picture, screen_->framebuffer(), kWidth, kHeight);
  EXPECT_TRUE(drawn.ok()) << drawn.error().message;
  return renderer_->read_image(screen_->framebuffer(), kWidth, kHeight);
}

}  // namespace argil::test
