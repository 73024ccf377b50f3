// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/scene_distance.h"

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

namespace argil::viewer {
namespace {

/// Balls that reach into each other, so that the second is often the one that counts within the
/// first.
TEST(SceneDistance, IsThatOfTheUnionWherePiecesOverlap) {
  Sculpture sculpture(Clay::ball(20.0, {}).value());
  AddPiece add;
  add.look.name = "Ball";
  add.look.placement.position_mm = {12.0, 0.0, 0.0};
  add.clay = std::make_shared<const Clay>(Clay::ball(10.0, {}).value());
  ASSERT_TRUE(sculpture.apply(PieceEdit{add}).ok());
  const SceneDistance scene(sculpture);
  // Where both fields tell the distance; farther away they end.
  for (double x = -22.0; x <= 25.0; x += 1.0) {
    const Vec3 p{x, 0.5, -0.5};
    const double wanted = std::min(sculpture.clay(0).distance_at(p),
                                   sculpture.clay(1).distance_at(p - Vec3{12.0, 0.0, 0.0}));
    EXPECT_DOUBLE_EQ(scene.at(p), wanted) << x;
  }
}

}  // namespace
}  // namespace argil::viewer
