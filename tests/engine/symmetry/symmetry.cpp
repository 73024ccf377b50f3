// SPDX-License-Identifier: GPL-3.0-or-later
// Mirrored and radial strokes: what they make is symmetric, to the bit where the lattice is.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/pick.h"
#include "argil/engine/surface.h"

#include "clay/clay_access.h"
#include "field/level_stack.h"
#include "support/effort.h"
#include "support/measure/mesh_topology.h"
#include "support/stroke_maker.h"

namespace argil {
namespace {

using testing::IsEmpty;

Coord reflected(Coord node, int axis) {
  node[axis] = -node[axis];
  return node;
}

void mix(std::uint64_t& hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x100000001b3ULL;
  hash ^= hash >> 29;
}

/// The corners of the cells of a leaf; zeros have no sign.
void mix_corners(const LevelStack& stack, int level, const Coord& seen, int axis, bool positive,
                 std::uint64_t& hash) {
  const float band = stack.band_mm(level);
  for (int x = 0; x <= kLeafSide; ++x) {
    for (int y = 0; y <= kLeafSide; ++y) {
      for (int z = 0; z <= kLeafSide; ++z) {
        const Coord node = seen.offsetBy(x, y, z);
        const float value = stack.sample(level, positive ? node : reflected(node, axis));
        mix(hash, std::bit_cast<std::uint32_t>(std::clamp(value, -band, band) + 0.0F));
      }
    }
  }
}

/// What lies on one side of the plane through the origin across `axis`, hashed as seen from that
/// side: of every level which cells it has, and the bits of the values at all their corners,
/// interpolated where the level does not store them, within its band.
std::uint64_t half_hash(const Clay& clay, int axis, bool positive) {
  const LevelStack& stack = levels_of(clay);
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (int level = 0; level < stack.count(); ++level) {
    std::vector<Coord> seen;
    for (const Coord& place : stack.sorted_origins(level)) {
      if ((place[axis] >= 0) != positive) continue;
      Coord at = place;
      if (!positive) at[axis] = -place[axis] - kLeafSide;
      seen.push_back(at);
    }
    std::sort(seen.begin(), seen.end());
    for (const Coord& at : seen) {
      for (int a = 0; a < 3; ++a) mix(hash, static_cast<std::uint32_t>(at[a]));
      mix_corners(stack, level, at, axis, positive, hash);
    }
  }
  return hash;
}

/// A stroke that wanders to and over the planes of symmetry, usually in few dabs.
Stroke wandering(Action action) {
  Stroke stroke;
  stroke.tool = {action, Shape::ball, {2, 2, 2}, 0.8};
  stroke.spacing = test::effort(0.75, stroke.spacing);
  stroke.samples = {{0.0, {9.3, 2.1, 1.0}, {}, 1.0},
                    {0.5, {8.0, 4.9, 2.2}, {}, 0.7},
                    {1.0, {4.4, 8.1, 0.3}, {}, 0.9},
                    {1.5, {-1.2, 9.2, -1.0}, {}, 1.0}};
  return stroke;
}

/// The farthest that the image of the clay's surface lies from it.
template <class Image>
double asymmetry(const Clay& clay, const Image& image) {
  double most = 0.0;
  for (const Vec3& vertex : extract_surface(clay).positions) {
    const double off = clay.distance_at(image(vertex)) - clay.distance_at(vertex);
    most = std::max(most, std::abs(off));
  }
  return most;
}

Clay symmetric_ball(double voxel_mm = 0.2) {
  return Clay::ball(9.0, ClayOptions{.voxel_mm = voxel_mm}).value();
}

class SymmetryProperty : public testing::TestWithParam<Action> {
 protected:
  Action action() const { return GetParam(); }
  double voxel_mm() const { return voxel_mm_; }
  Clay start() const { return symmetric_ball(voxel_mm_); }

