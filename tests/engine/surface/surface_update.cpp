// SPDX-License-Identifier: GPL-3.0-or-later
// Incremental extraction must end in the bits of a full one, for any history and thread count.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "support/analytic_stack.h"
#include "support/measure/mesh_topology.h"
#include "surface/block_surface.h"

namespace argil::test {
namespace {

void expect_same_bits(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.normals, b.normals);
}

AnalyticStack wavy_scene(int levels, std::uint64_t seed) {
  AnalyticStack s;
  s.voxel_mm = 0.1;
  s.levels = levels;
  s.top_leaves = levels < 3 ? 2 : 1;
  s.choose = chosen_by_chance(seed, 0.3);
  s.field = [=, h = s.voxel_mm](int level, const Coord& n, const Vec3& p) {
    const double size = h * (1 << (levels - 1));
    return static_cast<float>(length(p) - (5.6 * s.top_leaves) * size +
                              0.8 * h * random_at(seed, level, n));
  };
  return s;
}

// Edits a stack at random, as edits do: values change, leaves come and go, levels stay nested and
// balanced; and says what changed.
class Editor {
 public:
  Editor(const AnalyticStack& scene, std::uint64_t seed)
      : scene_(scene), stack_(scene.build()), random_(seed) {}
  const LevelStack& stack() const { return stack_; }

  std::vector<LeafChange> edit() {
    changes_.clear();
    const int kind = pick(3);
    const int level = pick(scene_.levels);
    const auto places = stack_.sorted_origins(level);
    if (places.empty()) return changes_;
    const Coord place = places[static_cast<std::size_t>(pick(static_cast<int>(places.size())))];
    if (kind == 0) change_values(level, place);
    if (kind == 1 && level < scene_.levels - 1) remove_with_finer(level, place);
    if (kind == 2 && level > 0)
      refine(level - 1, (place << 1) + Coord(8 * pick(2), 8 * pick(2), 8 * pick(2)));
    return changes_;
  }

 private:
  int pick(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }

  void change_values(int level, const Coord& place) {
    float* values = stack_.grid(level).tree().touchLeaf(place)->buffer().data();
    const float size = static_cast<float>(stack_.voxel_mm(level));
    const int first = pick(kLeafNodes);
    const int last = std::min(kLeafNodes, first + 1 + pick(60));
    const float by = size * (static_cast<float>(pick(200)) - 100.0F) / 50.0F;
    const std::vector<float> before(values, values + kLeafNodes);
    for (int i = first; i < last; ++i) values[i] += by;
    changes_.push_back(change_of_values(level, place, before.data(), values));
  }

  void remove_with_finer(int level, const Coord& place) {
    for (int finer = level; finer >= 0; --finer) {
      // Balance: what is finer by two within one place around must go as well.
      const int reach = finer == level ? 0 : 8 << (level - finer);
      const Coord low = (place << (level - finer)).offsetBy(-reach);
      const Coord high = ((place.offsetBy(8)) << (level - finer)).offsetBy(reach);
      for (const Coord& at : stack_.sorted_origins(finer)) {
        bool near = true;
        for (int a = 0; a < 3; ++a) near &= at[a] >= low[a] && at[a] < high[a];
        if (near) remove(finer, at);
      }
    }
  }

  void remove(int level, const Coord& place) {
    stack_.grid(level).tree().addTile(1, place, stack_.band_mm(level), false);
    changes_.push_back({level, place});
  }

  void refine(int level, const Coord& place) {
    if (stack_.has_leaf(level, place) || !scene_.in_cube(level, place)) return;
    for (int i = 0; i < 27 && level < scene_.levels - 1; ++i) {
      const Coord step(8 * (i / 9 - 1), 8 * (i / 3 % 3 - 1), 8 * (i % 3 - 1));
      refine(level + 1, leaf_origin(coarser(place + step)));
    }
    scene_.fill_leaf(stack_, level, place);
    changes_.push_back({level, place});
  }

