// SPDX-License-Identifier: GPL-3.0-or-later
// Masks that follow the surface: borders moved along it, and masks by its curvature.
#include "argil/engine/mask_filter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/clay.h"
#include "argil/engine/mask_outline.h"

#include "support/stroke_maker.h"

namespace argil {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kFilterVoxelMm = 0.2;
constexpr double kFilterBallMm = 10.0;

Clay filter_ball(double voxel_mm = kFilterVoxelMm) {
  return Clay::ball(kFilterBallMm, ClayOptions{.voxel_mm = voxel_mm}).value();
}

/// From above: x to the right, y up in the picture.
ViewFrame from_above(double height_mm) { return {{0.0, 0.0, height_mm}, {}, true}; }

std::vector<PicturePoint> disk(double radius_mm, double x_mm = 0.0) {
  std::vector<PicturePoint> points;
  for (int n = 0; n < 200; ++n) {
    const double turn = 2.0 * pi * n / 200.0;
    points.push_back({x_mm + radius_mm * std::cos(turn), radius_mm * std::sin(turn)});
  }
  return points;
}

/// A cap about the top.
void mask_cap(Clay& clay, double radius_mm) {
  ASSERT_TRUE(mask_within(clay, {from_above(30.0), {disk(radius_mm)}, false, true}).ok());
}

/// Where the mask is a half on a line between two parameters, the former of which is held.
template <class At>
double border_between(const Clay& clay, double held, double free, const At& at) {
  EXPECT_GE(clay.mask_at(at(held)), 0.5);
  EXPECT_LT(clay.mask_at(at(free)), 0.5);
  for (int n = 0; n < 40; ++n) {
    const double middle = 0.5 * (held + free);
    (clay.mask_at(at(middle)) >= 0.5 ? held : free) = middle;
  }
  return held;
}

/// How far along the ball from its top the border is, in a direction.
double cap_mm(const Clay& clay, double turn) {
  const auto at = [&](double angle) {
    return kFilterBallMm * Vec3{std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn),
                                std::cos(angle)};
  };
  return kFilterBallMm * border_between(clay, 0.0, 3.0, at);
}

/// The most by which the border of a cap lies elsewhere than it should after a step.
double worst_of_cap(Clay& clay, double by_mm) {
  std::vector<double> before;
  for (int n = 0; n < 24; ++n) before.push_back(cap_mm(clay, 0.1 + n * pi / 12.0));
  EXPECT_TRUE(filter_mask(clay, MaskGrow{by_mm}).ok());
  double worst = 0.0;
  for (int n = 0; n < 24; ++n) {
    const double moved = cap_mm(clay, 0.1 + n * pi / 12.0) - before[static_cast<std::size_t>(n)];
    worst = std::max(worst, std::abs(moved - by_mm));
  }
  return worst;
}

TEST(MaskGrows, MovesTheBorderOfACapAlongTheBall) {
  for (const double by_mm : {0.3, 1.5, 4.0, 12.0}) {
    Clay clay = filter_ball();
    mask_cap(clay, 5.0);
    const double worst = worst_of_cap(clay, by_mm);
    std::printf("cap grown by %.1f mm: off by %.3f voxels\n", by_mm, worst / kFilterVoxelMm);
    EXPECT_LE(worst, (by_mm < kFilterBallMm ? 0.35 : 0.6) * kFilterVoxelMm) << by_mm;
  }
  for (const double by_mm : {-0.3, -1.5, -4.0}) {
    Clay clay = filter_ball();
    mask_cap(clay, 7.0);
    const double worst = worst_of_cap(clay, by_mm);
    std::printf("cap shrunk by %.1f mm: off by %.3f voxels\n", -by_mm, worst / kFilterVoxelMm);
    EXPECT_LE(worst, 0.35 * kFilterVoxelMm) << by_mm;
  }
}

