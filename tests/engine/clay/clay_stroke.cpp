// SPDX-License-Identifier: GPL-3.0-or-later
// A stroke applied while it is made against the same stroke given whole.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"

#include "support/effort.h"

namespace argil {
namespace {

Clay ball_to_stroke() {
  ClayOptions options;
  options.voxel_mm = 0.5;
  return Clay::ball(10.0, options).value();
}

/// Enough for a few dabs, or for many.
int usual_samples() { return test::effort(10, 30); }

/// Round the ball's equator, rising, turning and pressing harder, with a rest in the middle.
Stroke winding_stroke(Action action, const Mirror& mirror, int samples = 30) {
  const int middle = samples / 2;
  Stroke stroke;
  stroke.tool = {action, Shape::ellipsoid, {3.0, 2.5, 4.0}, 0.7};
  stroke.spacing = 0.6;
  stroke.mirror = mirror;
  for (int i = 0; i < samples; ++i) {
    const double a = 0.03 * (i < middle ? i : std::max(middle, i - 3));
    stroke.samples.push_back({0.01 * i,
                              {9.5 * std::cos(a), 9.5 * std::sin(a), 6.0 * a},
                              {std::cos(a), 0.0, std::sin(a), 0.1},
                              0.5 + 0.01 * i});
  }
  return stroke;
}

/// Gives `stroke` in pieces of random length, empty ones included. False when a call failed.
bool apply_in_pieces(Clay& clay, const Stroke& stroke, std::uint32_t seed) {
  std::mt19937 random(seed);
  if (!clay.begin_stroke(stroke.tool, stroke)) return false;
  std::span<const StrokeSample> rest(stroke.samples);
  while (!rest.empty()) {
    const std::size_t count = std::min<std::size_t>(random() % 5, rest.size());
    if (!clay.extend_stroke(rest.first(count))) return false;
    rest = rest.subspan(count);
  }
  return true;
}

TEST(LiveStrokeDabs, DoNotDependOnThePieces) {
  const Stroke stroke = winding_stroke(Action::add, {true, false, true});
  const std::vector<Dab> whole = dabs_of(stroke);
  ASSERT_GT(whole.size(), 20U);
  DabFeeder feeder(stroke.tool, stroke);
  std::size_t at = 0;
  for (const StrokeSample& sample : stroke.samples) {
    std::vector<Dab> piece;
    feeder.feed(sample, piece);
    if (&sample == &stroke.samples.back()) feeder.finish(piece);
    for (const Dab& dab : piece) {
      ASSERT_LT(at, whole.size());
      EXPECT_EQ(dab.at.position_mm, whole[at].at.position_mm);
      EXPECT_EQ(dab.at.orientation, whole[at].at.orientation);
      EXPECT_EQ(dab.at.pressure, whole[at].at.pressure);
      ++at;
    }
  }
  EXPECT_EQ(at, whole.size());
}

class LiveStrokeAction : public testing::TestWithParam<Action> {};

TEST_P(LiveStrokeAction, GivesTheBitsOfTheStrokeGivenWhole) {
  const std::vector<Mirror> some{{}, {true, false, true}};
  const std::vector<Mirror> all{{}, {true, false, false}, {true, true, true}};
  for (const Mirror& mirror : test::effort(some, all)) {
    const Stroke stroke = winding_stroke(GetParam(), mirror, usual_samples());
    Clay whole = ball_to_stroke();
    const std::uint64_t start = whole.hash();
    const auto expected = whole.apply(stroke);
    ASSERT_TRUE(expected.ok());
    ASSERT_NE(whole.hash(), start);
    for (std::uint32_t seed = 1; seed <= test::effort(1U, 2U); ++seed) {
      Clay live = ball_to_stroke();
      ASSERT_TRUE(apply_in_pieces(live, stroke, seed));
      const auto report = live.end_stroke();
      ASSERT_TRUE(report.ok());
      EXPECT_EQ(report.value().dabs, expected.value().dabs);
      EXPECT_EQ(report.value().level, expected.value().level);
      EXPECT_EQ(live.hash(), whole.hash());
      EXPECT_EQ(live.undo_depth(), 1);
      EXPECT_TRUE(live.validate().empty());
      ASSERT_TRUE(live.undo());
      EXPECT_EQ(live.hash(), start);
      ASSERT_TRUE(live.redo());
      EXPECT_EQ(live.hash(), whole.hash());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Clay, LiveStrokeAction,
                         testing::Values(Action::add, Action::carve, Action::smooth,
                                         Action::inflate));

TEST(LiveStroke, ShowsWhatIsDoneSoFarAndCanBeTakenBack) {
  Clay clay = ball_to_stroke();
  const std::uint64_t start = clay.hash();
  const Stroke stroke = winding_stroke(Action::carve, {});
  const Vec3 place{9.5, 0.0, 0.0};
  const double before = clay.distance_at(place);
  ASSERT_TRUE(apply_in_pieces(clay, stroke, 3));
  EXPECT_TRUE(clay.is_stroke_open());
  EXPECT_GT(clay.distance_at(place), before + 0.5);
  EXPECT_NE(clay.hash(), start);
  EXPECT_TRUE(clay.cancel_stroke());
  EXPECT_FALSE(clay.is_stroke_open());
  EXPECT_EQ(clay.hash(), start);
  EXPECT_EQ(clay.undo_depth(), 0);
  EXPECT_FALSE(clay.cancel_stroke());
}

TEST(LiveStroke, KeepsUndoAndRedoForWhenItIsClosed) {
  Clay clay = ball_to_stroke();
  ASSERT_TRUE(clay.apply(winding_stroke(Action::add, {}, usual_samples())).ok());
  const std::uint64_t one = clay.hash();
  const Stroke second = winding_stroke(Action::carve, {}, usual_samples());
  ASSERT_TRUE(clay.undo());
  ASSERT_TRUE(apply_in_pieces(clay, second, 4));
  const std::uint64_t open = clay.hash();
  EXPECT_FALSE(clay.redo());
  EXPECT_EQ(clay.hash(), open);
  ASSERT_TRUE(clay.cancel_stroke());
  ASSERT_TRUE(clay.redo());  // a stroke that was taken back costs nothing
  EXPECT_EQ(clay.hash(), one);
  ASSERT_TRUE(apply_in_pieces(clay, second, 4));
  EXPECT_FALSE(clay.undo());
  EXPECT_EQ(clay.undo_depth(), 1);
  ASSERT_TRUE(clay.end_stroke().ok());
  EXPECT_EQ(clay.undo_depth(), 2);
}

TEST(LiveStroke, WithoutSamplesLeavesNoUndoStep) {
  Clay clay = ball_to_stroke();
  ASSERT_TRUE(clay.begin_stroke({}).ok());
  ASSERT_TRUE(clay.extend_stroke({}).ok());
  const auto report = clay.end_stroke();
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report.value().dabs, 0);
  EXPECT_EQ(clay.undo_depth(), 0);
}

template <class T>
std::string message_of(const Result<T>& result) {
  return result.ok() ? std::string("accepted") : result.error().message;
}

TEST(LiveStroke, RefusesCallsOutOfTurn) {
  Clay clay = ball_to_stroke();
  const Stroke stroke = winding_stroke(Action::carve, {});
  EXPECT_NE(message_of(clay.extend_stroke(stroke.samples)).find("begin one"), std::string::npos);
  EXPECT_NE(message_of(clay.end_stroke()).find("begin one"), std::string::npos);
  ASSERT_TRUE(clay.begin_stroke(stroke.tool, stroke).ok());
  EXPECT_NE(message_of(clay.begin_stroke(stroke.tool, stroke)).find("end or cancel"),
            std::string::npos);
  EXPECT_NE(message_of(clay.apply(stroke)).find("end or cancel"), std::string::npos);
  EXPECT_TRUE(clay.is_stroke_open());
}

TEST(LiveStroke, RefusesABadPieceAndStaysOpen) {
  Clay clay = ball_to_stroke();
  const Stroke stroke = winding_stroke(Action::carve, {}, usual_samples());
  EXPECT_NE(message_of(clay.begin_stroke(stroke.tool, {.spacing = 0.0})).find("spacing is 0"),
            std::string::npos);
  Tool huge = stroke.tool;
  huge.radii_mm = {1e6, 1e6, 1e6};
  EXPECT_NE(message_of(clay.begin_stroke(huge)).find("radius_mm"), std::string::npos);
  ASSERT_TRUE(apply_in_pieces(clay, stroke, 5));
  const std::uint64_t before = clay.hash();
  StrokeSample bad = stroke.samples.back();
  bad.time_s = 0.0;
  EXPECT_NE(message_of(clay.extend_stroke({&bad, 1})).find("backwards"), std::string::npos);
  bad = stroke.samples.back();
  bad.position_mm.x = 1e9;
  EXPECT_NE(message_of(clay.extend_stroke({&bad, 1})).find("out of reach"), std::string::npos);
  bad.position_mm.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message_of(clay.extend_stroke({&bad, 1})).find("not finite"), std::string::npos);
  EXPECT_EQ(clay.hash(), before);
  Clay whole = ball_to_stroke();
  ASSERT_TRUE(whole.apply(stroke).ok());
  ASSERT_TRUE(clay.end_stroke().ok());
  EXPECT_EQ(clay.hash(), whole.hash());
}

}  // namespace
}  // namespace argil
