// SPDX-License-Identifier: GPL-3.0-or-later
// What is read of the coarser levels where a level has no leaf.
#include "field/prolongation.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "clay/clay_access.h"
#include "support/bumpy_clay.h"

namespace argil {
namespace {

/// The leaves of a level and those up to two beside them, stored or not, and some far off.
std::set<Coord> origins_about(const LevelStack& stack, int level) {
  std::set<Coord> about{Coord(0), Coord(8 * 200), Coord(-8 * 200)};
  for (const Coord& origin : stack.sorted_origins(level)) {
    openvdb::CoordBBox nodes(origin, origin);
    nodes.expand(2 * kLeafSide);
    for_each_leaf_origin(nodes, [&](const Coord& near) { about.insert(near); });
  }
  return about;
}

TEST(Prolongation, TellsWhetherAnyCoarseNodeIsBelowAsAllOfThemDo) {
  auto made = test::bumpy_ball(6.0, 0.1);
  ASSERT_TRUE(made.ok()) << made.error().message;
  Clay& clay = made.value();
  // A wide cut and a narrow one, so that leaves are missing beside fine ones.
  for (const double radius : {3.0, 0.5}) {
    Stroke stroke;
    stroke.tool.action = Action::carve;
    stroke.tool.radii_mm = {radius, radius, radius};
    stroke.samples.resize(1);
    stroke.samples[0].position_mm = {6.0, radius, 0.0};
    ASSERT_TRUE(clay.apply(stroke).ok());
  }
  const LevelStack& stack = levels_of(clay);
  ASSERT_GE(stack.count(), 3);
  int below = 0;
  int above = 0;
  for (int level = 0; level < stack.top(); ++level) {
    for (const Coord& origin : origins_about(stack, level)) {
      const CoarseNodes nodes = coarse_nodes(stack, level + 1, origin);
      for (const float side : {-1.0F, 1.0F}) {
        for (const float bands : {0.1F, 1.0F, 1.9F, 2.0F, 4.0F}) {
          const float bound = bands * stack.band_mm(level);
          const bool is_below = std::any_of(nodes.begin(), nodes.end(),
                                            [&](float value) { return side * value < bound; });
          ASSERT_EQ(any_coarse_below(stack, level + 1, origin, side, bound), is_below)
              << "level " << level << ", leaf " << origin << ", side " << side << ", " << bands;
          (is_below ? below : above) += 1;
        }
      }
    }
  }
  EXPECT_GT(below, 1000);
  EXPECT_GT(above, 1000);
}

}  // namespace
}  // namespace argil