TEST(MaskGrows, MovesABorderAcrossAPlaneInAnyDirection) {
  Clay clay = Clay::block({40.0, 40.0, 12.0}, ClayOptions{.voxel_mm = kFilterVoxelMm}).value();
  mask_cap(clay, 6.0);
  const auto reach = [&](double turn) {
    const auto at = [&](double r) { return Vec3{r * std::cos(turn), r * std::sin(turn), 6.0}; };
    return border_between(clay, 0.0, 19.0, at);
  };
  ASSERT_TRUE(filter_mask(clay, MaskGrow{3.7}).ok());
  for (double turn = 0.0; turn < 2.0 * pi; turn += 0.13) {
    EXPECT_NEAR(reach(turn), 9.7, 0.35 * kFilterVoxelMm) << turn;
  }
  ASSERT_TRUE(filter_mask(clay, MaskGrow{-5.0}).ok());
  for (double turn = 0.0; turn < 2.0 * pi; turn += 0.13) {
    EXPECT_NEAR(reach(turn), 4.7, 0.5 * kFilterVoxelMm) << turn;
  }
}

TEST(MaskGrows, GoesRoundAnEdgeAndNotAcrossAGap) {
  // Two plates, ten voxels apart.
  const auto distance = [](const Vec3& p) {
    const auto plate = [&](double z) {
      const Vec3 q{std::abs(p.x) - 14.0, std::abs(p.y) - 14.0, std::abs(p.z - z) - 3.0};
      const Vec3 out{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
      return length(out) + std::min(0.0, std::max({q.x, q.y, q.z}));
    };
    return std::min(plate(-4.0), plate(4.0));
  };
  Box3 box;
  box.include(Vec3{-15, -15, -8});
  box.include(Vec3{15, 15, 8});
  Clay clay = Clay::from_distance(distance, box, ClayOptions{.voxel_mm = kFilterVoxelMm}).value();
  ASSERT_TRUE(
      clay.apply(stroke_of(Action::mask, 1.6, 1.0, {{11.0, 0, -1.0}, {11.01, 0, -1.0}})).ok());
  ASSERT_GE(clay.mask_at({11.0, 0, -1.0}), 0.9);
  ASSERT_LT(clay.mask_at({11.0, 0, 1.0}), 0.5);
  ASSERT_TRUE(filter_mask(clay, MaskGrow{5.0}).ok());
  EXPECT_GE(clay.mask_at({8.0, 0, -1.0}), 0.5);
  EXPECT_GE(clay.mask_at({14.0, 0, -2.0}), 0.5) << "round the edge";
  EXPECT_LT(clay.mask_at({14.0, 0, -6.0}), 0.5);
  EXPECT_LT(clay.mask_at({11.0, 0, 1.0}), 0.5) << "the other plate";
  EXPECT_LT(clay.mask_at({8.0, 0, 1.0}), 0.5) << "the other plate";
}

TEST(MaskGrows, KeepsBordersAsSoftAsTheyWere) {
  Clay clay = filter_ball();
  ASSERT_TRUE(clay.apply(stroke_of(Action::mask, 5.0, 1.0, {{0, 0, 10}, {0.01, 0, 10}})).ok());
  const auto share_at = [&](double mm) {
    const double angle = mm / kFilterBallMm;
    return clay.mask_at(kFilterBallMm * Vec3{std::sin(angle), 0.0, std::cos(angle)});
  };
  std::vector<double> before;
  for (double mm = 0.0; mm <= 6.0; mm += 0.25) before.push_back(share_at(mm));
  ASSERT_TRUE(filter_mask(clay, MaskGrow{3.0}).ok());
  for (std::size_t n = 0; n < before.size(); ++n) {
    const double mm = 0.25 * static_cast<double>(n);
    EXPECT_NEAR(share_at(mm + 3.0), before[n], 0.03) << mm;
  }
  ASSERT_TRUE(filter_mask(clay, MaskGrow{-3.0}).ok());
  for (std::size_t n = 4; n < before.size(); ++n) {
    EXPECT_NEAR(share_at(0.25 * static_cast<double>(n)), before[n], 0.05) << n;
  }
  EXPECT_THAT(clay.validate(), IsEmpty());
}

TEST(MaskGrows, EndsWhereNothingIsLeftOrAllIsHeld) {
  Clay clay = filter_ball(0.4);
  mask_cap(clay, 3.0);
  ASSERT_TRUE(filter_mask(clay, MaskGrow{-5.0}).ok());
  for (double angle = 0.0; angle < 3.1; angle += 0.05) {
    EXPECT_LE(clay.mask_at(kFilterBallMm * Vec3{std::sin(angle), 0.0, std::cos(angle)}), 0.01);
  }
  ASSERT_TRUE(clay.undo());
  ASSERT_TRUE(filter_mask(clay, MaskGrow{20.0}).ok());
  ASSERT_TRUE(filter_mask(clay, MaskGrow{20.0}).ok());
  for (double angle = 0.0; angle < 3.1; angle += 0.05) {
    EXPECT_GE(clay.mask_at(kFilterBallMm * Vec3{std::sin(angle), 0.0, std::cos(angle)}), 0.99);
  }
  ASSERT_TRUE(clay.apply(MaskEdit::clear).ok());
  ASSERT_TRUE(filter_mask(clay, MaskGrow{2.0}).ok());
  EXPECT_FALSE(clay.has_mask()) << "what has no border has nothing to grow";
}

// ---- by curvature ------------------------------------------------------------------------------

/// A block with a groove along y, whose bottom and shoulders are round.
Clay grooved(double groove_mm) {
  const auto distance = [=](const Vec3& p) {
    const double block =
        std::max({std::abs(p.x) - 14.0, std::abs(p.y) - 14.0, std::abs(p.z) - 6.0});
    const double groove = groove_mm - std::hypot(p.x, p.z - 6.0);
    return std::max(block, groove);
  };
  Box3 box;
  box.include(Vec3{-15, -15, -7});
  box.include(Vec3{15, 15, 7});
  return Clay::from_distance(distance, box, ClayOptions{.voxel_mm = kFilterVoxelMm}).value();
}

TEST(MaskCavities, HoldGroovesByTheirRadius) {
  for (const double groove_mm : {2.0, 4.0}) {
    Clay clay = grooved(groove_mm);
    ASSERT_TRUE(filter_mask(clay, MaskCavity{1.0, 1.0}).ok());
    for (double y = -8.0; y <= 8.0; y += 0.7) {
      EXPECT_NEAR(clay.mask_at({0.0, y, 6.0 - groove_mm}), 1.0 / groove_mm, 0.07) << y;
      EXPECT_EQ(clay.mask_at({9.0, y, 6.0}), 0.0) << "flat";
      EXPECT_EQ(clay.mask_at({groove_mm, y, 6.0}), 0.0) << "the shoulder stands out";
    }
  }
  Clay clay = grooved(2.0);
  ASSERT_TRUE(filter_mask(clay, MaskCavity{1.0, 2.5}).ok());
  EXPECT_EQ(clay.mask_at({0.0, 0.0, 4.0}), 1.0) << "by the factor";
  ASSERT_TRUE(filter_mask(clay, MaskCavity{1.0, 2.5, true}).ok());
  EXPECT_EQ(clay.mask_at({0.0, 0.0, 4.0}), 0.0);
  EXPECT_EQ(clay.mask_at({9.0, 0.0, 6.0}), 1.0);
  EXPECT_EQ(clay.mask_at({100.0, 0.0, 6.0}), 1.0) << "in all of space";
}

TEST(MaskCavities, OfANegativeFactorHoldWhatStandsOut) {
  Clay clay = grooved(4.0);
  ASSERT_TRUE(filter_mask(clay, MaskCavity{1.0, -1.0}).ok());
  EXPECT_GE(clay.mask_at({4.0, 0.0, 6.0}), 0.5);
  EXPECT_EQ(clay.mask_at({0.0, 0.0, 2.0}), 0.0);
  // Of a ball both curvatures are 1 / R: 2 r / R.
  Clay ball = filter_ball();
  ASSERT_TRUE(filter_mask(ball, MaskCavity{1.0, -1.0}).ok());
  for (double angle = 0.0; angle < 3.1; angle += 0.1) {
    EXPECT_NEAR(ball.mask_at(kFilterBallMm * Vec3{std::sin(angle), 0.0, std::cos(angle)}), 0.2,
                0.07)
        << angle;
  }
  ASSERT_TRUE(filter_mask(ball, MaskCavity{1.0, 1.0}).ok());
  EXPECT_FALSE(ball.has_mask());
}

// ---- of both -----------------------------------------------------------------------------------

/// A ball with fine detail in front alone, so that the mask's nodes lie at several levels.
Clay fine_in_front() {
  Clay clay = filter_ball();
  for (int n = 0; n < 6; ++n) {
    const double turn = 0.2 * n - 0.5;
    EXPECT_TRUE(clay.apply(stroke_of(Action::add, 0.5, 0.8,
                                     {{10.0 * std::cos(turn), 10.0 * std::sin(turn), 0.2}}))
                    .ok());
  }
  EXPECT_TRUE(
      clay.apply(stroke_of(Action::mask, 3.0, 0.9, {{10, 0, 0}, {9.5, 3.0, 0}, {7, 7, 0.5}})).ok());
  return clay;
}

std::vector<MaskFilter> some_filters() {
  return {MaskGrow{1.3}, MaskGrow{-0.9}, MaskCavity{0.8, 1.5}, MaskCavity{0.6, -2.0, true}};
}

TEST(MaskFilterGolden, HasTheSameBitsForAnyNumberOfThreads) {
  for (const MaskFilter& filter : some_filters()) {
    std::vector<std::uint64_t> hashes;
    for (const std::size_t threads : {1U, 2U, 7U}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      Clay clay = fine_in_front();
      ASSERT_TRUE(filter_mask(clay, filter).ok());
      hashes.push_back(clay.hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]) << filter.index();
    EXPECT_EQ(hashes[0], hashes[2]) << filter.index();
  }
}

TEST(MaskFilters, AreUndoneAndRedoneBitForBit) {
  for (const MaskFilter& filter : some_filters()) {
    Clay clay = fine_in_front();
    const std::uint64_t before = clay.hash();
    ASSERT_TRUE(filter_mask(clay, filter).ok());
    const std::uint64_t after = clay.hash();
    EXPECT_NE(after, before) << filter.index();
    EXPECT_THAT(clay.validate(), IsEmpty());
    ASSERT_TRUE(clay.undo());
    EXPECT_EQ(clay.hash(), before);
    ASSERT_TRUE(clay.redo());
    EXPECT_EQ(clay.hash(), after);
  }
}

TEST(MaskFilters, ThatAreInterruptedChangeNothing) {
  for (const MaskFilter& filter : some_filters()) {
    Clay clay = fine_in_front();
    const std::uint64_t before = clay.hash();
    const int depth = clay.undo_depth();
    // By curvature so small a clay is done between two answers.
    const bool is_cavity = std::holds_alternative<MaskCavity>(filter);
    for (const int stop_after : {0, is_cavity ? 0 : 1, is_cavity ? 0 : 3}) {
      int calls = 0;
      const auto stopped =
          filter_mask(clay, filter, [&](std::string_view, double) { return calls++ < stop_after; });
      ASSERT_FALSE(stopped.ok()) << filter.index() << " " << stop_after;
      EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted);
      EXPECT_EQ(clay.hash(), before);
      EXPECT_EQ(clay.undo_depth(), depth);
    }
  }
}

