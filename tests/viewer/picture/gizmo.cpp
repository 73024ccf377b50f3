// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/gizmo.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "picture/piece_frame.h"

namespace argil::viewer {
namespace {

using Kind = GizmoPart::Kind;

class GizmoTest : public testing::Test {
 protected:
  GizmoTest() {
    camera_.resize(800, 600);
    camera_.look_from(normalized(Vec3{0.5, -1.0, 0.6}), {0.0, 0.0, 1.0});
    camera_.frame({{-30.0, -30.0, -30.0}, {30.0, 30.0, 30.0}});
    gizmo_ = gizmo_at(place_.position_mm, camera_);
  }
  Camera::Pixel pixel_at(const Vec3& of_length) const {
    return camera_.pixel_of(gizmo_.center_mm + gizmo_.length_mm * of_length);
  }
  std::optional<GizmoPart> under(const Vec3& of_length) const {
    return part_under(gizmo_, camera_, pixel_at(of_length));
  }

  const Placement place_{{4.0, -3.0, 6.0}, normalized(Quat{0.8, 0.1, -0.5, 0.3})};
  Camera camera_;
  Gizmo gizmo_;
};

TEST_F(GizmoTest, EachHandleIsFoundWhereItIsDrawnAndNothingBesideThem) {
  const Vec3 axes[]{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec3& u = axes[(axis + 1) % 3];
    const Vec3& v = axes[(axis + 2) % 3];
    EXPECT_EQ(under(1.2 * axes[axis]), (GizmoPart{Kind::along, axis}));
    EXPECT_EQ(under(0.4 * (u + v)), (GizmoPart{Kind::across, axis}));
    // The nearer half of a ring is turned to the eye.
    const Vec3 toward = camera_.lens({}).back;
    const Vec3 near = normalized(toward - dot(toward, axes[axis]) * axes[axis]);
    const Vec3 beside = normalized(near + 0.3 * cross(axes[axis], near));
    EXPECT_EQ(under(0.85 * beside), (GizmoPart{Kind::around, axis}));
    EXPECT_FALSE(under(-1.2 * axes[axis])) << axis;
  }
  EXPECT_FALSE(under({}));
}

TEST_F(GizmoTest, WhatIsHeldStaysUnderThePointer) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 along;
    along[axis] = 1.2;
    GizmoDrag drag(gizmo_, {Kind::along, axis}, camera_, pixel_at(along), place_);
    along[axis] = 2.0;
    const Placement there = drag.to(pixel_at(along), false);
    Vec3 by = place_.position_mm;
    by[axis] += 0.8 * gizmo_.length_mm;
    EXPECT_LT(length(there.position_mm - by), 1e-6);
    EXPECT_EQ(there.orientation, place_.orientation);
  }
  GizmoDrag across(gizmo_, {Kind::across, 2}, camera_, pixel_at({0.4, 0.4, 0.0}), place_);
  const Vec3 by = gizmo_.length_mm * Vec3{0.9, -0.5, 0.0};
  EXPECT_LT(
      length(across.to(pixel_at({1.3, -0.1, 0.0}), false).position_mm - (place_.position_mm + by)),
      1e-6);
}

TEST_F(GizmoTest, ARingTurnsByTheAngleOfThePointerAlsoBeyondAWholeTurn) {
  const auto at = [&](double degrees) {
    const double turn = degrees * std::acos(-1.0) / 180.0;
    return pixel_at(0.85 * Vec3{std::cos(turn), std::sin(turn), 0.0});
  };
  GizmoDrag drag(gizmo_, {Kind::around, 2}, camera_, at(-60.0), place_);
  Placement there;
  for (double degrees = -60.0; degrees <= 350.0; degrees += 10.0)
    there = drag.to(at(degrees), false);
  const Placement wanted = turned_about(place_, gizmo_.center_mm, {0.0, 0.0, 1.0}, 410.0);
  const Vec3 tip{10.0, 20.0, 30.0};
  EXPECT_LT(length(placed(there, tip) - placed(wanted, tip)), 1e-6);
  EXPECT_LT(length(placed(there, unplaced(place_, gizmo_.center_mm)) - gizmo_.center_mm), 1e-9);
}

/// Around all handles, facing the eye: whatever the camera, what is held stays under the pointer.
TEST_F(GizmoTest, TheOuterRingScalesAboutTheMiddle) {
  const Lens lens = camera_.lens({});
  const Vec3 toward = normalized(lens.eye_mm - gizmo_.center_mm);
  const Vec3 right = normalized(cross(lens.up, toward));
  const GizmoPart ring{Kind::size, 0};
  EXPECT_EQ(under(1.5 * right), ring);
  EXPECT_EQ(under(-1.5 * right), ring);
  EXPECT_EQ(under(1.7 * right), std::nullopt);
  GizmoDrag drag(gizmo_, ring, camera_, pixel_at(1.5 * right), place_);
  const Placement there = drag.to(pixel_at(2.25 * right), false);
  EXPECT_NEAR(drag.factor(), 1.5, 0.01);
  const Placement wanted = scaled_about(place_, gizmo_.center_mm, drag.factor());
  EXPECT_TRUE(are_same(there, wanted));
  drag.to(pixel_at(2.2 * right), true);
  EXPECT_NEAR(drag.factor(), 1.45, 1e-9) << "in steps of 5 %";
  drag.to(pixel_at({}), false);
  EXPECT_EQ(drag.factor(), 0.01) << "never to nothing";
  // Whatever is dragged else scales nothing.
  GizmoDrag along(gizmo_, {Kind::along, 0}, camera_, pixel_at({1.2, 0.0, 0.0}), place_);
  along.to(pixel_at({2.0, 0.0, 0.0}), false);
  EXPECT_EQ(along.factor(), 1.0);
}