 private:
  double voxel_mm_ = test::effort(0.4, 0.2);
};

TEST_P(SymmetryProperty, HashesOfMirroredHalvesAreEqual) {
  Stroke stroke = wandering(action());
  stroke.mirror = {true, false, false};
  Clay clay = start();
  ASSERT_EQ(half_hash(clay, 0, true), half_hash(clay, 0, false));
  const std::uint64_t before = half_hash(clay, 0, true);
  ASSERT_TRUE(clay.apply(stroke).ok());
  EXPECT_EQ(half_hash(clay, 0, true), half_hash(clay, 0, false));
  EXPECT_NE(half_hash(clay, 0, true), before);
  EXPECT_THAT(clay.validate(), IsEmpty());
  EXPECT_EQ(test::find_mesh_faults(extract_surface(clay)), test::MeshFaults{});
  ASSERT_TRUE(clay.undo());
  EXPECT_EQ(clay.hash(), start().hash());
}

TEST_P(SymmetryProperty, StaysOverStrokesAndPlanes) {
  Clay clay = start();
  Stroke stroke = wandering(action());
  stroke.mirror = {true, true, true};
  ASSERT_TRUE(clay.apply(stroke).ok());
  stroke = wandering(Action::carve);
  stroke.tool.radii_mm = {0.9, 0.9, 0.9};
  for (StrokeSample& sample : stroke.samples) std::swap(sample.position_mm.x, sample.position_mm.z);
  stroke.mirror = {true, true, true};
  ASSERT_TRUE(clay.apply(stroke).ok());
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(half_hash(clay, axis, true), half_hash(clay, axis, false)) << axis;
  }
  EXPECT_THAT(clay.validate(), IsEmpty());
}

/// Quarter turns change the order in which interpolation goes through the axes, and so roundings.
TEST_P(SymmetryProperty, QuarterTurnsAgreeButForRounding) {
  Stroke stroke = wandering(action());
  stroke.radial = {4, 2};
  Clay clay = start();
  ASSERT_TRUE(clay.apply(stroke).ok());
  EXPECT_LE(asymmetry(clay, [](const Vec3& p) { return Vec3{-p.y, p.x, p.z}; }), 2e-5 * voxel_mm());
  EXPECT_THAT(clay.validate(), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Actions, SymmetryProperty, testing::ValuesIn(actions_on_levels()));

/// What is on one side only is not copied over the other.
TEST(Symmetry, KeepsWhatWasNotSymmetric) {
  Clay clay = symmetric_ball();
  Stroke bump;
  bump.tool = {Action::add, Shape::ball, {1, 1, 1}, 1.0};
  bump.samples = {{0.0, {-9, 0, 0}, {}, 1.0}};
  ASSERT_TRUE(clay.apply(bump).ok());
  Stroke stroke;
  stroke.tool = {Action::smooth, Shape::ball, {2, 2, 2}, 0.1};
  stroke.samples = {{0.0, {9, 0.5, 0}, {}, 1.0}};
  stroke.mirror = {true, false, false};
  ASSERT_TRUE(clay.apply(stroke).ok());
  EXPECT_LT(clay.distance_at({-9.5, 0, 0}), 0.0);
  EXPECT_GT(clay.distance_at({9.5, 0, 0}), 0.3);
}

/// Fine detail that averages away on the coarser levels.
TEST(Symmetry, KeepsFineDetailOfOneSide) {
  const auto rippled = [](const Vec3& p) {
    const double block = std::max({std::abs(p.x) - 9.0, std::abs(p.y) - 9.0, std::abs(p.z) - 6.0});
    const bool is_there = p.x > 2.0 && p.x < 8.0 && std::abs(p.y) < 7.0 && p.z > 4.0;
    return is_there ? block - 0.15 * std::sin(2.0 * 3.14159265358979 * p.y / 0.6) : block;
  };
  Box3 box;
  box.include({-10, -10, -7});
  box.include({10, 10, 7});
  Clay clay = Clay::from_distance(rippled, box, ClayOptions{.voxel_mm = 0.2}).value();
  Stroke stroke;
  stroke.tool = {Action::add, Shape::ball, {0.5, 0.5, 0.5}, 1.0};
  stroke.samples = {{0.0, {4.5, -5, 6}, {}, 1.0}, {1.0, {4.5, 5, 6}, {}, 1.0}};
  stroke.mirror = {true, false, false};
  ASSERT_TRUE(clay.apply(stroke).ok());
  for (double y = -4.0; y < 4.0; y += 0.1) {
    EXPECT_NEAR(clay.distance_at({-6.0, y, 6.0}), 0.0, 0.01) << y;
  }
}

/// Where images meet they take the matter as far as the hand goes, not twice as far.
TEST(Symmetry, ImagesThatMeetShareWhatTheyGrab) {
  const auto top = [](const Mirror& mirror, const Radial& radial) {
    Clay clay = symmetric_ball();
    Stroke stroke;
    stroke.tool = {Action::grab, Shape::ball, {3, 3, 3}, 1.0};
    stroke.samples = {{0.0, {0, 0, 9}, {}, 1.0}, {1.0, {0, 0, 11}, {}, 1.0}};
    stroke.mirror = mirror;
    stroke.radial = radial;
    EXPECT_TRUE(clay.apply(stroke).ok());
    const auto hit = pick(clay, Ray{{0, 0, 30}, {0, 0, -1}});
    return hit.ok() && hit.value() ? hit.value()->point_mm.z : 0.0;
  };
  const double alone = top({}, {});
  EXPECT_NEAR(alone, 11.0, 0.05);
  EXPECT_NEAR(top({true, false, false}, {}), alone, 0.02);
  EXPECT_NEAR(top({true, true, false}, {}), alone, 0.02);
  EXPECT_NEAR(top({true, true, false}, {4, 2}), alone, 0.02);
}

/// Balls and blocks of any size and tolerance, and a few strokes on each.
TEST(SymmetryOfRandomStrokesProperty, KeepsHalvesEqualAndEveryInvariant) {
  SymmetryCount count;
  for (unsigned seed = 0; seed < test::effort(8U, 60U); ++seed) {
    std::mt19937 random(seed);
    Clay clay = random_start(random);
    const Mirror mirror{true, random() % 2 == 0, random() % 3 == 0};
    const Radial radial{random() % 3 == 0 ? 4 : 1, random() % 3};
    for (int n = 0; n < 3; ++n) {
      Stroke stroke = random_dab(random, 8.0);
      stroke.tool.action = actions_on_levels()[random() % actions_on_levels().size()];
      stroke.tool.strength = std::abs(stroke.tool.strength);
      stroke.mirror = mirror;
      stroke.radial = radial;
      SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << describe(stroke));
      const auto report = clay.apply(stroke);
      ASSERT_TRUE(report.ok());
      count.add(report.value());
      ASSERT_THAT(clay.validate(), IsEmpty());
      const std::array<bool, 3> planes{mirror.x, mirror.y, mirror.z};
      for (int axis = 0; axis < 3; ++axis) {
        if (!planes[static_cast<std::size_t>(axis)]) continue;
        ASSERT_EQ(half_hash(clay, axis, true), half_hash(clay, axis, false)) << axis;
      }
    }
  }
  count.print();
}

TEST(Symmetry, HoldsWhatOneSideHolds) {
  Clay clay = symmetric_ball();
  Stroke hold;
  hold.tool = {Action::mask, Shape::ball, {3, 3, 3}, 1.0};
  hold.hold_s = 0.1;
  hold.samples = {{0.0, {-9, 0, 0}, {}, 1.0}, {2.0, {-9, 0, 0}, {}, 1.0}};
  ASSERT_TRUE(clay.apply(hold).ok());
  Stroke stroke;
  stroke.tool = {Action::add, Shape::ball, {1, 1, 1}, 1.0};
  stroke.samples = {{0.0, {9, 0, 0}, {}, 1.0}};
  stroke.mirror = {true, false, false};
  ASSERT_TRUE(clay.apply(stroke).ok());
  EXPECT_LT(clay.distance_at({9.5, 0, 0}), 0.0);
  EXPECT_GT(clay.distance_at({-9.5, 0, 0}), 0.3);
}

TEST(Symmetry, ImagesOfDabsAreExact) {
  Stroke stroke = wandering(Action::add);
  stroke.mirror = {true, true, false};
  stroke.radial = {4, 2};
  const std::vector<Dab> dabs = dabs_of(stroke);
  // Two planes through the axis are one of them and a half turn: no image comes twice.
  ASSERT_EQ(dabs.size() % 8, 0U);
  for (std::size_t i = 0; i < dabs.size(); i += 8) {
    const Vec3& p = dabs[i].at.position_mm;
    EXPECT_EQ(dabs[i + 1].at.position_mm, (Vec3{-p.x, p.y, p.z}));
    EXPECT_EQ(dabs[i + 2].at.position_mm, (Vec3{-p.y, p.x, p.z}));
    EXPECT_EQ(dabs[i + 4].at.position_mm, (Vec3{-p.x, -p.y, p.z}));
    EXPECT_EQ(dabs[i + 5].at.position_mm, (Vec3{p.x, -p.y, p.z}));
    EXPECT_TRUE(dabs[i + 1].is_mirrored);
    EXPECT_FALSE(dabs[i + 2].is_mirrored);
    for (std::size_t n = i; n < i + 8; ++n) {
      const Vec3 reflected{dabs[n].is_mirrored ? -p.x : p.x, p.y, p.z};
      EXPECT_LT(length(rotate(dabs[n].turn, reflected) - dabs[n].at.position_mm), 1e-14) << n;
    }
  }
}

/// In any plane and about any axis.
TEST(Symmetry, DabsSayHowTheirImagesWereMade) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Stroke stroke = wandering(Action::add);
    stroke.mirror = {true, true, true};
    stroke.radial = {5, axis};
    const std::vector<Dab> dabs = dabs_of(stroke);
    const std::size_t images = dabs.size() / dabs_of(wandering(Action::add)).size();
    ASSERT_EQ(images, 40U);
    for (std::size_t n = 0; n < dabs.size(); ++n) {
      Vec3 at = dabs[n - n % images].at.position_mm;
      if (dabs[n].is_mirrored) at.x = -at.x;
      EXPECT_LT(length(rotate(dabs[n].turn, at) - dabs[n].at.position_mm), 1e-12) << n;
    }
  }
}

TEST(Symmetry, RadialStrokesRepeatAroundTheAxis) {
  Clay clay = Clay::ball(9.0, ClayOptions{.voxel_mm = 0.2}).value();
  Stroke stroke;
  stroke.tool = {Action::carve, Shape::ball, {1, 1, 1}, 1.0};
  stroke.radial = {5, 2};
  stroke.samples = {{0.0, {9, 0, 0}, {}, 1.0}};
  EXPECT_EQ(clay.apply(stroke).value().dabs, 5);
  for (int i = 0; i < 5; ++i) {
    const double a = 2.0 * 3.14159265358979 * i / 5;
    const Vec3 along{std::cos(a), std::sin(a), 0.0};
    const auto hit = pick(clay, Ray{along * 30.0, -along});
    ASSERT_TRUE(hit.ok() && hit.value());
    EXPECT_NEAR(length(hit.value()->point_mm), 8.0, 0.02);
  }
}

}  // namespace
}  // namespace argil
