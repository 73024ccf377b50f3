// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "argil/core/vec3.h"

#include "picture/camera.h"
#include "viewer/support/window_run.h"

namespace argil::test {

/// As a line of a script names a pixel.
std::string pixel_words(const viewer::Camera::Pixel& pixel);

/// s.vdb holds a block, "Body", and a ball of 9 mm, "Head", that stands turned on it.
class TwoPiecesTest : public WindowTest {
 protected:
  /// Seen from wherever the window looks, also before it has framed them: what is uploaded does not
  /// depend on when the document hears of that.
  static constexpr double kPieceVoxelMm = 0.5;
  const Placement head_place_{{4.0, 0.0, 21.5}, normalized(Quat{0.9, 0.0, 0.4, 0.0})};

  void SetUp() override;
  /// Where the window shows a place, when it was just opened.
  std::string at(const Vec3& place) const { return pixel_words(camera_.pixel_of(place)); }

  viewer::Camera camera_;
};

}  // namespace argil::test
