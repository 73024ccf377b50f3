// SPDX-License-Identifier: GPL-3.0-or-later
// The mask: what is held does not move, whatever the action; and the mask itself.
#include "field/mask.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/clay.h"
#include "argil/engine/pick.h"
#include "argil/engine/surface.h"

#include "brush/masked_displacement.h"
#include "clay/clay_access.h"
#include "support/effort.h"
#include "support/measure/mesh_topology.h"
#include "support/stroke_maker.h"

namespace argil {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kMaskVoxel = 0.2;
Clay ball() { return Clay::ball(10.0, ClayOptions{.voxel_mm = kMaskVoxel}).value(); }

enum class Bumps { everywhere, in_front };

/// A ball that is kept at the finest level where it has bumps, of ten voxels' wavelength:
/// everywhere, or only where x > 4 mm, of full height from x = 6 mm on.
Clay bumpy_ball(double voxel_mm = kMaskVoxel, Bumps bumps = Bumps::everywhere) {
  const double k = 2.0 * 3.14159265358979 / (10.0 * voxel_mm);
  Box3 box;
  box.include(Vec3{-11.0, -11.0, -11.0});
  box.include(Vec3{11.0, 11.0, 11.0});
  const auto distance = [=](const Vec3& p) {
    const double share = bumps == Bumps::everywhere ? 1.0 : std::clamp((p.x - 4.0) / 2.0, 0.0, 1.0);
    if (share == 0.0) return length(p) - 10.0;
    return length(p) - 10.0 -
           share * 0.75 * voxel_mm * std::sin(k * p.x) * std::sin(k * p.y) * std::sin(k * p.z);
  };
  return Clay::from_distance(distance, box, ClayOptions{.voxel_mm = voxel_mm}).value();
}

/// Usually with bumps no farther than `across_the_border` reaches.
Clay bumpy_where_worked(double voxel_mm = kMaskVoxel) {
  return bumpy_ball(voxel_mm, test::effort(Bumps::in_front, Bumps::everywhere));
}

/// Where bits are compared, and not how far matter moves, coarser clay shows the same.
Clay coarser_bumpy_ball() { return bumpy_where_worked(test::effort(0.4, kMaskVoxel)); }

/// A mask with a border two to three voxels wide: many dabs at one point raise all but the rim of
/// the falloff to 1.
void hold(Clay& clay, const Vec3& place, double radius_mm) {
  Stroke stroke = stroke_of(Action::mask, radius_mm, 1.0, {place, place});
  stroke.samples[1].time_s = 2.0;
  stroke.hold_s = 0.1;
  ASSERT_TRUE(clay.apply(stroke).ok());
}

/// The same share held wherever the tests look: to a fiftieth within 3 mm of the point.
void hold_half(Clay& clay, const Vec3& place) {
  const double radius_mm = test::effort(30.0, 60.0);  // painting costs the volume
  ASSERT_TRUE(clay.apply(stroke_of(Action::mask, radius_mm, 0.5, {place})).ok());
}

double masked_height_at(const Clay& clay, double y, double z) {
  const auto hit = pick(clay, Ray{{100.0, y, z}, {-1.0, 0.0, 0.0}});
  return hit.ok() && hit.value() ? hit.value()->point_mm.x : std::nan("");
}

/// From what is held to what is free.
Stroke across_the_border(Action action) {
  Stroke stroke = stroke_of(action, 3.0, 0.8, {{10, -3, 0}, {10.3, 0, 0}, {10, 3, 0}});
  // So that a ball's middle, on the surface, is not all that it carves.
  if (action == Action::grab) stroke.samples.back().position_mm = {12, 3, 1};
  // So that what is free stands above the plane of where it begins.
  if (action == Action::trim) stroke.tool.plane_offset = -0.7;
  return stroke;
}

struct Moved {
  double held = 0.0;  ///< the farthest that the surface moved where all around is held
  double free = 0.0;  ///< and where all around is free
};

/// How firmly the least and the most firmly masked points around a point are held.
std::pair<double, double> held_around(const Clay& clay, const Vec3& p, double reach_mm) {
  double least = 1.0;
  double most = 0.0;
  for (int n = 0; n < 27; ++n) {
    const Vec3 at = p + reach_mm * Vec3{n / 9 - 1.0, n / 3 % 3 - 1.0, n % 3 - 1.0};
    least = std::min(least, clay.mask_at(at));
    most = std::max(most, clay.mask_at(at));
  }
  return {least, most};
}

Moved moved_between(const Clay& before, const Clay& after) {
  Moved moved;
  for (const Vec3& vertex : extract_surface(before).positions) {
    const double by = std::abs(after.distance_at(vertex) - before.distance_at(vertex));
    if (by <= std::min(moved.held, moved.free)) continue;  // neither can grow
    const auto [least, most] = held_around(before, vertex, kMaskVoxel);
    if (least == 1.0) moved.held = std::max(moved.held, by);
    if (most == 0.0) moved.free = std::max(moved.free, by);
  }
  return moved;
}

/// Nodes of the finest level whose surroundings are held whole but whose bits differ.
int changed_held_nodes(const Clay& before, const Clay& after, double reach_mm) {
  int changed = 0;
  for (auto leaf = levels_of(before).grid(0).tree().cbeginLeaf(); leaf; ++leaf) {
    for (auto value = leaf->cbeginValueOn(); value; ++value) {
      const Coord node = value.getCoord();
      if (levels_of(after).node_value(0, node) == *value) continue;
      const Vec3 at{kMaskVoxel * node.x(), kMaskVoxel * node.y(), kMaskVoxel * node.z()};
      if (before.mask_at(at) < 1.0) continue;
      if (held_around(before, at, reach_mm).first == 1.0) ++changed;
    }
  }
  return changed;
}

// ---- what is held does not move ----------------------------------------------------------------

class Masked : public testing::TestWithParam<Action> {};

TEST_P(Masked, MatterStaysAcrossASharpBorderWhileFreeMatterMoves) {
  Clay clay = bumpy_where_worked();
  hold(clay, {10, -3, 0}, 4.0);
  const Clay before = [] {
    Clay same = bumpy_where_worked();
    hold(same, {10, -3, 0}, 4.0);
    return same;
  }();
  const auto done = clay.apply(across_the_border(GetParam()));
  ASSERT_TRUE(done.ok()) << done.error().message;
  const Moved moved = moved_between(before, clay);
  // A square tip raises a wall along the border, about which more is redistanced.
  const double reach = GetParam() == Action::clay_strips ? 8.0 : 6.0;
  const int changed = changed_held_nodes(before, clay, reach * kMaskVoxel);
  std::printf("action %d: held %.4f voxels, free %.2f voxels, %d held nodes with other bits\n",
              static_cast<int>(GetParam()), moved.held / kMaskVoxel, moved.free / kMaskVoxel,
              changed);
  EXPECT_LE(moved.held, 0.02 * kMaskVoxel);
  EXPECT_GE(moved.free, 0.3 * kMaskVoxel);
  EXPECT_EQ(changed, 0) << "more than " << reach << " voxels within the border every bit stays";
  EXPECT_THAT(clay.validate(), IsEmpty());
  EXPECT_EQ(test::find_mesh_faults(extract_surface(clay)), test::MeshFaults{});
}

/// Smooth clay is stored coarsely and large tools work on coarse levels; the border needs finer.
TEST_P(Masked, LargeToolsKeepASharpBorderOfSmoothClay) {
  const auto made = [] {
    Clay clay = Clay::ball(20.0, ClayOptions{.voxel_mm = kMaskVoxel}).value();
    hold(clay, {20, -2, 0}, 3.0);
    return clay;
  };
  const Clay before = made();
  Clay clay = made();
  const Vec3 end = GetParam() == Action::grab ? Vec3{22, 2, 0} : Vec3{20, 2, 0};
  ASSERT_TRUE(clay.apply(stroke_of(GetParam(), 8.0, 0.8, {{20, -2, 0}, end})).ok());
  const Moved moved = moved_between(before, clay);
  std::printf("action %d: held %.3f voxels, free %.2f voxels\n", static_cast<int>(GetParam()),
              moved.held / kMaskVoxel, moved.free / kMaskVoxel);
  EXPECT_LE(moved.held, 0.25 * kMaskVoxel);
  EXPECT_THAT(clay.validate(), IsEmpty());
}

TEST_P(Masked, NothingMovesWhereAllIsHeld) {
  Clay clay = bumpy_where_worked();
  const std::uint64_t start = clay.hash();
  ASSERT_TRUE(clay.apply(MaskEdit::fill).ok());
  ASSERT_TRUE(clay.apply(across_the_border(GetParam())).ok());
  ASSERT_TRUE(clay.apply(MaskEdit::clear).ok());
  EXPECT_EQ(clay.hash(), start);
}

TEST_P(Masked, AMaskElsewhereLeavesEveryBit) {
  const Stroke stroke = across_the_border(GetParam());
  Clay plain = coarser_bumpy_ball();
  ASSERT_TRUE(plain.apply(stroke).ok());
  Clay masked = coarser_bumpy_ball();
  hold(masked, {-10, 0, 0}, 4.0);
  ASSERT_TRUE(masked.has_mask());
  ASSERT_TRUE(masked.apply(stroke).ok());
  EXPECT_NE(masked.hash(), plain.hash());
  ASSERT_TRUE(masked.apply(MaskEdit::clear).ok());
  EXPECT_EQ(masked.hash(), plain.hash());
}

TEST_P(Masked, StrokeInPiecesEndsAsInOneAndCanBeTakenBack) {
  const Stroke stroke = across_the_border(GetParam());
  Clay whole = coarser_bumpy_ball();
  hold(whole, {10, -3, 0}, 4.0);
  const std::uint64_t start = whole.hash();
  ASSERT_TRUE(whole.begin_stroke(stroke.tool, stroke).ok());
  for (const StrokeSample& sample : stroke.samples) {
    ASSERT_TRUE(whole.extend_stroke({&sample, 1}).ok());
  }
  ASSERT_TRUE(whole.cancel_stroke());
  EXPECT_EQ(whole.hash(), start);
  ASSERT_TRUE(whole.begin_stroke(stroke.tool, stroke).ok());
  for (const StrokeSample& sample : stroke.samples) {
    ASSERT_TRUE(whole.extend_stroke({&sample, 1}).ok());
  }
  ASSERT_TRUE(whole.end_stroke().ok());
  const std::uint64_t pieces = whole.hash();
  ASSERT_TRUE(whole.undo());
  EXPECT_EQ(whole.hash(), start);
  ASSERT_TRUE(whole.apply(stroke).ok());
  EXPECT_EQ(whole.hash(), pieces);
}
INSTANTIATE_TEST_SUITE_P(Clay, Masked, testing::ValuesIn(actions_on_levels()));

TEST(MaskedHalf, MovesAboutHalfAsFar) {
  struct Case {
    Action action;
    std::vector<Vec3> places;
  };
  const Case cases[] = {{Action::add, {{10, 0, 0}}},
                        {Action::carve, {{10, 0, 0}}},
                        {Action::inflate, {{10, 0, 0}}},
                        {Action::smooth, {{10, 0, 0}}},
                        {Action::flatten, {{10, 0, 0}}},
                        {Action::scrape, {{10, 0, 0}}},
                        {Action::crease, {{10, -1, 0}, {10.1, 0, 0}, {10, 1, 0}}},
                        {Action::ridge, {{10, -1, 0}, {10.1, 0, 0}, {10, 1, 0}}},
                        {Action::layer, {{10, 0, 0}}},
                        {Action::noise, {{10, 0, 0}}},
                        {Action::clay, {{9.8, -2, 0}, {10, 0, 0}, {9.8, 2, 0}}},
                        {Action::clay_strips, {{9.8, -2, 0}, {10, 0, 0}, {9.8, 2, 0}}},
                        {Action::grab, {{10, 0, 0}, {12, 0, 0}}},
                        {Action::elastic, {{10, 0, 0}, {12, 0, 0}}},
                        {Action::snake_hook, {{10, 0, 0}, {12, 0, 0}}}};
  for (const Case& c : cases) {
    // A knob for what smooths and flattens.
    Clay start = ball();
    const bool knob =
        c.action == Action::smooth || c.action == Action::flatten || c.action == Action::scrape;
    if (knob) {
      ASSERT_TRUE(start.apply(stroke_of(Action::add, 1.0, 1.0, {{9.8, 0, 0}})).ok());
    }
    const double at_start = masked_height_at(start, 0, 0);
    const Stroke stroke = stroke_of(c.action, 3.0, 0.6, c.places);
    ASSERT_TRUE(start.apply(stroke).ok());
    const double free = masked_height_at(start, 0, 0) - at_start;
    ASSERT_TRUE(start.undo());
    hold_half(start, {10, 0, 0});
    ASSERT_TRUE(start.apply(stroke).ok());
    const double half = masked_height_at(start, 0, 0) - at_start;
    std::printf("action %d: %.3f free, %.3f half held: %.2f\n", static_cast<int>(c.action), free,
                half, half / free);
    EXPECT_GT(std::abs(free), 0.1 * kMaskVoxel);
    EXPECT_NEAR(half / free, 0.5, 0.1) << static_cast<int>(c.action);
    EXPECT_THAT(start.validate(), IsEmpty());
  }
}

TEST(MaskedHalf, CarvesAndAddsAsHalfTheStrengthHoweverManyDabs) {
  const double way_mm = test::effort(1.5, 3.0);  // to either side: 20 or 40 dabs
  for (const Action action : {Action::add, Action::carve}) {
    Stroke stroke = stroke_of(action, 3.0, 1.0, {{10, -way_mm, 0}, {10, way_mm, 0}});
    stroke.spacing = 0.05;
    Clay held = ball();
    hold_half(held, {10, 0, 0});
    ASSERT_TRUE(held.apply(stroke).ok());
    Clay weak = ball();
    stroke.tool.strength = 0.5;
    ASSERT_TRUE(weak.apply(stroke).ok());
    EXPECT_NEAR(masked_height_at(held, 0, 0), masked_height_at(weak, 0, 0), 0.5 * kMaskVoxel);
  }
}

TEST(MaskMotion, KeepsTheOrderOfMatter) {
  // Free below node 4 along z, held from node 5 on.
  Mask mask(2.0 * kMaskVoxel, 0.0F);
  LeafValues values;
  for (std::size_t n = 0; n < kLeafNodes; ++n) values[n] = n % 8 >= 5 ? 1.0F : 0.0F;
  mask.put(Coord(0, 0, 0), values);
  const Vec3 middle{8.0 * kMaskVoxel, 8.0 * kMaskVoxel, 0.0};
  Box3 box;
  box.include(middle + Vec3{-1, -1, -5});
  box.include(middle + Vec3{1, 1, 5});
  const MaskedDisplacement displacement(&mask, box);
  for (const double way : {3.0, -3.0, 0.1, -0.1}) {
    double last = -1e9;
    for (double z = -4.0; z <= 7.0 * 2.0 * kMaskVoxel; z += 0.01) {
      const Vec3 from{middle.x, middle.y, z};
      const Vec3 at = displacement.along(from, {0, 0, way});
      EXPECT_GE(at.z, last) << "way " << way << " from " << z;
      last = at.z;
      if (mask.at(from) == 1.0) {
        EXPECT_EQ(at, from);
      }
      if (z + std::max(0.0, way) < 4.0 * 2.0 * kMaskVoxel) {
        EXPECT_EQ(at.z, z + way);
      }
    }
  }
}

// ---- the mask itself ---------------------------------------------------------------------------

TEST(MaskPaint, RaisesAndLowersByStrengthAndFalloff) {
  Clay clay = ball();
  EXPECT_FALSE(clay.has_mask());
  EXPECT_EQ(clay.mask_at({10, 0, 0}), 0.0);
  ASSERT_TRUE(clay.apply(stroke_of(Action::mask, 2.0, 0.4, {{10, 0, 0}})).ok());
  EXPECT_TRUE(clay.has_mask());
  EXPECT_NEAR(clay.mask_at({10, 0, 0}), 0.4, 1e-6);
  EXPECT_NEAR(clay.mask_at({10, 0.8, 0}), 0.4 * (1 - 0.16) * (1 - 0.16), 0.02);
  EXPECT_EQ(clay.mask_at({10, 2.4, 0}), 0.0);
  ASSERT_TRUE(clay.apply(stroke_of(Action::mask, 2.0, -0.3, {{10, 0, 0}})).ok());
  EXPECT_NEAR(clay.mask_at({10, 0, 0}), 0.1, 1e-6);
  ASSERT_TRUE(clay.apply(stroke_of(Action::mask, 2.0, -1.0, {{10, 0, 0}})).ok());
  EXPECT_EQ(clay.mask_at({10, 0, 0}), 0.0);
  hold(clay, {10, 0, 0}, 2.0);
  EXPECT_EQ(clay.mask_at({10, 0.5, 0}), 1.0);
  EXPECT_THAT(clay.validate(), IsEmpty());
}

TEST(MaskPaint, HardlyDependsOnTheSpacing) {
  for (const double spacing : {0.05, 0.5}) {
    Clay clay = ball();
    Stroke stroke = stroke_of(Action::mask, 3.0, 0.1, {{10, -4, 0}, {10, 4, 0}});
    stroke.spacing = spacing;
    ASSERT_TRUE(clay.apply(stroke).ok());
    // The integral of (1 - x^2)^2 over -1..1, 16/15, in quarter radii.
    EXPECT_NEAR(clay.mask_at({10, 0, 0}), 0.1 * 4.0 * 16.0 / 15.0, 0.02) << spacing;
  }
}

TEST(MaskPaint, IsExactlySymmetricAtNodes) {
  Clay clay = ball();
  Stroke stroke = stroke_of(Action::mask, 2.0, 0.3, {{9, 1, 2}, {9, 4, 1}});
  stroke.mirror = {true, true, false};
  ASSERT_TRUE(clay.apply(stroke).ok());
  const Mask& mask = *levels_of(clay).mask();
  int held = 0;
  for (int n = 0; n < 30 * 30 * 30; ++n) {
    const Coord node(n / 900, n / 30 % 30, n % 30);
    const float m = mask.constant(node);
    held += m > 0.0F ? 1 : 0;
    EXPECT_EQ(mask.constant(Coord(-node.x(), node.y(), node.z())), m);
    EXPECT_EQ(mask.constant(Coord(node.x(), -node.y(), node.z())), m);
    EXPECT_EQ(mask.constant(Coord(-node.x(), -node.y(), node.z())), m);
  }
  EXPECT_GT(held, 100);
}

TEST(MaskPaint, LeavesTheSurfaceAndIsUndoneAndRedone) {
  Clay clay = ball();
  Surface surface;
  surface.update(clay);
  const std::uint64_t start = clay.hash();
  hold(clay, {10, 0, 0}, 3.0);
  const std::uint64_t once = clay.hash();
  EXPECT_NE(once, start);
  EXPECT_EQ(surface.update(clay), 0);
  hold(clay, {0, 10, 0}, 3.0);
  const std::uint64_t twice = clay.hash();
  ASSERT_TRUE(clay.undo());
  EXPECT_EQ(clay.hash(), once);
  ASSERT_TRUE(clay.undo());
  EXPECT_EQ(clay.hash(), start);
  EXPECT_FALSE(clay.has_mask());
  ASSERT_TRUE(clay.redo());
  ASSERT_TRUE(clay.redo());
  EXPECT_EQ(clay.hash(), twice);
  ASSERT_TRUE(clay.begin_stroke(stroke_of(Action::mask, 5.0, -1.0, {{10, 0, 0}}).tool).ok());
  const StrokeSample sample{0.0, {10, 0, 0}, {}, 1.0};
  ASSERT_TRUE(clay.extend_stroke({&sample, 1}).ok());
  EXPECT_NE(clay.hash(), twice);
  ASSERT_TRUE(clay.cancel_stroke());
  EXPECT_EQ(clay.hash(), twice);
}

TEST(MaskPaint, StaysWithinTheMemoryLimit) {
  Clay clay = ball();
  ClayLimits limits;
  limits.memory_bytes = clay.use().level_bytes + 10'000;
  ASSERT_TRUE(clay.set_limits(limits).ok());
  const std::uint64_t start = clay.hash();
  const auto refused = clay.apply(stroke_of(Action::mask, 8.0, 1.0, {{10, 0, 0}}));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::memory);
  EXPECT_EQ(clay.hash(), start);
}

