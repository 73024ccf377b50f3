// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/clay_copy.h"
#include "argil/engine/pick.h"
#include "argil/engine/surface.h"

#include "support/measure/mesh_topology.h"
#include "support/stroke_maker.h"

namespace argil {
namespace {

using testing::IsEmpty;

constexpr double kTrimVoxel = 0.2;
constexpr double kTrimRadius = 5.0;

/// A slab, level at z = 0 where x < -4 and with knobs of up to 1.5 mm beyond.
Clay knobbed_slab() {
  Clay clay = Clay::block({40, 24, 12}, ClayOptions{.voxel_mm = kTrimVoxel}).value();
  for (double x = -2.0; x <= 10.0; x += 2.4) {
    for (const double y : {-2.4, 0.0, 2.4}) {
      EXPECT_TRUE(clay.apply(stroke_of(Action::add, 1.5, 1.0, {{x, y, 6.0}})).ok());
    }
  }
  return clay;
}

double height_over_slab(const Clay& clay, double x, double y) {
  const auto hit = pick(clay, Ray{{x, y, 50.0}, {0, 0, -1}});
  return hit.ok() && hit.value() ? hit.value()->point_mm.z - 6.0 : std::nan("");
}

/// The plane is that of the level part where the stroke begins, not that of the knobs.
TEST(ActionTrim, LeavesNothingAboveThePlaneWhereItBegan) {
  Clay clay = knobbed_slab();
  ASSERT_GT(height_over_slab(clay, 0.4, 0.0), 1.4);
  ASSERT_TRUE(
      clay.apply(stroke_of(Action::trim, kTrimRadius, 1.0, {{-9, 0, 6.0}, {5, 0, 6.0}})).ok());
  for (double x = -12.0; x <= 8.0; x += 0.31) {
    for (double y = -3.2; y <= 3.2; y += 0.31) {
      EXPECT_NEAR(height_over_slab(clay, x, y), 0.0, 0.05 * kTrimVoxel) << x << ' ' << y;
    }
  }
  EXPECT_GT(height_over_slab(clay, 10.0, 0.0), 1.4) << "beyond the tool";
  EXPECT_THAT(clay.validate(), IsEmpty());
  EXPECT_EQ(test::find_mesh_faults(extract_surface(clay)), test::MeshFaults{});
}

TEST(ActionTrim, KeepsTheBitsOfWhatLiesBelow) {
  Clay clay = knobbed_slab();
  ASSERT_TRUE(clay.apply(stroke_of(Action::carve, 1.0, 1.0, {{-9, 0, 6.0}, {-9, 1, 6.0}})).ok());
  const Clay before = copy_of(clay);
  Stroke stroke = stroke_of(Action::trim, kTrimRadius, 1.0, {{-13, 0, 6.0}, {-7, 0, 6.0}});
  stroke.tool.plane_offset = 0.2;
  ASSERT_TRUE(clay.apply(stroke).ok());
  for (double x = -14.0; x <= -7.0; x += 0.17) {
    for (double y = -3.0; y <= 3.0; y += 0.17) {
      const Vec3 at{x, y, height_over_slab(before, x, y) + 6.0};
      EXPECT_EQ(clay.distance_at(at), before.distance_at(at)) << x << ' ' << y;
    }
  }
}

/// Again is once: it takes nothing more.
TEST(ActionTrim, TakesNothingMoreTheSecondTime) {
  Clay clay = knobbed_slab();
  const Stroke stroke = stroke_of(Action::trim, kTrimRadius, 1.0, {{-9, 0, 6.0}, {5, 0, 6.0}});
  ASSERT_TRUE(clay.apply(stroke).ok());
  const Clay once = copy_of(clay);
  ASSERT_TRUE(clay.apply(stroke).ok());
  for (double x = -9.0; x <= 5.0; x += 0.5) {
    EXPECT_NEAR(height_over_slab(clay, x, 0.3), height_over_slab(once, x, 0.3), 0.02 * kTrimVoxel);
  }
}

TEST(ActionTrim, LeavesWhatIsMasked) {
  Clay clay = knobbed_slab();
  ASSERT_TRUE(
      clay.apply(stroke_of(Action::mask, 3.0, 1.0, {{0.4, 0, 7.0}, {0.4, 0.5, 7.0}, {0.4, 0, 7.0}}))
          .ok());
  const double knob = height_over_slab(clay, 0.4, 0.0);
  ASSERT_TRUE(
      clay.apply(stroke_of(Action::trim, kTrimRadius, 1.0, {{-9, 0, 6.0}, {6, 0, 6.0}})).ok());
  EXPECT_NEAR(height_over_slab(clay, 0.4, 0.0), knob, 0.02 * kTrimVoxel);
  EXPECT_NEAR(height_over_slab(clay, 7.6, 0.0), 0.0, 0.1 * kTrimVoxel);
  EXPECT_THAT(clay.validate(), IsEmpty());
}

/// A mask shrinks the tool, as a strength of 1 - m does; the plane stays where it is.
TEST(ActionTrim, CutsToThePlaneWhatIsHalfMasked) {
  Clay clay = knobbed_slab();
  ASSERT_TRUE(clay.apply(stroke_of(Action::mask, 9.0, 0.5, {{2.8, 0, 6.0}})).ok());
  ASSERT_GT(clay.mask_at({2.8, 0, 6.0}), 0.4);
  ASSERT_TRUE(
      clay.apply(stroke_of(Action::trim, kTrimRadius, 1.0, {{-9, 0, 6.0}, {5, 0, 6.0}})).ok());
  for (const double x : {0.4, 2.8}) {
    EXPECT_NEAR(height_over_slab(clay, x, 0.0), 0.0, 0.5 * kTrimVoxel) << x;
  }
  EXPECT_THAT(clay.validate(), IsEmpty());
}

}  // namespace
}  // namespace argil
