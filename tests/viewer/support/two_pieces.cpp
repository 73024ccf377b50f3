// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/support/two_pieces.h"

#include <cmath>
#include <memory>

#include "argil/io/project_file.h"

#include "picture/piece_frame.h"

namespace argil::test {

std::string pixel_words(const viewer::Camera::Pixel& pixel) {
  return std::to_string(std::lround(pixel.x)) + " " + std::to_string(std::lround(pixel.y));
}

void TwoPiecesTest::SetUp() {
  WindowTest::SetUp();
  if (IsSkipped()) return;
  ClayOptions options;
  options.voxel_mm = kPieceVoxelMm;
  Sculpture sculpture(Clay::block({24.0, 20.0, 24.0}, options).value(), {"Body"});
  AddPiece head;
  head.look.name = "Head";
  head.look.placement = head_place_;
  head.clay = std::make_shared<const Clay>(Clay::ball(9.0, options).value());
  ASSERT_TRUE(sculpture.apply(head).ok());
  ASSERT_TRUE(sculpture.apply(SelectPiece{"Body"}).ok());
  ASSERT_TRUE(io::save_sculpture(folder_ / "s.vdb", sculpture).ok());
  Box3 box = sculpture.clay(0).bounds_mm();
  const Box3 other = viewer::placed(head_place_, sculpture.clay(1).bounds_mm());
  box.include(other.min);
  box.include(other.max);
  camera_ = first_camera(box);
}

}  // namespace argil::test
