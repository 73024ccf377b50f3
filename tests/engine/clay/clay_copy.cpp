// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/clay_copy.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/operation.h"

#include "support/session_life.h"
#include "support/stroke_maker.h"

namespace argil {
namespace {

Stroke copied_stroke(unsigned n) {
  std::mt19937 random(n);
  return random_dab(random, 6.0);
}

Stroke copied_mask_stroke(unsigned n) {
  Stroke stroke = copied_stroke(n);
  stroke.tool.action = Action::mask;
  stroke.tool.strength = n % 3 == 2 ? -0.7 : 0.7;
  return stroke;
}

TEST(LevelCopy, HasTheBitsOfTheClayThatWentOn) {
  for (const std::size_t piece : {1U, 30U, 1000000U}) {
    Clay clay = Clay::ball(9.0, {0.4, 0.1}).value();
    ASSERT_TRUE(clay.apply(copied_stroke(90)));
    ClayCopy copy(clay);
    unsigned n = 0;
    for (; !copy.advance(clay, piece) && n < 200; ++n) {
      ASSERT_TRUE(clay.apply(n % 4 == 0 ? copied_mask_stroke(n) : copied_stroke(n)));
      if (n % 3 == 0) clay.undo();
    }
    const std::uint64_t hash = clay.hash();
    const Clay copied = std::move(copy).take();
    EXPECT_EQ(copied.hash(), hash) << n << " strokes meanwhile";
    EXPECT_THAT(copied.validate(), testing::IsEmpty());
  }
}

TEST(LevelCopy, FollowsAClayThatGetsOtherVoxels) {
  for (const double voxel_mm : {0.3, 0.2}) {
    Clay clay = test::life_start();
    ClayCopy copy(clay);
    EXPECT_FALSE(copy.advance(clay, 1));
    ASSERT_TRUE(clay.apply(Operation(Resample{voxel_mm})));
    while (!copy.advance(clay, 1)) {
    }
    const Clay copied = std::move(copy).take();
    EXPECT_EQ(copied.hash(), clay.hash());
    EXPECT_EQ(copied.options().voxel_mm, voxel_mm);
    EXPECT_THAT(copied.validate(), testing::IsEmpty());
  }
}

}  // namespace
}  // namespace argil
