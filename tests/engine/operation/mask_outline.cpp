// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/mask_outline.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/clay.h"

namespace argil {
namespace {

using testing::HasSubstr;

constexpr double kBallMm = 10.0;
constexpr double kVoxelMm = 0.2;
// The mask rises over one of its nodes' spacing and is interpolated between them.
constexpr double kBorderMm = 2.0 * 2.0 * kVoxelMm;

Clay masked_ball() { return Clay::ball(kBallMm, ClayOptions{.voxel_mm = kVoxelMm}).value(); }

/// From the front: x to the right, z up, the eye at y = -distance.
ViewFrame from_the_front(double distance_mm, bool is_parallel) {
  const double half = std::sqrt(0.5);
  return {{0.0, -distance_mm, 0.0}, {half, half, 0.0, 0.0}, is_parallel};
}

/// Points all over the ball's surface.
std::vector<Vec3> ball_points(int count) {
  std::vector<Vec3> points;
  for (int n = 0; n < count; ++n) {
    const double z = 1.0 - (2.0 * n + 1.0) / count;
    const double turn = 2.399963229728653 * n;
    const double r = std::sqrt(1.0 - z * z);
    points.push_back(kBallMm * Vec3{r * std::cos(turn), r * std::sin(turn), z});
  }
  return points;
}

/// An L, whose inner corner no convex outline has, and how deep a point lies within it.
std::vector<PicturePoint> letter(double unit) {
  return {{-5 * unit, -6 * unit}, {4 * unit, -6 * unit}, {4 * unit, -2 * unit},
          {-1 * unit, -2 * unit}, {-1 * unit, 5 * unit}, {-5 * unit, 5 * unit}};
}
double outside_box(double x, double y, double x0, double x1, double y0, double y1) {
  const double dx = std::max(x0 - x, x - x1);
  const double dy = std::max(y0 - y, y - y1);
  return std::max(dx, dy);
}
/// At least so far outside, or below 0 within; exact in sign.
double outside_letter(double x, double y) {
  return std::min(outside_box(x, y, -5, 4, -6, -2), outside_box(x, y, -5, -1, -6, 5));
}

TEST(MaskOutlines, HoldWhatAParallelViewShowsWithinThemThroughTheClay) {
  Clay clay = masked_ball();
  ASSERT_TRUE(mask_within(clay, {from_the_front(30.0, true), {letter(1.0)}}).ok());
  int held = 0;
  for (const Vec3& p : ball_points(4000)) {
    const double outside = outside_letter(p.x, p.z);
    if (outside < -kBorderMm) {
      EXPECT_EQ(clay.mask_at(p), 1.0) << p.x << " " << p.y << " " << p.z;
      ++held;
    }
    if (outside > kBorderMm) {
      EXPECT_EQ(clay.mask_at(p), 0.0);
    }
  }
  EXPECT_GT(held, 150);
  // The border is where it was drawn: half way up there, between nodes too.
  for (double z = 0.0; z < 4.0; z += 0.13) {
    const double x = -1.0;
    const Vec3 front{x, -std::sqrt(kBallMm * kBallMm - x * x - z * z), z};
    EXPECT_NEAR(clay.mask_at(front), 0.5, 0.02) << z;
  }
  // Deep within as well: what is carved later meets it.
  EXPECT_EQ(clay.mask_at({-3.0, 0.0, 0.0}), 1.0);
  EXPECT_EQ(clay.mask_at({6.0, 0.0, 0.0}), 0.0);
}

TEST(MaskOutlines, HoldWhatAPerspectiveShowsWithinThem) {
  constexpr double kEyeMm = 25.0;
  Clay clay = masked_ball();
  ASSERT_TRUE(mask_within(clay, {from_the_front(kEyeMm, false), {letter(1.0 / kEyeMm)}}).ok());
  int front = 0;
  int back = 0;
  for (const Vec3& p : ball_points(4000)) {
    // Where the line of sight meets the plane y = 0.
    const double depth = p.y + kEyeMm;
    const double outside = outside_letter(p.x * kEyeMm / depth, p.z * kEyeMm / depth);
    const double mm = outside * depth / kEyeMm;
    if (mm < -kBorderMm) {
      EXPECT_EQ(clay.mask_at(p), 1.0) << p.x << " " << p.y << " " << p.z;
      ++(p.y < 0.0 ? front : back);
    }
    if (mm > kBorderMm) {
      EXPECT_EQ(clay.mask_at(p), 0.0);
    }
  }
  EXPECT_GT(front, 10);
  EXPECT_GT(back, front);
}

/// The first point of the ball that the eye sees at a place of a picture from the front.
Vec3 seen_at(double eye_mm, double x, double z) {
  const Vec3 eye{0.0, -eye_mm, 0.0};
  const Vec3 along = normalized(Vec3{x, 1.0, z});
  const double near = dot(along, eye);
  return eye + (-near - std::sqrt(near * near - dot(eye, eye) + kBallMm * kBallMm)) * along;
}

TEST(MaskOutlines, AreHalfWayUpWhereABorderPassesAcrossTheNodes) {
  Clay parallel = masked_ball();
  const ViewFrame front = from_the_front(30.0, true);
  ASSERT_TRUE(mask_within(parallel, {front, {{{-20, 20}, {20, -20}, {-20, -20}}}}).ok());
  const auto on_diagonal = [&](double t, double beside) {
    const double x = t + std::sqrt(0.5) * beside;
    const double z = -t + std::sqrt(0.5) * beside;
    return parallel.mask_at({x, -std::sqrt(kBallMm * kBallMm - x * x - z * z), z});
  };
  constexpr double kFiveVoxelsMm = 5.0 * kVoxelMm;
  for (double t = -5.0; t < 5.0; t += 0.07) {
    EXPECT_NEAR(on_diagonal(t, 0.0), 0.5, 0.06) << t;
    EXPECT_EQ(on_diagonal(t, -kFiveVoxelsMm), 1.0) << t;
    EXPECT_EQ(on_diagonal(t, kFiveVoxelsMm), 0.0) << t;
  }
  constexpr double kEyeMm = 25.0;
  Clay perspective = masked_ball();
  ASSERT_TRUE(mask_within(perspective, {from_the_front(kEyeMm, false),
                                        {{{-1.0, -1.0}, {-0.1, -1.0}, {0.3, 1.0}, {-1.0, 1.0}}}})
                  .ok());
  for (double z = -0.3; z < 0.3; z += 0.004) {
    const double x = 0.1 + 0.2 * z;
    EXPECT_NEAR(perspective.mask_at(seen_at(kEyeMm, x, z)), 0.5, 0.06) << z;
  }
}

/// What a place of the picture, a mask's node there seen as `mm_per_unit`, gets by the definition:
/// parity of crossings and the distance to the nearest edge, of all of them.
double covered_by_definition(const std::vector<std::vector<PicturePoint>>& loops, double x,
                             double y, double mm_per_unit) {
  double depth = -1e9;
  for (const auto& loop : loops) {
    bool is_inside = false;
    double nearest = 1e9;
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const PicturePoint& a = loop[n];
      const PicturePoint& b = loop[(n + 1) % loop.size()];
      const Vec3 side{b[0] - a[0], b[1] - a[1], 0.0};
      const Vec3 from{x - a[0], y - a[1], 0.0};
      const double t = std::clamp(dot(from, side) / dot(side, side), 0.0, 1.0);
      nearest = std::min(nearest, length(from - t * side));
      if ((a[1] > y) != (b[1] > y) && a[0] + (y - a[1]) / side.y * side.x > x) {
        is_inside = !is_inside;
      }
    }
    depth = std::max(depth, is_inside ? nearest : -nearest);
  }
  return std::clamp(0.5 + mm_per_unit * depth / (2.0 * kVoxelMm), 0.0, 1.0);
}

/// Stars whose points go back and forth across whatever box a block has in the picture.
std::vector<std::vector<PicturePoint>> stars(double unit) {
  std::vector<std::vector<PicturePoint>> loops;
  for (const PicturePoint& middle : {PicturePoint{-2.0, 1.0}, {3.0, -2.0}, {4.0, 4.0}}) {
    auto& loop = loops.emplace_back();
    for (int n = 0; n < 400; ++n) {
      const double turn = 2.0 * std::numbers::pi * n / 400.0;
      const double r = n % 2 == 0 ? 5.5 : 1.0 + 0.01 * (n % 37);
      loop.push_back(
          {unit * (middle[0] + r * std::cos(turn)), unit * (middle[1] + r * std::sin(turn))});
    }
  }
  return loops;
}

/// Counts the nodes near the surface that were compared.
int expect_as_defined(const MaskOutline& outline, double eye_mm) {
  Clay clay = masked_ball();
  EXPECT_TRUE(mask_within(clay, outline).ok());
  constexpr double kNodeMm = 2.0 * kVoxelMm;
  int compared = 0;
  for (int i = -25; i <= 25; ++i) {
    for (int j = -25; j <= 25; ++j) {
      for (int k = -25; k <= 25; ++k) {
        const Vec3 p =
            kNodeMm * Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        if (std::abs(length(p) - kBallMm) > 5.0 * kVoxelMm) continue;
        const double depth = outline.view.is_parallel ? 1.0 : p.y + eye_mm;
        const double expected =
            depth > 0.0 ? covered_by_definition(outline.loops, p.x / depth, p.z / depth, depth)
                        : 0.0;
        EXPECT_NEAR(clay.mask_at(p), expected, 2e-6) << p.x << " " << p.y << " " << p.z;
        ++compared;
      }
    }
  }
  return compared;
}

TEST(MaskOutlines, AreAsDefinedAtEveryNodeHoweverManyEdgesCrossAround) {
  EXPECT_GT(expect_as_defined({from_the_front(30.0, true), stars(1.0)}, 0.0), 5000);
  EXPECT_GT(expect_as_defined({from_the_front(25.0, false), stars(0.04)}, 25.0), 5000);
  // From within the clay; the second time nodes lie in the plane of the eye, seen at no place.
  EXPECT_GT(expect_as_defined({from_the_front(3.0, false), stars(0.2)}, 3.0), 5000);
  EXPECT_GT(expect_as_defined({from_the_front(2.0, false), stars(0.2)}, 2.0), 5000);
}

TEST(MaskOutlines, TakeAnOrientationOfAnyLength) {
  std::vector<std::uint64_t> hashes;
  for (const double length : {1.0, 1e-160, 1e-300, 1e160}) {
    Clay clay = masked_ball();
    MaskOutline outline{from_the_front(30.0, true), {letter(1.0)}};
    outline.view.orientation = {length, length, 0.0, 0.0};
    ASSERT_TRUE(mask_within(clay, outline).ok()) << length;
    hashes.push_back(clay.hash());
  }
  EXPECT_THAT(hashes, testing::Each(hashes[0]));
}

TEST(MaskOutlines, TakeOnlyWhatLooksAtTheEyeWhereThatIsWanted) {
  Clay clay = masked_ball();
  MaskOutline outline{from_the_front(40.0, false), {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}};
  outline.front_only = true;
  ASSERT_TRUE(mask_within(clay, outline).ok());
  int held = 0;
  for (const Vec3& p : ball_points(2000)) {
    const double cosine = dot(normalized(p), normalized(outline.view.eye_mm - p));
    if (cosine > 0.18) {
      EXPECT_EQ(clay.mask_at(p), 1.0) << cosine;
      ++held;
    }
    if (cosine < -0.1) {
      EXPECT_EQ(clay.mask_at(p), 0.0) << cosine;
    }
  }
  EXPECT_GT(held, 400);
}

TEST(MaskOutlines, FreeWhatTheyWouldHold) {
  Clay held = masked_ball();
  Clay freed = masked_ball();
  MaskOutline outline{from_the_front(30.0, true), {letter(1.0)}};
  ASSERT_TRUE(mask_within(held, outline).ok());
  ASSERT_TRUE(freed.apply(MaskEdit::fill).ok());
  outline.frees = true;
  ASSERT_TRUE(mask_within(freed, outline).ok());
  for (const Vec3& p : ball_points(2000)) {
    EXPECT_NEAR(freed.mask_at(p), 1.0 - held.mask_at(p), 1e-5);
  }
  ASSERT_TRUE(mask_within(held, outline).ok());
  // On the border itself half is left of either.
  for (const Vec3& p : ball_points(2000)) EXPECT_LE(held.mask_at(p), 0.5);
}

TEST(MaskOutlines, AddToWhatIsHeldAndAreTakenBackAtOnce) {
  Clay clay = masked_ball();
  const auto empty = clay.hash();
  const ViewFrame view = from_the_front(30.0, true);
  ASSERT_TRUE(mask_within(clay, {view, {{{-6, -2}, {-2, -2}, {-2, 2}, {-6, 2}}}}).ok());
  const auto one = clay.hash();
  // Two loops that overlap hold their union.
  ASSERT_TRUE(
      mask_within(clay,
                  {view, {{{0, -2}, {4, -2}, {4, 2}, {0, 2}}, {{3, -1}, {7, -1}, {7, 1}, {3, 1}}}})
          .ok());
  for (const double x : {-4.0, 2.0, 3.5, 6.0}) {
    EXPECT_EQ(clay.mask_at({x, -std::sqrt(kBallMm * kBallMm - x * x), 0.0}), 1.0) << x;
  }
  ASSERT_TRUE(clay.undo());
  EXPECT_EQ(clay.hash(), one);
  ASSERT_TRUE(clay.undo());
  EXPECT_EQ(clay.hash(), empty);
  ASSERT_TRUE(clay.redo());
  EXPECT_EQ(clay.hash(), one);
}

TEST(MaskOutlineGolden, SameBitsForAnyThreadCount) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    Clay clay = masked_ball();
    MaskOutline outline{from_the_front(25.0, false), {letter(0.05)}};
    outline.front_only = true;
    ASSERT_TRUE(mask_within(clay, outline).ok());
    hashes.push_back(clay.hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(MaskOutlines, AreRefusedByNameAndStopWhenToldTo) {
  Clay clay = masked_ball();
  const auto before = clay.hash();
  const ViewFrame view = from_the_front(30.0, true);
  const auto said = [&](const MaskOutline& outline) {
    const auto done = mask_within(clay, outline);
    return done ? std::string() : done.error().message;
  };
  EXPECT_THAT(said({view, {}}), HasSubstr("no loop"));
  EXPECT_THAT(said({view, {{{0, 0}, {1, 1}}}}), HasSubstr("loop 1 of the outline has 2 points"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(said({view, {letter(1.0), {{0, 0}, {nan, 1}, {1, 0}}}}), HasSubstr("loop 2"));
  EXPECT_THAT(said({{{2e6, 0, 0}, {}, true}, {letter(1.0)}}), HasSubstr("eye_mm"));
  EXPECT_THAT(said({{{}, {0, 0, 0, 0}, true}, {letter(1.0)}}), HasSubstr("orientation"));
  const auto stopped =
      mask_within(clay, {view, {letter(1.0)}}, [](std::string_view, double) { return false; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted);
  ASSERT_TRUE(clay.begin_stroke({}, {}).ok());
  EXPECT_THAT(said({view, {letter(1.0)}}), HasSubstr("stroke is open"));
  clay.cancel_stroke();
  EXPECT_EQ(clay.hash(), before);
  EXPECT_EQ(clay.undo_depth(), 0);
}

/// From within the clay: what is behind the eye is not seen.
TEST(MaskOutlines, DoNotReachBehindTheEye) {
  Clay clay = masked_ball();
  ASSERT_TRUE(mask_within(clay, {from_the_front(0.0, false),
                                 {{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}}})
                  .ok());
  EXPECT_EQ(clay.mask_at({0.0, kBallMm, 0.0}), 1.0);
  EXPECT_EQ(clay.mask_at({0.0, -kBallMm, 0.0}), 0.0);
  EXPECT_EQ(clay.mask_at({kBallMm, 0.0, 0.0}), 0.0);
}

}  // namespace
}  // namespace argil
