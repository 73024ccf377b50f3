// SPDX-License-Identifier: GPL-3.0-or-later
// A history that is taken over from the same sculpture made anew, or given up.
#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/sculpture.h"

#include "support/stroke_maker.h"

namespace argil {
namespace {

Sculpture one_ball() { return Sculpture(Clay::ball(5.0, {0.35, 0.1}).value()); }

/// Strokes, an operation and pieces that come and go; the hashes before the first and after each.
std::vector<std::uint64_t> work_all(Sculpture& sculpture) {
  std::vector<std::uint64_t> hashes{sculpture.hash()};
  const auto done = [&](const Result<void>& result) {
    EXPECT_TRUE(result) << result.error().message;
    hashes.push_back(sculpture.hash());
  };
  std::mt19937 random(3);
  const auto draw = [&] {
    Stroke stroke = random_dab(random, 5.0);
    stroke.tool = {Action::add, Shape::ball, {1.5, 1.5, 1.5}, 1.0};
    stroke.samples.resize(1);
    stroke.samples[0].position_mm = normalized(stroke.samples[0].position_mm) * 5.0;
    EXPECT_TRUE(sculpture.clay().apply(stroke));
    done({});
  };
  draw();
  draw();
  done(sculpture.apply(CopyPiece{"Clay", "Other"}));
  draw();
  EXPECT_TRUE(sculpture.clay().apply(Operation(Cut{{0.0, 0.0, 3.0}, {0.0, 0.0, 1.0}, true})));
  done({});
  done(sculpture.apply(RemovePiece{"Clay"}));
  draw();
  return hashes;
}

TEST(SculptureHistory, IsTakenOverWhereClaysStayWhatTheyAre) {
  Sculpture made = one_ball();
  const std::vector<std::uint64_t> hashes = work_all(made);
  ASSERT_TRUE(made.undo());
  Sculpture bare = copy_of(made);
  ASSERT_EQ(bare.undo_depth(), 0);
  const Clay* clay = &bare.clay();
  bare.take_history(std::move(made));
  EXPECT_EQ(&bare.clay(), clay);
  EXPECT_EQ(bare.hash(), hashes[hashes.size() - 2]);
  ASSERT_TRUE(bare.redo());
  EXPECT_EQ(bare.hash(), hashes.back());
  EXPECT_FALSE(bare.redo());
  for (std::size_t n = hashes.size() - 1; n-- > 0;) {
    ASSERT_TRUE(bare.undo()) << n;
    EXPECT_EQ(bare.hash(), hashes[n]) << n;
    EXPECT_THAT(bare.clay().validate(), testing::IsEmpty());
  }
  EXPECT_FALSE(bare.undo());
  for (std::size_t n = 1; n < hashes.size(); ++n) {
    ASSERT_TRUE(bare.redo());
    EXPECT_EQ(bare.hash(), hashes[n]) << n;
  }
}

TEST(SculptureHistory, GoesOnBehindWhatWasTakenOver) {
  Sculpture made = one_ball();
  const std::vector<std::uint64_t> hashes = work_all(made);
  Sculpture bare = copy_of(made);
  bare.take_history(std::move(made));
  Stroke stroke;
  stroke.samples = {{0.0, {0.0, 5.0, 0.0}, {}, 1.0}};
  ASSERT_TRUE(bare.clay().apply(stroke));
  EXPECT_EQ(bare.undo_depth(), static_cast<int>(hashes.size()));
  for (std::size_t n = hashes.size(); n-- > 0;) {
    ASSERT_TRUE(bare.undo());
    EXPECT_EQ(bare.hash(), hashes[n]) << n;
  }
}

TEST(SculptureHistory, ThatIsForgottenBeginsAnew) {
  Sculpture sculpture = one_ball();
  const std::vector<std::uint64_t> hashes = work_all(sculpture);
  ASSERT_TRUE(sculpture.undo());
  sculpture.forget_history();
  EXPECT_EQ(sculpture.undo_depth(), 0);
  EXPECT_EQ(sculpture.redo_depth(), 0);
  EXPECT_FALSE(sculpture.undo());
  EXPECT_FALSE(sculpture.redo());
  EXPECT_EQ(sculpture.hash(), hashes[hashes.size() - 2]);
  EXPECT_EQ(sculpture.clay().use().undo_bytes, 0);
  Stroke stroke;
  stroke.samples = {{0.0, {0.0, 5.0, 0.0}, {}, 1.0}};
  ASSERT_TRUE(sculpture.clay().apply(stroke));
  ASSERT_TRUE(sculpture.undo());
  EXPECT_EQ(sculpture.hash(), hashes[hashes.size() - 2]);
  EXPECT_FALSE(sculpture.undo());
}

}  // namespace
}  // namespace argil