TEST(MaskEdits, StayWithinTheMemoryLimit) {
  Clay clay = ball();
  hold(clay, {10, 0, 0}, 4.0);
  const std::uint64_t start = clay.hash();
  const ClayUse use = clay.use();
  ClayLimits limits;
  limits.memory_bytes = use.level_bytes + use.mask_bytes + use.undo_bytes + use.mask_bytes / 2;
  ASSERT_TRUE(clay.set_limits(limits).ok());
  for (const MaskEdit edit : {MaskEdit::invert, MaskEdit::blur}) {
    const auto refused = clay.apply(edit);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::memory);
    EXPECT_NE(refused.error().message.find("memory limit"), std::string::npos);
    EXPECT_EQ(clay.hash(), start);
  }
  EXPECT_TRUE(clay.apply(MaskEdit::fill).ok());
}

TEST(MaskPaint, CostsUndoByThePlacesItTouches) {
  Clay clay = bumpy_ball();
  hold(clay, {10, 0, 0}, 8.0);
  const std::int64_t large = clay.use().undo_bytes;
  hold(clay, {10, 0, 0}, 1.0);
  EXPECT_GT(large, 0);
  EXPECT_LT(clay.use().undo_bytes - large, large / 10);
  std::printf("mask %.2f MB, levels %.2f MB\n", 1e-6 * static_cast<double>(clay.use().mask_bytes),
              1e-6 * static_cast<double>(clay.use().level_bytes));
  EXPECT_LT(clay.use().mask_bytes, clay.use().level_bytes / 4);
  ClayLimits limits;
  limits.undo_bytes = 1;
  ASSERT_TRUE(clay.set_limits(limits).ok());
  EXPECT_EQ(clay.undo_depth(), 1);
  EXPECT_EQ(clay.use().steps_forgotten, 1);
}

