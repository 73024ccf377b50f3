// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/measure_pick.h"

#include <cmath>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "picture/piece_frame.h"
#include "viewer/document/document_fixture.h"

namespace argil::viewer {
namespace {

constexpr double kPickVoxelMm = 0.25;

ClayOptions quarter_options() {
  ClayOptions options;
  options.voxel_mm = kPickVoxelMm;
  return options;
}

Sculpture ball_of_10() { return Sculpture(Clay::ball(10.0, quarter_options()).value(), {"Ball"}); }

void add(Sculpture& sculpture, Clay clay, const char* name, const Placement& at) {
  AddPiece add;
  add.look.name = name;
  add.look.placement = at;
  add.clay = std::make_shared<const Clay>(std::move(clay));
  ASSERT_TRUE(sculpture.apply(add).ok());
}

/// Where a ray meets a ball about the origin; NaN beside it.
Vec3 on_a_ball(const Ray& ray, double radius) {
  const Vec3 d = normalized(ray.direction);
  const double b = dot(ray.origin_mm, d);
  const double c = dot(ray.origin_mm, ray.origin_mm) - radius * radius;
  return ray.origin_mm + (-b - std::sqrt(b * b - c)) * d;
}

TEST(MeasurePick, PolesOfABallOf10AreTwentyApart) {
  const Sculpture ball = ball_of_10();
  for (const Vec3& axis :
       {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 0.0, 1.0}, normalized(Vec3{0.3, -0.8, 0.52})}) {
    const auto one = measure_pick(ball, {200.0 * axis, -3.0 * axis}, {});
    const auto other = measure_pick(ball, {-200.0 * axis, axis}, {});
    ASSERT_TRUE(one && other);
    // On the axes lie nodes; between them the field of a ball is up to a fiftieth of a voxel off.
    const double bound = (axis.z == 1.0 || axis.x == 1.0 ? 0.001 : 0.02) * kPickVoxelMm;
    EXPECT_NEAR(length(one->own_mm - other->own_mm), 20.0, bound);
    EXPECT_NEAR(one->distance_mm, 190.0, bound) << "whatever the direction's length";
    EXPECT_GT(dot(one->own_normal, axis), 0.999);
    EXPECT_FALSE(one->is_on_slice);
  }
  EXPECT_FALSE(measure_pick(ball, {{0.0, 11.0, 50.0}, {0.0, 0.0, -1.0}}, {}));
  EXPECT_FALSE(measure_pick(ball, {{0.0, 0.0, 50.0}, {0.0, 0.0, 0.0}}, {}));
}

TEST(MeasurePick, ThicknessOfABallIsItsDiameterAndOfABoxItsSide) {
  const Clay ball = Clay::ball(10.0, quarter_options()).value();
  for (const Vec3& out : {Vec3{0.0, 0.0, 1.0}, normalized(Vec3{0.3, -0.8, 0.52})}) {
    const auto across = far_side(ball, 10.0 * out, out);
    ASSERT_TRUE(across);
    EXPECT_LT(length(*across + 10.0 * out), 0.01 * kPickVoxelMm);
  }
  const Clay box = Clay::block({24.0, 20.0, 3.0}, quarter_options()).value();
  const Sculpture boxes(Clay::block({24.0, 20.0, 3.0}, quarter_options()).value(), {"Box"});
  for (const double x : {-7.3, 0.0, 5.11}) {
    const auto top = measure_pick(boxes, {{x, 2.2, 90.0}, {0.0, 0.0, -1.0}}, {});
    ASSERT_TRUE(top);
    const auto across = far_side(box, top->own_mm, top->own_normal);
    ASSERT_TRUE(across);
    EXPECT_NEAR(length(*across - top->own_mm), 3.0, 0.01 * kPickVoxelMm);
  }
  EXPECT_FALSE(far_side(box, {0.0, 0.0, 1.5}, {0.0, 0.0, -1.0})) << "no material there";
}

/// Behind the wall lies air, then clay again: the wall alone is thick.
TEST(MeasurePick, ThicknessEndsAtTheFirstAir) {
  Clay ball = Clay::ball(10.0, quarter_options()).value();
  ASSERT_TRUE(ball.apply(Hollow{2.0, {}}).ok());
  const Vec3 out = normalized(Vec3{0.3, -0.8, 0.52});
  const auto across = far_side(ball, 10.0 * out, out);
  ASSERT_TRUE(across);
  EXPECT_NEAR(length(*across - 10.0 * out), 2.0, 0.1 * kPickVoxelMm);
}

TEST(MeasurePick, TheNearestVisiblePieceIsMetWhereItStands) {
  Sculpture sculpture = ball_of_10();
  const Placement at{{0.0, 0.0, 30.0}, normalized(Quat{1.0, 0.0, 1.0, 0.0})};
  add(sculpture, Clay::block({4.0, 6.0, 8.0}, quarter_options()).value(), "Box", at);
  const Ray down{{0.5, 0.5, 200.0}, {0.0, 0.0, -1.0}};
  const auto box = measure_pick(sculpture, down, {});
  ASSERT_TRUE(box);
  EXPECT_EQ(box->piece, 1U);
  // A quarter turn about y: its x, 4 mm long, stands upright.
  EXPECT_LT(length(placed(at, box->own_mm) - Vec3{0.5, 0.5, 32.0}), 0.01 * kPickVoxelMm);
  EXPECT_GT(turned(at, box->own_normal).z, 0.999);
  ChangePiece hide{"Box"};
  hide.is_visible = false;
  ASSERT_TRUE(sculpture.apply(hide).ok());
  const auto ball = measure_pick(sculpture, down, {});
  ASSERT_TRUE(ball);
  EXPECT_EQ(ball->piece, 0U);
  EXPECT_LT(length(ball->own_mm - on_a_ball(down, 10.0)), 0.01 * kPickVoxelMm);
}

TEST(MeasurePick, ASliceIsMetInItsMaterialAndTheHalfBeforeItIsNot) {
  const Sculpture ball = ball_of_10();
  // The half towards the eye, y < 2, is cut away.
  const SeenHalf seen{{0.0, 1.0, 0.0}, 2.0};
  const Vec3 aim = normalized(Vec3{0.02, 1.0, 0.01});
  const Ray into{{0.0, -100.0, 0.0}, aim};
  const auto cut = measure_pick(ball, into, seen);
  ASSERT_TRUE(cut);
  EXPECT_TRUE(cut->is_on_slice);
  EXPECT_NEAR(cut->own_mm.y, 2.0, 1e-9);
  EXPECT_NEAR(cut->distance_mm, 102.0 / aim.y, 1e-9);
  EXPECT_LT(cut->own_normal.y, -0.999) << "towards the eye";
  // From behind the slice lies before nothing: the surface is met.
  const auto back = measure_pick(ball, {{0.0, 100.0, 0.0}, {0.0, -1.0, 0.0}}, seen);
  ASSERT_TRUE(back);
  EXPECT_FALSE(back->is_on_slice);
  EXPECT_NEAR(back->own_mm.y, 10.0, 0.01 * kPickVoxelMm);
  // What only the part that is gone would have stopped goes by; so does what looks away.
  EXPECT_FALSE(measure_pick(ball, {{-50.0, 1.0, 0.0}, {1.0, 0.0, 0.0}}, seen));
  EXPECT_FALSE(measure_pick(ball, {{9.0, 60.0, 0.0}, normalized(Vec3{0.0, -1.0, 0.0})},
                            SeenHalf{{0.0, 1.0, 0.0}, 5.0}));
}

TEST_F(DocumentThreadTest, MeasuresWhatWasSentBeforeAndTheNewestQuestionOfEachNumber) {
  thread_.send(NewClay{ball(25.0)});
  thread_.send(NewClay{ball(10.0)});
  const Ray beside{{0.0, 90.0, 100.0}, {0.0, 0.0, -1.0}};
  const Ray down{{0.0, 0.0, 100.0}, {0.0, 0.0, -1.0}};
  thread_.measure({7, beside, {}, false});
  thread_.measure({7, down, {}, true});
  thread_.measure({8, beside, {}, true});
  std::vector<MeasureAnswer> told;
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::vector<double> inputs;
    thread_.take_blocks(inputs);
    for (const MeasureAnswer& answer : thread_.take_measured()) told.push_back(answer);
  } while (!thread_.is_idle());
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].number, 7);
  ASSERT_TRUE(told[0].point && told[0].across);
  EXPECT_NEAR(told[0].point->own_mm.z, 10.0, 0.01) << "not the ball before";
  EXPECT_NEAR(told[0].across->own_mm.z, -10.0, 0.01);
  EXPECT_EQ(told[0].point->piece, active_key(thread_.state()));
  EXPECT_EQ(told[1].number, 8);
  EXPECT_FALSE(told[1].point);
}

}  // namespace
}  // namespace argil::viewer
