// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/layout.h"

#include <gtest/gtest.h>

namespace argil::viewer {
namespace {

TEST(Layout, PanelsAreAsLargeAsTheScreenAndTheUserAskFor) {
  EXPECT_DOUBLE_EQ(scale_of_panels(1.0, 100, 1280, 720), 1.0);
  EXPECT_DOUBLE_EQ(scale_of_panels(1.0, 100, 1920, 1080), 1.0);
  EXPECT_DOUBLE_EQ(scale_of_panels(2.0, 100, 3840, 2160), 2.0);
  EXPECT_DOUBLE_EQ(scale_of_panels(2.0, 150, 3840, 2160), 3.0);
  EXPECT_DOUBLE_EQ(scale_of_panels(1.0, 75, 1280, 720), 0.75);
}

TEST(Layout, PanelsAreNoLargerThanTheWindowHasRoomFor) {
  EXPECT_DOUBLE_EQ(scale_of_panels(2.0, 300, 1280, 720), 1.8);
  EXPECT_DOUBLE_EQ(scale_of_panels(2.0, 100, 640, 480), 1.0);
  EXPECT_DOUBLE_EQ(scale_of_panels(1.0, 100, 320, 240), 0.75) << "letters can still be read";
}

}  // namespace
}  // namespace argil::viewer