TEST(MaskFilters, ThatDoNotFitInMemoryChangeNothing) {
  for (const MaskFilter& filter : some_filters()) {
    Clay clay = fine_in_front();
    const std::uint64_t before = clay.hash();
    const ClayUse use = clay.use();
    ClayLimits limits = clay.limits();
    limits.memory_bytes = use.level_bytes + use.undo_bytes + use.mask_bytes + 4000;
    ASSERT_TRUE(clay.set_limits(limits).ok());
    const auto refused = filter_mask(clay, filter);
    ASSERT_FALSE(refused.ok()) << filter.index();
    EXPECT_EQ(refused.error().kind, ErrorKind::memory);
    EXPECT_EQ(clay.hash(), before);
  }
}

TEST(MaskFilters, NameWhatIsOutOfRange) {
  Clay clay = filter_ball();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refusal = [&](const MaskFilter& filter) {
    const auto refused = filter_mask(clay, filter);
    EXPECT_FALSE(refused.ok());
    return refused.ok() ? std::string() : refused.error().message;
  };
  EXPECT_THAT(refusal(MaskGrow{0.0}), HasSubstr("by_mm of the mask is 0; must be"));
  EXPECT_THAT(refusal(MaskGrow{nan}), HasSubstr("must be"));
  EXPECT_THAT(refusal(MaskGrow{1e-4}), HasSubstr("a twentieth of the clay's voxel"));
  EXPECT_THAT(refusal(MaskGrow{-500.0}), HasSubstr("by_mm of the mask is -500; must be from"));
  EXPECT_THAT(refusal(MaskCavity{0.0}), HasSubstr("radius_mm of the cavities is 0"));
  EXPECT_THAT(refusal(MaskCavity{0.1}), HasSubstr("two voxels of the clay"));
  EXPECT_THAT(refusal(MaskCavity{1e4}), HasSubstr("four of its coarsest level"));
  EXPECT_THAT(refusal(MaskCavity{1.0, 0.0}), HasSubstr("factor of the cavities is 0"));
  EXPECT_THAT(refusal(MaskCavity{1.0, nan}), HasSubstr("-100 to 100"));
  EXPECT_EQ(clay.undo_depth(), 0);
  ASSERT_TRUE(clay.begin_stroke(Tool{}).ok());
  EXPECT_THAT(refusal(MaskGrow{1.0}), HasSubstr("stroke"));
}