  const AnalyticStack& scene_;
  LevelStack stack_;
  std::mt19937_64 random_;
  std::vector<LeafChange> changes_;
};

class SurfaceUpdateProperty : public testing::TestWithParam<int> {};

TEST_P(SurfaceUpdateProperty, EqualsARebuildBitForBit) {
  const int levels = 1 + GetParam() % 3;
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const AnalyticStack scene = wavy_scene(levels, seed);
  Editor editor(scene, seed);
  BlockSurface kept;
  const std::int64_t all = kept.rebuild_all(editor.stack());
  for (int step = 0; step < 8; ++step) {
    SCOPED_TRACE(testing::Message()
                 << "levels " << levels << ", seed " << seed << ", step " << step);
    std::vector<LeafChange> changes;
    for (int i = 0; i <= step % 3; ++i) {
      const auto more = editor.edit();
      changes.insert(changes.end(), more.begin(), more.end());
    }
    const std::int64_t extracted = kept.update(editor.stack(), changes);
    EXPECT_LE(extracted, all + 8 * static_cast<std::int64_t>(changes.size()));
    BlockSurface fresh;
    fresh.rebuild_all(editor.stack());
    expect_same_bits(kept.weld(), fresh.weld());
    EXPECT_EQ(kept.triangle_count(), fresh.triangle_count());
    EXPECT_EQ(find_mesh_faults(kept.weld()), MeshFaults{});
    if (HasFailure()) break;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SurfaceUpdateProperty, testing::Range(0, 12));

TEST(SurfaceUpdate, OfNothingExtractsNothing) {
  const AnalyticStack scene = wavy_scene(2, 3);
  const LevelStack stack = scene.build();
  BlockSurface surface;
  EXPECT_GT(surface.rebuild_all(stack), 0);
  EXPECT_EQ(surface.update(stack, {}), 0);
}

TEST(SurfaceUpdate, StaysNearTheChange) {
  AnalyticStack scene = wavy_scene(3, 17);
  scene.choose = [](int, const Coord&) { return true; };
  LevelStack stack = scene.build();
  BlockSurface surface;
  const std::int64_t all = surface.rebuild_all(stack);
  const LeafChange change{0, stack.sorted_origins(0)[100]};
  stack.grid(0).tree().touchLeaf(change.origin)->buffer().data()[77] += 0.01F;
  const std::int64_t extracted = surface.update(stack, std::vector{change});
  EXPECT_GT(extracted, 0);
  EXPECT_LE(extracted, 27);
  EXPECT_GT(all, 5 * 27);
}

/// What lies under finer leaves on all sides is read by nobody.
TEST(SurfaceUpdate, ExtractsNothingForACoarseChangeUnderFinerLeaves) {
  AnalyticStack scene = wavy_scene(3, 17);
  scene.choose = [](int, const Coord&) { return true; };
  LevelStack stack = scene.build();
  BlockSurface surface;
  surface.rebuild_all(stack);
  LeafChange change;
  for (const Coord& place : stack.sorted_origins(1)) {
    bool is_covered = true;
    for (int o = 0; o < 27; ++o) {
      const Coord step(8 * (o / 9 - 1), 8 * (o / 3 % 3 - 1), 8 * (o % 3 - 1));
      is_covered = is_covered && stack.has_leaf(0, (place << 1) + step);
    }
    if (is_covered) change = {1, place, false, {}, {}};
  }
  ASSERT_EQ(change.level, 1) << "no leaf of level 1 is covered";
  change.nodes[27] = change.flipped[27] = 0xff;
  EXPECT_EQ(surface.update(stack, std::vector{change}), 0);
}

TEST(SurfaceUpdateGolden, HasTheSameBitsForAnyThreadCount) {
  const LevelStack stack = wavy_scene(3, 23).build();
  TriangleMesh first;
  for (const std::size_t threads : {1U, 2U, 4U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    BlockSurface surface;
    surface.rebuild_all(stack);
    const TriangleMesh mesh = surface.weld();
    ASSERT_FALSE(mesh.triangles.empty());
    if (first.triangles.empty()) first = mesh;
    expect_same_bits(mesh, first);
  }
}

// Holes in the hierarchy are reported by validate; here they may leave cracks, but must be
// survived.
TEST(SurfaceUpdate, SurvivesUnbalancedAndUnnestedStacks) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    AnalyticStack scene = wavy_scene(3, seed);
    LevelStack stack = scene.build();
    for (int level = 0; level < 3; ++level) {
      for (const Coord& place : stack.sorted_origins(level)) {
        if (random_at(seed + 50, level, place) < 0.3) {
          stack.grid(level).tree().addTile(1, place, stack.band_mm(level), false);
        }
      }
    }
    BlockSurface surface;
    surface.rebuild_all(stack);
    const TriangleMesh mesh = surface.weld();
    for (const Vec3& p : mesh.positions) ASSERT_TRUE(is_finite(p));
    EXPECT_EQ(find_mesh_faults(mesh).degenerate, 0);
  }
}

// Cells whose faces are divided several times, with a side at every node that differs from those
// beside it, have as many loops as any.
TEST(SurfaceUpdate, SurvivesNoiseOnUnbalancedStacks) {
  AnalyticStack scene;
  scene.levels = 4;
  scene.top_leaves = 1;
  scene.balanced = false;
  scene.choose = [](int, const Coord& place) { return place.y() == 0 && place.z() == 0; };
  scene.field = [](int, const Coord& n, const Vec3&) {
    return ((n.x() + n.y() + n.z()) & 1) != 0 ? 0.5F : -0.5F;
  };
  const LevelStack stack = scene.build();
  BlockSurface surface;
  surface.rebuild_all(stack);
  const TriangleMesh mesh = surface.weld();
  EXPECT_GT(mesh.triangles.size(), 10'000U);
  for (const Vec3& p : mesh.positions) ASSERT_TRUE(is_finite(p));
  EXPECT_EQ(find_mesh_faults(mesh).degenerate, 0);
}

}  // namespace
}  // namespace argil::test
