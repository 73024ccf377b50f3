// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/surface_probe.h"

#include <gtest/gtest.h>

#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

TEST_F(GesturesTest, AWindowWithoutSizeHasNothingToWorkOn) {
  DepthMap depth;
  depth.width = depth.height = 1;
  depth.depth_mm = {10.0F};
  EXPECT_FALSE((SurfaceProbe{depth, {ui_.camera}}.at({0.0, 0.0}, 1.0)));
  EXPECT_FALSE((SurfaceProbe{DepthMap{}, {ui_.camera}}.at({0.0, 0.0}, 1.0)));
}

}  // namespace
}  // namespace argil::viewer