TEST(MaskSharpen, MakesBordersHalfAsWideWhereTheyAre) {
  Clay clay = filter_ball();
  ASSERT_TRUE(clay.apply(stroke_of(Action::mask, 6.0, 1.0, {{0, 0, 10}, {0.01, 0, 10}})).ok());
  const double border = cap_mm(clay, 0.4);
  std::vector<double> before;
  const auto share_at = [&](double mm) {
    const double angle = mm / kFilterBallMm;
    return clay.mask_at(kFilterBallMm * Vec3{std::sin(angle), 0.0, std::cos(angle)});
  };
  for (double mm = 0.0; mm <= 7.0; mm += 0.25) before.push_back(share_at(mm));
  ASSERT_TRUE(clay.apply(MaskEdit::sharpen).ok());
  EXPECT_NEAR(cap_mm(clay, 0.4), border, 0.02 * kFilterVoxelMm);
  for (std::size_t n = 0; n < before.size(); ++n) {
    EXPECT_NEAR(share_at(0.25 * static_cast<double>(n)),
                std::clamp(2.0 * before[n] - 0.5, 0.0, 1.0), 0.04);
  }
  for (int n = 0; n < 8; ++n) ASSERT_TRUE(clay.apply(MaskEdit::sharpen).ok());
  EXPECT_NEAR(cap_mm(clay, 0.4), border, kFilterVoxelMm);
  EXPECT_EQ(share_at(border - 3.0 * kFilterVoxelMm), 1.0);
  EXPECT_EQ(share_at(border + 3.0 * kFilterVoxelMm), 0.0);
}

}  // namespace
}  // namespace argil
