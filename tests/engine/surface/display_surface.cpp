// SPDX-License-Identifier: GPL-3.0-or-later
// What a renderer gets: blocks, lists of what changed, and coarser blocks where they are small on
// the screen. Everything is looked at as a renderer would: through its own copies.
#include "argil/engine/display_surface.h"

#include <limits>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/surface.h"

#include "clay/clay_access.h"
#include "support/bumpy_clay.h"
#include "support/drawn_copies.h"
#include "support/effort.h"
#include "support/measure/mesh_topology.h"
#include "support/measure/self_intersection.h"
#include "support/stroke_maker.h"
#include "support/without_hidden.h"
#include "surface/block_surface.h"
#include "surface/display_choice.h"

namespace argil::test {
namespace {

/// A renderer that knows only what the lists of each update told it.
class Renderer {
 public:
  /// Applies the lists of the last update. Counts what they said in vain.
  void follow(const DisplaySurface& surface) {
    for (const BlockId& id : surface.gone()) needless_ += copies_.erase(id) == 0 ? 1 : 0;
    for (const BlockId& id : surface.changed()) {
      DrawnCopy copy = copy_of(surface, id);
      const auto known = copies_.find(id);
      if (known != copies_.end() && known->second == copy) ++needless_;
      copies_[id] = std::move(copy);
    }
  }

  static DrawnCopy copy_of(const DisplaySurface& surface, const BlockId& id) {
    const DisplayBlock block = surface.block(id);
    return {{block.vertices.begin(), block.vertices.end()},
            {block.triangles.begin(), block.triangles.end()}};
  }

  const DrawnCopies& copies() const { return copies_; }
  int needless() const { return needless_; }

