// SPDX-License-Identifier: GPL-3.0-or-later
// A selection of the repair arena, Argil alone; argil_arena runs all of it beside others.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "arena/arena.h"

namespace argil::arena {
namespace {

/// Of each kind one mesh or two, without models that may not be there.
ArenaOptions selection() {
  ArenaOptions options;
  options.contestants = {"argil"};
  options.only_simple = true;
  options.strengths = {1, 2};
  options.models_each = 1;
  options.limit = 30;
  return options;
}

TEST(RepairArena, SelectionIsValidAndLossesAreTold) {
  const Say quiet = [](const std::string&) {};
  const ArenaOptions options = selection();
  const std::vector<Row> rows = run_arena(broken_meshes(options, quiet), options, quiet);
  ASSERT_EQ(rows.size(), options.limit);
  for (const Row& row : rows) {
    const std::string name = row.kind + "_" + row.model + "_" + std::to_string(row.strength);
    SCOPED_TRACE(name + ": " + row.judged.why);
    EXPECT_FALSE(row.attempt.crashed);
    EXPECT_FALSE(row.attempt.hung);
    EXPECT_TRUE(row.judged.valid);
    EXPECT_FALSE(row.is_silent());
  }
}

/// Rims that belong together and are far apart: a lid on each would stay within, and nothing say
/// so.
TEST(RepairArena, HalvesThatGapeOrOverlapBecomeOne) {
  const Say quiet = [](const std::string&) {};
  ArenaOptions options = selection();
  options.kinds = {"cracks", "overlapping_patches"};
  options.strengths = {4};
  options.models_each = 3;
  options.limit = 0;
  const std::vector<Row> rows = run_arena(broken_meshes(options, quiet), options, quiet);
  ASSERT_GE(rows.size(), 4U);
  for (const Row& row : rows) {
    SCOPED_TRACE(row.kind + "_" + row.model + ": " + row.judged.why);
    EXPECT_TRUE(row.is_right());
    EXPECT_EQ(row.attempt.status, 0);
  }
}

TEST(RepairArena, RowsAreReadAsTheyAreWritten) {
  Row row{"argil", "noise", "ball", 2, 17, {}, {}};
  row.judged.valid = true;
  row.judged.why = "a, b";
  row.attempt.status = 1;
  row.attempt.names_a_place = true;
  row.attempt.cpu_s = 0.25;
  const std::vector<Row> read = rows_of("# when and where\n" + csv_of({row, row}));
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(table_of(read), table_of({row, row}));
  EXPECT_FALSE(read[1].is_silent());
}

TEST(RepairArena, JudgeTellsAWrongRepairFromARightOne) {
  const Say quiet = [](const std::string&) {};
  ArenaOptions options;
  options.kinds = {"fans"};
  options.models = {"ball"};
  options.only_simple = true;
  options.limit = 1;
  const std::vector<Broken> meshes = broken_meshes(options, quiet);
  ASSERT_EQ(meshes.size(), 1U);
  const Broken& fan = meshes.front();
  EXPECT_TRUE(judge(fan.truth.must, fan).kept);
  EXPECT_TRUE(judge(fan.truth.must, fan).valid);
  EXPECT_FALSE(judge(fan.mesh, fan).valid);
  EXPECT_FALSE(judge({}, fan).kept);
  TriangleMesh larger = fan.truth.must;
  for (Vec3& p : larger.positions) p *= 1.004;  // 1.2 % of the volume, 0.2 % of the side
  EXPECT_FALSE(judge(larger, fan).kept);
  TriangleMesh moved = fan.truth.must;
  const double side = largest_side(moved);
  for (Vec3& p : moved.positions) p.x += 0.006 * side;
  EXPECT_FALSE(judge(moved, fan).kept);
  for (Vec3& p : moved.positions) p.x -= 0.002 * side;
  EXPECT_TRUE(judge(moved, fan).kept);
}

}  // namespace
}  // namespace argil::arena
