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

TEST(ShownForce, StaysUntilItHasMovedByHalfAPixelFromWhatWasDrawn) {
  const FeltForce start{{0.0, 0.0, 0.0}, 3.0, {0.0, 0.0, 1.0}};
  std::optional<FeltForce> shown = steadied(start, std::nullopt, 0.1, 2.0);
  ASSERT_TRUE(shown);
  // It creeps: each step is too small to be seen, but not all of them.
  int redrawn = 0;
  FeltForce now = start;
  for (int n = 0; n < 100; ++n) {
    now.tool_mm.x += 0.011;
    const auto next = steadied(now, shown, 0.1, 2.0);
    ASSERT_TRUE(next);
    EXPECT_LT(length(next->tool_mm - now.tool_mm), 0.05);
    redrawn += next->tool_mm == shown->tool_mm ? 0 : 1;
    shown = next;
  }
  EXPECT_EQ(redrawn, 20);
  now.force_n.z += 0.024;  // an arrow of 2 mm for each newton
  EXPECT_EQ(steadied(now, now, 0.1, 2.0)->force_n, now.force_n);
  EXPECT_NE(steadied(now, shown, 0.1, 2.0)->force_n, now.force_n);
  now.force_n.z += 0.002;
  EXPECT_EQ(steadied(now, shown, 0.1, 2.0)->force_n, now.force_n);
  EXPECT_FALSE(steadied(std::nullopt, shown, 0.1, 2.0));
  now.radius_mm = 4.0;
  EXPECT_EQ(steadied(now, shown, 1e3, 0.0)->radius_mm, 4.0);
}

}  // namespace
}  // namespace argil::viewer
