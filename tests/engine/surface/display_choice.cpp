// SPDX-License-Identifier: GPL-3.0-or-later
// Which leaves are hidden, on stacks of more levels than strokes make in a test.
#include "surface/display_choice.h"

#include <random>

#include <gtest/gtest.h>

#include "edit/prune.h"
#include "field/nesting.h"
#include "support/analytic_stack.h"
#include "support/drawn_copies.h"
#include "support/effort.h"
#include "support/measure/mesh_topology.h"
#include "support/without_hidden.h"
#include "surface/block_surface.h"

namespace argil::test {
namespace {

constexpr double kReachMm = 5.0;

/// A rough ball over four levels, refined by chance.
AnalyticStack rough_ball(std::uint64_t seed) {
  AnalyticStack s;
  s.voxel_mm = 0.1;
  s.levels = 4;
  s.top_leaves = 1;
  s.choose = chosen_by_chance(seed, seed % 2 == 0 ? 0.03 : 0.3);
  s.field = [=, h = s.voxel_mm](int level, const Coord& n, const Vec3& p) {
    return static_cast<float>(length(p) - kReachMm + 0.8 * h * random_at(seed, level, n));
  };
  return s;
}

DrawnCopies copies_of(const BlocksOf<DrawnBlock>& blocks) {
  DrawnCopies copies;
  for (const auto& [at, block] : blocks.blocks()) {
    if (block.triangles.empty()) continue;
    copies[{at.level, {at.origin.x(), at.origin.y(), at.origin.z()}}] = {block.vertices,
                                                                         block.triangles};
  }
  return copies;
}

class DisplayChoiceProperty : public testing::TestWithParam<int> {
 protected:
  DisplayChoiceProperty() { choice_.show_all(stack_); }

  DisplayView next_view() {
    DisplayView view = random_view(random_, kReachMm, stack_.voxel_mm(0));
    view.hysteresis = uniform(random_, 0.0, 1.0);
    if (random_() % 2 == 0) {  // at the surface, and levels change within a leaf's width
      view.eye_mm *= kReachMm / length(view.eye_mm);
      view.pixel_rad = uniform(random_, 0.05, 0.5);
    }
    return view;
  }

  std::uint64_t seed_ = static_cast<std::uint64_t>(GetParam());
  std::mt19937 random_{static_cast<std::uint32_t>(GetParam())};
  LevelStack stack_ = rough_ball(seed_).build();
  DisplayChoice choice_;
};

/// Whatever a shown leaf requires is shown.
TEST_P(DisplayChoiceProperty, ShowsNestedBalancedLeaves) {
  for (int i = 0; i < 12; ++i) {
    choice_.choose(next_view());
    for (int level = 0; level < stack_.top(); ++level) {
      for (const Coord& place : stack_.sorted_origins(level)) {
        if (!choice_.shows({level, place})) continue;
        for_each_required_parent(place, [&](const Coord& coarse) {
          ASSERT_FALSE(choice_.hides(level + 1, coarse)) << "seed " << seed_ << ", view " << i;
        });
      }
    }
  }
}

/// Nothing is drawn more levels too coarse than asked, and what may be hidden is.
TEST_P(DisplayChoiceProperty, KeepsItsLimitAndUsesIt) {
  DisplayView far = next_view();
  far.eye_mm.x = 1e6;
  for (far.coarser = 1; far.coarser < 3; ++far.coarser) {
    choice_.choose(far);
    for (int level = 0; level < stack_.top(); ++level) {
      for (const Coord& place : stack_.sorted_origins(level)) {
        const int above = std::min(level + far.coarser, stack_.top());
        ASSERT_TRUE(choice_.shows({above, leaf_origin(place >> (above - level))}));
        ASSERT_TRUE(level > 0 || choice_.hides(level, place));
      }
    }
  }
}

/// Also with hysteresis, where the choice depends on where the eye was.
TEST_P(DisplayChoiceProperty, AStepOfTheEyeEqualsARebuildAndAStackWithoutTheHiddenLeaves) {
  BlocksOf<DrawnBlock> kept;
  kept.rebuild_all({stack_, &choice_});
  for (int i = 0; i < effort(4, 8); ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed_ << ", view " << i);
    std::vector<LeafChange> changes;
    for (const LeafKey& at : choice_.choose(next_view())) changes.push_back({at.level, at.origin});
    kept.update({stack_, &choice_}, changes);
    BlocksOf<DrawnBlock> fresh;
    fresh.rebuild_all({stack_, &choice_});
    const DrawnCopies copies = copies_of(kept);
    ASSERT_TRUE(copies == copies_of(fresh));
    BlockSurface oracle;
    oracle.rebuild_all(without_hidden(stack_, choice_));
    ASSERT_EQ(sorted_triangles(copies), sorted_triangles(oracle.weld()));
    ASSERT_EQ(find_mesh_faults(welded(copies)), MeshFaults{});
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, DisplayChoiceProperty, testing::Range(0, 6));

}  // namespace
}  // namespace argil::test