 private:
  DrawnCopies copies_;
  int needless_ = 0;
};

DrawnCopies all_blocks(const DisplaySurface& surface) {
  DrawnCopies all;
  for (const BlockId& id : surface.blocks()) all[id] = Renderer::copy_of(surface, id);
  return all;
}

/// In which finest voxels span just a pixel at this distance from an eye on the x axis.
DisplayView view_from(double eye_mm, double limit_mm, double voxel_mm) {
  DisplayView view;
  view.eye_mm = {eye_mm, 0.0, 0.0};
  view.pixel_rad = voxel_mm / limit_mm;
  return view;
}

DisplaySurface surface_of(const Clay& clay, const std::optional<DisplayView>& view = {}) {
  DisplaySurface surface;
  EXPECT_TRUE(surface.update(clay, view).ok());
  return surface;
}

/// Its finest level is everywhere; two or three levels. Views are of its voxels, so that as much is
/// hidden where they are larger.
Clay rough_start(std::mt19937& random) {
  const double larger = effort(1.4, 1.0);
  auto made = bumpy_ball(uniform(random, 8.0, 10.0), larger * uniform(random, 0.15, 0.3));
  EXPECT_TRUE(made.ok());
  return std::move(made).value();
}

/// Or it has coarse levels that only strokes refine.
Clay any_start(std::mt19937& random) {
  return random() % 2 == 0 ? random_start(random) : rough_start(random);
}

Clay sculpted(std::mt19937& random, int strokes) {
  Clay clay = any_start(random);
  for (int i = 0; i < strokes; ++i) EXPECT_TRUE(clay.apply(random_dab(random, 9.0)).ok());
  return clay;
}

/// A bumpy ball with its finest level everywhere, 3 levels.
constexpr double kShownBallMm = 10.0;
constexpr double kBallVoxelMm = 0.25;
Clay shown_fine_ball() {
  auto made = bumpy_ball(kShownBallMm, kBallVoxelMm);
  EXPECT_TRUE(made.ok());
  return std::move(made).value();
}

TEST(DisplaySurface, WithoutAViewHasTheBitsOfTheWholeSurface) {
  std::mt19937 random(5);
  const Clay clay = sculpted(random, 3);
  const auto drawn = sorted_triangles(all_blocks(surface_of(clay)));
  EXPECT_EQ(drawn, sorted_triangles(extract_surface(clay)));
  EXPECT_FALSE(drawn.empty());
}

TEST(DisplaySurface, FromNearHasTheBitsOfTheWholeSurface) {
  const Clay clay = shown_fine_ball();
  const DisplaySurface near = surface_of(clay, view_from(12.0, 40.0, kBallVoxelMm));
  EXPECT_EQ(near.stats().hidden_leaves, 0);
  EXPECT_EQ(all_blocks(near), all_blocks(surface_of(clay)));
}

TEST(DisplaySurface, HasAFourthOfTheTrianglesForEachHiddenLevel) {
  const Clay clay = shown_fine_ball();
  const auto all = static_cast<double>(surface_of(clay).stats().triangles);
  DisplayView far = view_from(1e5, 40.0, kBallVoxelMm);
  const DisplaySurface one = surface_of(clay, far);
  EXPECT_NEAR(all / static_cast<double>(one.stats().triangles), 4.0, 0.4);
  far.coarser = 2;
  const DisplaySurface two = surface_of(clay, far);
  EXPECT_NEAR(all / static_cast<double>(two.stats().triangles), 16.0, 2.5);
  EXPECT_GT(one.stats().hidden_leaves, 0);
  EXPECT_GT(two.stats().hidden_leaves, one.stats().hidden_leaves);
}

/// Half of the ball near enough, the other half too far: both levels meet on it.
TEST(DisplaySurface, IsCoarserOnTheFarSideOnlyAndCloses) {
  const Clay clay = shown_fine_ball();
  const DisplaySurface all = surface_of(clay);
  const DisplaySurface surface = surface_of(clay, view_from(20.0, 20.0, kBallVoxelMm));
  int near = 0;
  int far = 0;
  for (const BlockId& id : surface.blocks()) {
    const Vec3 middle = surface.block(id).bounds_mm.center();
    const double distance = length(middle - Vec3{20.0, 0.0, 0.0});
    if (distance < 17.0) {
      EXPECT_TRUE(Renderer::copy_of(surface, id) == Renderer::copy_of(all, id));
      ++near;
    }
    if (distance > 26.0) {
      EXPECT_EQ(id.level, 1);
      ++far;
    }
  }
  EXPECT_GT(near, 30);
  EXPECT_GT(far, 30);
  const TriangleMesh mesh = welded(all_blocks(surface));
  EXPECT_EQ(find_mesh_faults(mesh), MeshFaults{});
  EXPECT_EQ(euler_characteristic(mesh), 2);
}

TEST(DisplaySurface, KeepsEveryVertexWithinTheBoundsOfItsBlock) {
  std::mt19937 random(8);
  const Clay clay = sculpted(random, 3);
  const DisplaySurface surface = surface_of(clay, random_view(random, 10.0, 0.5));
  for (const BlockId& id : surface.blocks()) {
    const DisplayBlock block = surface.block(id);
    for (const DisplayVertex& v : block.vertices) {
      double square = 0.0;
      for (std::size_t a = 0; a < 3; ++a) {
        ASSERT_GE(double{v.position_mm[a]}, block.bounds_mm.min[a]);
        ASSERT_LE(double{v.position_mm[a]}, block.bounds_mm.max[a]);
        square += double{v.normal[a]} * double{v.normal[a]};
      }
      ASSERT_NEAR(square, 1.0, 1e-6);
    }
  }
  EXPECT_TRUE(surface.block({0, {8 * 4096, 0, 0}}).triangles.empty());
}

class DisplaySurfaceProperty : public testing::TestWithParam<int> {};

TEST_P(DisplaySurfaceProperty, IsTheSurfaceOfAClayWithoutTheHiddenLeaves) {
  std::mt19937 random(static_cast<std::uint32_t>(GetParam()) + 100);
  const Clay clay = sculpted(random, 4);
  for (int i = 0; i < 3; ++i) {
    const DisplayView view = random_view(random, 12.0, clay.options().voxel_mm);
    DisplayChoice choice;
    choice.show_all(levels_of(clay));
    choice.choose(view);
    BlockSurface oracle;
    oracle.rebuild_all(without_hidden(levels_of(clay), choice));
    const auto drawn = all_blocks(surface_of(clay, view));
    EXPECT_EQ(sorted_triangles(drawn), sorted_triangles(oracle.weld()));
    const TriangleMesh mesh = welded(drawn);
    EXPECT_EQ(find_mesh_faults(mesh), MeshFaults{});
    EXPECT_EQ(find_soup_faults(mesh), SoupFaults{});
    if (HasFailure()) FAIL() << "seed " << GetParam() << ", view " << i;
  }
}

bool is_mixed(const DisplaySurface& surface) {
  return surface.stats().hidden_leaves > 20 && surface.blocks().front().level == 0;
}

/// One random thing that a session may do.
void take_a_step(std::mt19937& random, Clay& clay, std::optional<DisplayView>& view) {
  switch (random() % 6) {
    case 0:
      clay.undo();
      break;
    case 1:
      clay.redo();
      break;
    case 2:
      view.reset();
      break;
    case 3:
      view = random_view(random, 12.0, clay.options().voxel_mm);
      break;
    default:
      if (view && random() % 2 == 0) view->eye_mm.x += 0.7;
      ASSERT_TRUE(clay.apply(random_dab(random, 9.0)).ok());
  }
}

TEST_P(DisplaySurfaceProperty, ARendererThatFollowsTheListsHoldsTheBlocks) {
  std::mt19937 random(static_cast<std::uint32_t>(GetParam()));
  Clay clay = rough_start(random);
  std::optional<DisplayView> view = random_view(random, 12.0, clay.options().voxel_mm);
  DisplaySurface kept;
  Renderer renderer;
  int mixed_steps = 0;  // with blocks both hidden and at their finest
  for (int step = 0; step < 24; ++step) {
    if (step == 12) clay = any_start(random);  // another clay
    ASSERT_TRUE(kept.update(clay, view).ok());
    renderer.follow(kept);
    const auto current = all_blocks(kept);
    ASSERT_TRUE(renderer.copies() == current) << "seed " << GetParam() << ", step " << step;
    EXPECT_EQ(renderer.needless(), 0) << "seed " << GetParam() << ", step " << step;
    const DisplaySurface fresh = surface_of(clay, view);
    ASSERT_TRUE(current == all_blocks(fresh)) << "seed " << GetParam() << ", step " << step;
    EXPECT_EQ(kept.stats().hidden_leaves, fresh.stats().hidden_leaves);
    EXPECT_EQ(kept.stats().triangles, fresh.stats().triangles);
    mixed_steps += is_mixed(kept) ? 1 : 0;
    if (step % effort(3, 1) == 0) {
      EXPECT_EQ(find_mesh_faults(welded(current)), MeshFaults{});
    }
    take_a_step(random, clay, view);
  }
  EXPECT_GT(mixed_steps, 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, DisplaySurfaceProperty, testing::Range(0, 8));

TEST(DisplaySurface, ListsNothingWhenNothingChanged) {
  const Clay clay = shown_fine_ball();
  const DisplayView view = view_from(20.0, 20.0, kBallVoxelMm);
  DisplaySurface surface = surface_of(clay, view);
  EXPECT_EQ(surface.changed().size(), surface.blocks().size());
  EXPECT_EQ(surface.update(clay, view).value(), 0);
  EXPECT_TRUE(surface.changed().empty());
  EXPECT_TRUE(surface.gone().empty());
}

/// A step of the camera touches what lies beside the leaves it hides, and no more.
TEST(DisplaySurface, ExtractsOnlyAroundTheLeavesThatAStepHides) {
  const Clay clay = bumpy_ball(4.0 * kShownBallMm, kBallVoxelMm).value();
  DisplaySurface surface = surface_of(clay, view_from(60.0, 60.0, kBallVoxelMm));
  const DisplayStats before = surface.stats();
  const auto extracted = surface.update(clay, view_from(60.5, 60.0, kBallVoxelMm));
  ASSERT_TRUE(extracted.ok());
  const std::int64_t hidden = surface.stats().hidden_leaves - before.hidden_leaves;
  EXPECT_GT(hidden, 0);
  EXPECT_LE(extracted.value(), 35 * hidden);
  EXPECT_LT(8 * extracted.value(), before.blocks);
  EXPECT_GT(surface.gone().size(), 0U);
}

/// How many blocks a camera moves that trembles by some percent, once it has done so before.
std::size_t flicker(const Clay& clay, double hysteresis) {
  DisplaySurface surface;
  std::size_t count = 0;
  for (int i = 0; i < 8; ++i) {
    DisplayView view = view_from(i % 2 == 0 ? 20.0 : 20.6, 20.0, kBallVoxelMm);
    view.hysteresis = hysteresis;
    EXPECT_TRUE(surface.update(clay, view).ok());
    if (i >= 2) count += surface.changed().size() + surface.gone().size();
  }
  return count;
}

TEST(DisplaySurface, DoesNotFlickerWhenTheCameraTrembles) {
  const Clay clay = shown_fine_ball();
  EXPECT_GT(flicker(clay, 0.0), 0U);
  EXPECT_EQ(flicker(clay, 0.25), 0U);
}

TEST(DisplaySurface, ShowsAgainWhatIsNearEnoughInSpiteOfHysteresis) {
  const Clay clay = shown_fine_ball();
  DisplaySurface surface = surface_of(clay, view_from(1000.0, 40.0, kBallVoxelMm));
  EXPECT_GT(surface.stats().hidden_leaves, 0);
  ASSERT_TRUE(surface.update(clay, view_from(40.0, 40.0, kBallVoxelMm)).ok());
  const std::int64_t between = surface.stats().hidden_leaves;
  ASSERT_TRUE(surface.update(clay, view_from(15.0, 40.0, kBallVoxelMm)).ok());
  EXPECT_GT(between, 0);
  EXPECT_EQ(surface.stats().hidden_leaves, 0);
}

/// In a parallel projection distance does not count.
TEST(DisplaySurface, HidesByTheSizeOfAPixelInAParallelProjection) {
  const Clay clay = shown_fine_ball();
  DisplayView view;
  view.pixel_mm = 0.24;
  EXPECT_EQ(surface_of(clay, view).stats().hidden_leaves, 0);
  view.pixel_mm = 0.26;
  view.eye_mm = {1e6, 0.0, 0.0};
  const DisplaySurface coarse = surface_of(clay, view);
  for (const BlockId& id : coarse.blocks()) EXPECT_EQ(id.level, 1);
}

/// What a tool's radius in pixels is in mm: 500 rows show a mm a row, 500 mm away at 2 tan = 1.
TEST(DisplayView, SaysHowLargeAPixelIsAtAPlace) {
  DisplayView view;
  view.eye_mm = {0.0, 0.0, 500.0};
  view.pixel_rad = 1.0 / 500.0;
  EXPECT_DOUBLE_EQ(view.pixel_mm_at({0.0, 0.0, 0.0}), 1.0);
  EXPECT_DOUBLE_EQ(view.pixel_mm_at({0.0, 0.0, 250.0}), 0.5);
  view.pixel_rad = 0.0;
  view.pixel_mm = 0.2;
  EXPECT_DOUBLE_EQ(view.pixel_mm_at({70.0, 0.0, 250.0}), 0.2);
}

TEST(DisplaySurface, TakesSixtyBytesAVertexAndGivesThemBack) {
  const Clay clay = shown_fine_ball();
  DisplaySurface surface = surface_of(clay);
  const DisplayStats all = surface.stats();
  EXPECT_LE(all.bytes, 60 * all.vertices);
  ASSERT_TRUE(surface.update(clay, view_from(1e5, 40.0, kBallVoxelMm)).ok());
  const DisplayStats far = surface.stats();
  EXPECT_LT(5 * far.bytes, 2 * all.bytes);
  ASSERT_TRUE(surface.update(clay).ok());
  EXPECT_LE(surface.stats().bytes, all.bytes + all.bytes / 10);
}

TEST(DisplaySurface, LeavesHashSurfaceAndPickingAlone) {
  std::mt19937 random(3);
  Clay clay = sculpted(random, 2);
  Surface exact;
  exact.update(clay);
  const std::uint64_t hash = clay.hash();
  const TriangleMesh before = exact.weld();
  const DisplaySurface coarse = surface_of(clay, view_from(1e5, 40.0, 0.5));
  EXPECT_GT(coarse.stats().hidden_leaves, 0);
  EXPECT_EQ(clay.hash(), hash);
  EXPECT_EQ(exact.update(clay), 0);
  EXPECT_EQ(extract_surface(clay).positions, before.positions);
  EXPECT_EQ(extract_surface(clay).triangles, before.triangles);
}

TEST(DisplaySurface, RefusesAViewOutOfRangeAndChangesNothing) {
  const Clay clay = shown_fine_ball();
  const DisplayView good = view_from(20.0, 20.0, kBallVoxelMm);
  DisplaySurface surface = surface_of(clay, good);
  const auto before = all_blocks(surface);
  const std::size_t listed = surface.changed().size();
  std::vector<DisplayView> bad(9, view_from(1e5, 20.0, kBallVoxelMm));
  bad[0].eye_mm.y = std::numeric_limits<double>::quiet_NaN();
  bad[1].pixel_rad = -1.0;
  bad[2].pixel_rad = std::numeric_limits<double>::infinity();
  bad[3].pixel_mm = -0.1;
  bad[4].pixel_rad = 0.0;  // and pixel_mm is 0
  bad[5].voxel_pixels = 0.0;
  bad[6].hysteresis = 1.5;
  bad[7].coarser = 0;
  bad[8].coarser = 33;
  for (const DisplayView& view : bad) {
    const auto refused = surface.update(clay, view);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
    EXPECT_NE(refused.error().message.find("it must be"), std::string::npos);
  }
  EXPECT_TRUE(all_blocks(surface) == before);
  EXPECT_EQ(surface.changed().size(), listed);
  EXPECT_EQ(surface.update(clay, good).value(), 0);
}

TEST(DisplaySurfaceGolden, HasTheSameBitsForAnyThreadCount) {
  const Clay clay = shown_fine_ball();
  DrawnCopies first;
  std::vector<BlockId> order;
  for (const std::size_t threads : {1U, 2U, 4U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    DisplaySurface surface = surface_of(clay, view_from(20.0, 20.0, kBallVoxelMm));
    ASSERT_TRUE(surface.update(clay, view_from(19.0, 20.0, kBallVoxelMm)).ok());
    const std::vector<BlockId> listed(surface.changed().begin(), surface.changed().end());
    if (first.empty()) {
      first = all_blocks(surface);
      order = listed;
    }
    EXPECT_TRUE(all_blocks(surface) == first);
    EXPECT_EQ(listed, order);
  }
}

}  // namespace
}  // namespace argil::test
