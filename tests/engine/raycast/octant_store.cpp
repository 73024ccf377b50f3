// SPDX-License-Identifier: GPL-3.0-or-later
#include "raycast/octant_store.h"

#include <array>
#include <cstdint>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"

#include "clay/clay_access.h"
#include "field/level_stack.h"
#include "raycast/field_ray.h"

namespace argil {
namespace {

struct StoredCell {
  int level;
  Coord low;
};

/// Cells of the leaves around a ball's surface, in any order and many times each.
std::vector<StoredCell> cells_about_ball(const LevelStack& stack, int radius, std::size_t count) {
  std::mt19937 random(3);
  LeafCells cells(stack);
  std::vector<StoredCell> found;
  while (found.size() < count) {
    const auto place = [&] {
      return static_cast<int>(random() % static_cast<unsigned>(2 * radius + 9)) - radius - 4;
    };
    const Coord cell(place(), place(), place());
    const int level = cells.finest_level(cell);
    // Twice, since what is asked for once is not remembered.
    if (level >= 0) found.insert(found.end(), 2, {level, cell >> level});
  }
  return found;
}

TEST(OctantStore, ForgetsAndBeginsAnewWhereItIsFull) {
  const Clay clay = Clay::ball(5.0, ClayOptions{.voxel_mm = 0.25}).value();
  const LevelStack& stack = levels_of(clay);
  const std::vector<StoredCell> asked = cells_about_ball(stack, 20, 20'000);
  std::set<std::tuple<int, int, int, int>> octants;
  for (const auto& [level, low] : asked) {
    octants.insert({level, low.x() >> 2, low.y() >> 2, low.z() >> 2});
  }
  for (const std::uint32_t most : {1U, 40U, 120U}) {
    ASSERT_GT(octants.size(), 2 * most);
    OctantStore few(stack, most);
    LeafCells cells(stack);
    for (const auto& [level, low] : asked) {
      cells.open(level, low << level);
      const std::array<float, 8> expected = cells.corners(low);
      ASSERT_EQ(few.corners(level, low), expected) << most;
    }
  }
}

}  // namespace
}  // namespace argil