TEST_F(GizmoTest, ASnapIsToMillimetresAndTo15Degrees) {
  GizmoDrag along(gizmo_, {Kind::along, 0}, camera_, pixel_at({1.2, 0.0, 0.0}), place_);
  const double x = along.to(pixel_at({1.77, 0.0, 0.0}), true).position_mm.x - place_.position_mm.x;
  EXPECT_EQ(x, std::round(x));
  EXPECT_GT(x, 0.0);
  const auto at = [&](double turn) {
    return pixel_at(0.85 * Vec3{std::cos(turn), std::sin(turn), 0.0});
  };
  GizmoDrag around(gizmo_, {Kind::around, 2}, camera_, at(-1.0), {});
  const Placement quarter = around.to(at(-1.0 + 1.53), true);
  EXPECT_LT(length(turned(quarter, {1.0, 0.0, 0.0}) - Vec3{0.0, 1.0, 0.0}), 1e-12);
}

TEST(PieceFrame, TurnsThatWereTypedComeBack) {
  for (const Vec3& turns :
       {Vec3{}, Vec3{10.0, -20.0, 30.0}, Vec3{-170.0, 80.0, 179.0}, Vec3{90.0, 0.0, -90.0},
        Vec3{35.0, 90.0, 0.0}, Vec3{-20.0, -90.0, 0.0}}) {
    EXPECT_LT(length(turns_of(orientation_of(turns)) - turns), 1e-6) << turns.x << ' ' << turns.y;
  }
  EXPECT_FALSE(std::signbit(turns_of({}).y)) << "shown as -0.00";
  // First about x, then about y: what points up then lies to the right.
  const Placement turned_twice{{}, orientation_of({90.0, 90.0, 0.0})};
  EXPECT_LT(length(turned(turned_twice, {0.0, 1.0, 0.0}) - Vec3{1.0, 0.0, 0.0}), 1e-12);
}

TEST(PieceFrame, AShrunkLensSeesTheSmallWorldAsItSawTheLarge) {
  for (const bool is_parallel : {false, true}) {
    Camera camera;
    camera.set_parallel(is_parallel);
    camera.look_from(normalized(Vec3{0.3, -1.0, 0.5}), {0.0, 0.0, 1.0});
    Box3 content;
    content.include({-30.0, -30.0, -30.0});
    content.include({30.0, 30.0, 30.0});
    const Lens lens = camera.lens(content);
    const Lens small = shrunk(lens, 2.5);
    const Vec3 p{7.0, -3.0, 11.0};
    const auto clip = [](const Lens& of, const Vec3& at) {
      const Vec3 to = at - of.eye_mm;
      const double away = -dot(to, of.back);
      const double over = of.is_parallel ? 1.0 : away;
      return Vec3{dot(to, of.right) / (over * of.tan_x), dot(to, of.up) / (over * of.tan_y),
                  (away - of.near_mm) / (of.far_mm - of.near_mm)};
    };
    EXPECT_LT(length(clip(small, p / 2.5) - clip(lens, p)), 1e-12);
  }
}

TEST(PieceFrame, ALensSeesInThePieceWhatItSawInTheSculpture) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-30.0, 30.0);
  Camera camera;
  camera.look_from(normalized(Vec3{0.5, -1.0, 0.6}), {0.0, 0.0, 1.0});
  const Lens lens = camera.lens({});
  const Placement placement{{3.0, -8.0, 2.0}, normalized(Quat{0.3, -0.4, 0.6, 0.2})};
  const Lens own = unplaced(placement, lens);
  for (int n = 0; n < 50; ++n) {
    const Vec3 p{any(random), any(random), any(random)};
    const Vec3 q = placed(placement, p);
    EXPECT_NEAR(dot(p - own.eye_mm, own.right), dot(q - lens.eye_mm, lens.right), 1e-9);
    EXPECT_NEAR(dot(p - own.eye_mm, own.up), dot(q - lens.eye_mm, lens.up), 1e-9);
    EXPECT_NEAR(dot(p - own.eye_mm, own.back), dot(q - lens.eye_mm, lens.back), 1e-9);
    const Camera::Pixel pixel = camera.pixel_of(q);
    const Ray ray = camera.ray_at(pixel);
    EXPECT_LT(length(cross(ray.direction, q - ray.origin_mm)), 1e-6);
  }
}

}  // namespace
}  // namespace argil::viewer
