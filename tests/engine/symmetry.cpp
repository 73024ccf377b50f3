// SPDX-License-Identifier: GPL-3.0-or-later
// Mirrored and radial strokes: what they make is symmetric within the tolerance.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/pick.h"
#include "argil/engine/surface.h"

namespace argil {
namespace {

/// A stroke that wanders to and over the planes of symmetry.
Stroke wandering(Action action) {
  Stroke stroke;
  stroke.tool = {action, Shape::ball, {2, 2, 2}, 0.8};
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

Clay symmetric_ball() { return Clay::ball(9.0, ClayOptions{.voxel_mm = 0.2}).value(); }

/// Not to the bit: leaves of 8 nodes are not mirrored onto leaves by a plane through a node, so
/// what is stored, filled in and solved differs by a row of nodes, within the clay's tolerance a
/// level.
TEST(Symmetry, MirroredAndTurnedSurfacesAgreeWithinTheToleranceOfTheirLevels) {
  const auto across_x = [](const Vec3& p) { return Vec3{-p.x, p.y, p.z}; };
  const auto quarter = [](const Vec3& p) { return Vec3{-p.y, p.x, p.z}; };
  for (int n = 0; n <= static_cast<int>(Action::twist); ++n) {
    Stroke stroke = wandering(static_cast<Action>(n));
    stroke.mirror = {true, false, false};
    Clay mirrored = Clay::ball(9.0, ClayOptions{.voxel_mm = 0.2}).value();
    ASSERT_TRUE(mirrored.apply(stroke).ok());
    stroke.mirror = {};
    stroke.radial = {4, 2};
    Clay turned = Clay::ball(9.0, ClayOptions{.voxel_mm = 0.2}).value();
    ASSERT_TRUE(turned.apply(stroke).ok());
    const double by_mirror = asymmetry(mirrored, across_x) / 0.2;
    const double by_turn = asymmetry(turned, quarter) / 0.2;
    std::printf("action %d: %.3f and %.3f voxels\n", n, by_mirror, by_turn);
    EXPECT_LT(by_mirror, 0.75) << n;
    EXPECT_LT(by_turn, 0.75) << n;
  }
}

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
