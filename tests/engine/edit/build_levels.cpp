// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/build_levels.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"

#include "clay/clay_access.h"
#include "support/complete_level.h"

namespace argil {
namespace {

/// A solid that is thick for its finest level: its coarser bands are not made of air.
TEST(StackFromFinest, KnowsItsInsideAtEveryLevel) {
  constexpr double kVoxel = 0.25;
  const test::ForceScene ball = test::force_scene("ball", 4.0, kVoxel);  // 12 mm
  const ClayOptions options{.voxel_mm = kVoxel};
  const Clay clay =
      clay_of_levels(stack_from_finest(test::complete_level(ball, kVoxel), options), options);
  for (int level = 0; level < clay.level_count(); ++level) {
    const double h = levels_of(clay).voxel_mm(level);
    for (const Coord& place : levels_of(clay).sorted_origins(level)) {
      for (int n = 0; n < kLeafNodes; ++n) {
        const Coord node = place.offsetBy(n >> 6, (n >> 3) & 7, n & 7);
        const double exact = ball.distance({h * node.x(), h * node.y(), h * node.z()});
        const auto stored = static_cast<double>(levels_of(clay).sample(level, node));
        ASSERT_NEAR(stored, std::clamp(exact, -4.0 * h, 4.0 * h), 0.1 * h) << level << node;
      }
    }
  }
}

}  // namespace
}  // namespace argil
