// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"

#include "picture/camera.h"
#include "picture/renderer.h"
#include "viewer/support/offscreen.h"

namespace argil::test {

using viewer::BlockMesh;
using viewer::Camera;
using viewer::Picture;
using viewer::Renderer;

/// A ball about the origin of 8 * 4^splits triangles, as one block.
BlockMesh ball_block(double radius_mm, int splits, int level = 0, const Vec3& center_mm = {});

/// All that a renderer needs of a clay, the mask included.
std::vector<BlockMesh> blocks_of(const Clay& clay, const std::optional<DisplayView>& view = {});

/// 0 to 255; a pixel's centre is at + 0.5.
struct Rgb {
  int red = 0;
  int green = 0;
  int blue = 0;
  int sum() const { return red + green + blue; }
  friend bool operator==(const Rgb&, const Rgb&) = default;
};
Rgb rgb_at(const Image& image, int x, int y);

/// A context, a renderer in it and a camera in front of it. Skips where there is no OpenGL; fails
/// where OpenGL reported an error.
class RendererScene : public ::testing::Test {
 protected:
  static constexpr int kWidth = 320;
  static constexpr int kHeight = 240;

  void SetUp() override;
  void TearDown() override;

  void put(const BlockMesh& block);
  /// From -y, z up, all of a box of this half size in the picture.
  void look_at(double half_size_mm);
  /// The picture's lens is the camera's, for content of the half size that was looked at.
  Image draw(Picture picture);

  Camera camera_;
  Box3 content_mm_;
  std::unique_ptr<Offscreen> screen_;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace argil::test