TEST(MaskEditOf, EachIsOneStepToUndo) {
  Clay clay = ball();
  hold(clay, {10, 0, 0}, 3.0);
  for (const MaskEdit edit : {MaskEdit::clear, MaskEdit::invert, MaskEdit::blur, MaskEdit::fill}) {
    const std::uint64_t before = clay.hash();
    const int depth = clay.undo_depth();
    ASSERT_TRUE(clay.apply(edit).ok());
    EXPECT_EQ(clay.undo_depth(), depth + 1);
    EXPECT_THAT(clay.validate(), IsEmpty());
    const std::uint64_t after = clay.hash();
    EXPECT_NE(after, before);
    ASSERT_TRUE(clay.undo());
    EXPECT_EQ(clay.hash(), before);
    ASSERT_TRUE(clay.redo());
    EXPECT_EQ(clay.hash(), after);
    ASSERT_TRUE(clay.undo());
  }
}

TEST(MaskEditOf, InvertTwiceIsAsBeforeAndReachesAllSpace) {
  Clay clay = ball();
  Stroke stroke = stroke_of(Action::mask, 3.0, 0.37, {{10, 0, 0}, {9, 4, 0}});
  ASSERT_TRUE(clay.apply(stroke).ok());
  const std::uint64_t before = clay.hash();
  const double held = clay.mask_at({10, 0.3, 0.1});
  ASSERT_TRUE(clay.apply(MaskEdit::invert).ok());
  EXPECT_EQ(clay.mask_at({500, 0, 0}), 1.0);
  EXPECT_EQ(clay.mask_at({0, 0, 0}), 1.0);
  EXPECT_NEAR(clay.mask_at({10, 0.3, 0.1}), 1.0 - held, 1e-6);
  ASSERT_TRUE(clay.apply(MaskEdit::invert).ok());
  EXPECT_EQ(clay.hash(), before);
}

