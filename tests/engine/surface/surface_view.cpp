// SPDX-License-Identifier: GPL-3.0-or-later
// What a block sees around its leaf must be what the stack says, in every bit: then all blocks
// agree.
#include "surface/surface_view.h"

#include <gtest/gtest.h>

#include "support/analytic_stack.h"

namespace argil::test {
namespace {

AnalyticStack rough_scene(std::uint64_t seed, bool balanced) {
  AnalyticStack s;
  s.levels = 3;
  s.top_leaves = 1;
  s.balanced = balanced;
  s.choose = chosen_by_chance(seed, 0.1);
  s.field = [=](int level, const Coord& n, const Vec3&) {
    return static_cast<float>(random_at(seed, level, n) - 0.5);
  };
  return s;
}

template <class Check>
void for_each_up_to(int last, const Check& check) {
  for (int x = -1; x <= last; ++x) {
    for (int y = -1; y <= last; ++y) {
      for (int z = -1; z <= last; ++z) check(Coord(x, y, z));
    }
  }
}

// Whether a node or cell of this level lies in an octant that is live or touches a live one.
bool is_near_live(const SurfaceView& view, const Coord& node) {
  const Coord octant = node >> 2;
  for (int o = 0; o < 8; ++o) {
    const Coord own(o >> 2, o >> 1 & 1, o & 1);
    const Coord away = octant - own;
    const bool touches =
        std::abs(away.x()) <= 1 && std::abs(away.y()) <= 1 && std::abs(away.z()) <= 1;
    if (touches && view.live(own << 2)) return true;
  }
  return false;
}

// Counts where view and stack differ around the live cells of one leaf.
int differences(SurfaceView& view, int depth) {
  const LevelStack& stack = view.stack();
  const int level = view.level() - depth;
  const Coord base = view.origin() << depth;
  int wrong = 0;
  for_each_up_to((8 << depth) + 1, [&](const Coord& n) {
    if (!is_near_live(view, n >> depth)) return;
    wrong += view.value(depth, n) != stack.node_value(level, base + n) ? 1 : 0;
  });
  for_each_up_to(8 << depth, [&](const Coord& cell) {
    if (!is_near_live(view, cell >> depth)) return;
    const bool refined = level > 0 && stack.has_leaf(level - 1, (base + cell) << 1);
    wrong += view.refined(depth, cell) != refined ? 1 : 0;
  });
  return wrong;
}

class SurfaceViewProperty : public testing::TestWithParam<int> {};

TEST_P(SurfaceViewProperty, ReadsWhatTheStackSays) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const LevelStack stack = rough_scene(seed, seed % 2 == 0).build();
  SurfaceView view(stack);
  int leaves = 0;
  for (int level = 0; level < stack.count(); ++level) {
    for (const Coord& place : stack.sorted_origins(level)) {
      if (!view.open(level, place)) continue;
      ++leaves;
      view.gather();
      for (int depth = 0; depth <= view.depth(); ++depth) {
        ASSERT_EQ(differences(view, depth), 0)
            << "level " << level << ", place " << place.x() << " " << place.y() << " " << place.z();
      }
    }
  }
  EXPECT_GT(leaves, 50);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SurfaceViewProperty, testing::Range(0, 4));

TEST(SurfaceView, OpensNothingWhereThereIsNoLeaf) {
  const LevelStack stack = rough_scene(1, true).build();
  SurfaceView view(stack);
  EXPECT_FALSE(view.open(0, Coord(8000, 0, 0)));
}

}  // namespace
}  // namespace argil::test
