// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/touch.h"

#include <cmath>

#include <gtest/gtest.h>

namespace argil::viewer {
namespace {

TEST(Feel, PushesOutwardTheMoreTheDeeperTheToolIsPressed) {
  const Clay clay = Clay::ball(20.0, {}).value();
  const SurfaceHit hit{{0.0, -20.0, 0.0}, {0.0, -1.0, 0.0}};
  Touch touch;
  touch.tool.radii_mm = {3.0, 3.0, 3.0};
  const auto force_at = [&](double press_mm) {
    touch.press_mm = press_mm;
    const auto felt = feel(clay, hit, touch);
    EXPECT_TRUE(felt);
    EXPECT_NEAR(felt->tool_mm.y, -20.0 + press_mm - 3.0, 1e-9);
    EXPECT_LE(std::hypot(felt->force_n.x, felt->force_n.z), 0.01 * length(felt->force_n));
    return felt->force_n.y;
  };
  EXPECT_LT(force_at(3.0), force_at(1.0));
  EXPECT_LT(force_at(1.0), 0.0) << "outward";
  EXPECT_NEAR(force_at(-10.0), 0.0, 1e-6) << "held beyond the skin";
  // Its centre on the surface: the force there, but for what the ball's curve takes.
  EXPECT_NEAR(-force_at(3.0), touch.material.surface_force_n, 0.5);
}

TEST(Feel, SaysNothingOfAToolThatNoWindowServes) {
  const Clay clay = Clay::ball(20.0, {}).value();
  Touch touch;
  touch.tool.radii_mm = {1.0, 20.0, 20.0};  // too flat
  EXPECT_FALSE(feel(clay, {{0.0, -20.0, 0.0}, {0.0, -1.0, 0.0}}, touch));
}

}  // namespace
}  // namespace argil::viewer