TEST(MaskEditOf, FillHoldsAllClearNoneAndBlurChangesNeither) {
  Clay clay = ball();
  const std::uint64_t start = clay.hash();
  ASSERT_TRUE(clay.apply(MaskEdit::blur).ok());
  EXPECT_EQ(clay.hash(), start);
  ASSERT_TRUE(clay.apply(MaskEdit::fill).ok());
  const std::uint64_t full = clay.hash();
  EXPECT_EQ(clay.mask_at({1, 2, 3}), 1.0);
  ASSERT_TRUE(clay.apply(MaskEdit::blur).ok());
  EXPECT_EQ(clay.hash(), full);
  ASSERT_TRUE(clay.apply(MaskEdit::clear).ok());
  EXPECT_EQ(clay.hash(), start);
}

TEST(MaskEditOf, BlurSoftensTheBorder) {
  Clay clay = ball();
  hold(clay, {10, 0, 0}, 4.0);
  const auto steepest = [&] {
    double most = 0.0;
    for (double y = 0.0; y < 6.0; y += 0.1) {
      most = std::max(most, clay.mask_at({9, y, 0}) - clay.mask_at({9, y + 0.4, 0}));
    }
    return most;
  };
  const double sharp = steepest();
  for (int n = 0; n < 3; ++n) ASSERT_TRUE(clay.apply(MaskEdit::blur).ok());
  EXPECT_LT(steepest(), 0.6 * sharp);
  EXPECT_GT(clay.mask_at({10, 0, 0}), 0.99);
  EXPECT_EQ(clay.mask_at({-10, 0, 0}), 0.0);
  EXPECT_THAT(clay.validate(), IsEmpty());
}

