// SPDX-License-Identifier: GPL-3.0-or-later
// How windows are timed: each kind as often as asked, on clay that is left as it was.
#include "common/window_times.h"

#include <gtest/gtest.h>

#include "argil/haptics/force/lattice_force.h"

namespace argil::test {
namespace {

Clay ball() {
  auto made = Clay::ball(10.0, {});
  EXPECT_TRUE(made);
  return std::move(made).value();
}

haptics::ForceTool tool_at(const Vec3& place, double radius_mm) {
  haptics::ForceTool tool;
  tool.radii_mm = {radius_mm, radius_mm, radius_mm};
  tool.position_mm = place;
  return tool;
}

Result<cli::WindowTimes> times_of(Clay& clay, const haptics::ForceTool& tool, double margin_mm,
                                  int count) {
  const double spacing = haptics::choose_lattice(tool).voxel_mm;
  return cli::time_windows(clay, tool, cli::servo_window(tool, {}, spacing, margin_mm), count);
}

TEST(WindowTimes, CountsEachKindAndLeavesTheClay) {
  Clay clay = ball();
  Stroke stroke;  // what there was to undo before
  stroke.samples = {{0.0, {10.0, 0.0, 0.0}, {}, 1.0}};
  ASSERT_TRUE(clay.apply(stroke));
  const std::uint64_t before = clay.hash();
  for (const haptics::ToolShape shape :
       {haptics::ToolShape::ellipsoid, haptics::ToolShape::box, haptics::ToolShape::capsule}) {
    haptics::ForceTool tool = tool_at({0.0, 0.0, 10.0}, 1.5);
    tool.shape = shape;
    const auto times = times_of(clay, tool, 1.0, 3);
    ASSERT_TRUE(times) << times.error().message;
    EXPECT_EQ(times.value().fresh.size(), 3U);
    EXPECT_EQ(times.value().moved.size(), 3U);
    EXPECT_EQ(times.value().after_dab.size(), 3U);
    EXPECT_EQ(clay.hash(), before);
    EXPECT_EQ(clay.undo_depth(), 1);
  }
}

/// Far off the surface there is neither a direction along it nor anything to carve.
TEST(WindowTimes, TakesAToolInTheAir) {
  Clay clay = ball();
  const std::uint64_t before = clay.hash();
  const auto times = times_of(clay, tool_at({0.0, 0.0, 40.0}, 1.5), 1.0, 2);
  ASSERT_TRUE(times) << times.error().message;
  EXPECT_EQ(times.value().after_dab.size(), 2U);
  EXPECT_EQ(clay.hash(), before);
}

TEST(WindowTimes, HasNoDabOfAToolThatIsTooSmallToWork) {
  Clay clay = ball();
  const auto times = times_of(clay, tool_at({0.0, 0.0, 10.0}, 0.002), 0.1, 2);
  ASSERT_TRUE(times) << times.error().message;
  EXPECT_EQ(times.value().moved.size(), 2U);
  EXPECT_TRUE(times.value().after_dab.empty());
}

}  // namespace
}  // namespace argil::test