TEST(MaskEditOf, IsRefusedWhileAStrokeIsOpenAndForANumberThatIsNone) {
  Clay clay = ball();
  const std::uint64_t start = clay.hash();
  const auto unknown = clay.apply(static_cast<MaskEdit>(7));
  ASSERT_FALSE(unknown.ok());
  EXPECT_THAT(unknown.error().message,
              HasSubstr("7; must be clear, invert, blur, fill or sharpen"));
  ASSERT_TRUE(clay.begin_stroke(Tool{}).ok());
  EXPECT_FALSE(clay.apply(MaskEdit::fill).ok());
  ASSERT_TRUE(clay.cancel_stroke());
  EXPECT_EQ(clay.hash(), start);
}

TEST(MaskAndOperations, IsIgnoredAndKept) {
  Clay clay = ball();
  hold(clay, {10, 0, 0}, 3.0);
  const std::uint64_t start = clay.hash();
  const double held = clay.mask_at({10.5, 2.5, 0});
  ASSERT_TRUE(clay.apply(Operation(Offset{0.5})).ok());
  EXPECT_NEAR(masked_height_at(clay, 0, 0), 10.5, 0.1);
  EXPECT_EQ(clay.mask_at({10.5, 2.5, 0}), held);
  ASSERT_TRUE(clay.apply(Operation(Cut{{0, 0, 5}, {0, 0, 1}, false})).ok());
  EXPECT_EQ(clay.mask_at({10.5, 2.5, 0}), held);
  for (const double voxel : {0.4, 0.15}) {
    ASSERT_TRUE(clay.apply(Operation(Resample{voxel})).ok());
    EXPECT_EQ(clay.mask_at({10, 0, 0}), 1.0) << voxel;
    EXPECT_NEAR(clay.mask_at({10, 2.5, 0}), held, 0.5) << voxel;
    EXPECT_EQ(clay.mask_at({10, 5, 0}), 0.0) << voxel;
    EXPECT_THAT(clay.validate(), IsEmpty());
  }
  while (clay.undo_depth() > 1) ASSERT_TRUE(clay.undo());
  EXPECT_EQ(clay.hash(), start);
}

TEST(MaskGolden, GivesTheSameBitsForAnyThreadCount) {
  std::vector<std::uint64_t> hashes;
  for (const std::size_t threads : {1U, 3U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Clay clay = coarser_bumpy_ball();
    hold(clay, {10, -3, 0}, 4.0);
    ASSERT_TRUE(clay.apply(MaskEdit::blur).ok());
    for (const Action action : actions_on_levels()) {
      ASSERT_TRUE(clay.apply(across_the_border(action)).ok());
    }
    hashes.push_back(clay.hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

/// A tool that reaches far into the air beside a mask fills all of itself.
TEST(MaskAdd, FillsTheToolFarFromTheSurfaceToo) {
  Clay clay = ball();
  hold(clay, {0.0, 0.0, 10.0}, 1.0);
  ASSERT_TRUE(clay.apply(stroke_of(Action::add, 4.0, 1.0, {{2.0, 0.0, 12.0}})).ok());
  for (const double up : {-1.0, 0.0, 1.0, 2.0, 3.0}) {
    EXPECT_LT(clay.distance_at({2.0 + up, 0.0, 12.0 + 0.5 * up}), 0.0) << up;
  }
}

}  // namespace
}  // namespace argil
