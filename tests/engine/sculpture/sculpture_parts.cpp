// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces placed together, of another size, and taken apart into their solids.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay_copy.h"
#include "argil/engine/operation.h"
#include "argil/engine/sculpture.h"
#include "argil/engine/surface.h"

#include "clay/clay_access.h"
#include "operation/split_levels.h"

namespace argil {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kPartVoxel = 0.3;

struct Ball {
  Vec3 at;
  double radius_mm = 0.0;
  double volume_mm3() const {
    return 4.0 / 3.0 * std::numbers::pi * radius_mm * radius_mm * radius_mm;
  }
  double distance(const Vec3& p) const { return length(p - at) - radius_mm; }
};

/// Balls apart from each other, as one clay.
Clay clay_of_balls(const std::vector<Ball>& balls) {
  Box3 box;
  for (const Ball& ball : balls) {
    const Vec3 half{ball.radius_mm, ball.radius_mm, ball.radius_mm};
    box.include(ball.at - half);
    box.include(ball.at + half);
  }
  const auto nearest = [&](const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const Ball& ball : balls) least = std::min(least, ball.distance(p));
    return least;
  };
  return Clay::from_distance(nearest, box, {kPartVoxel, 0.1}).value();
}

double volume(const Clay& clay) { return signed_volume(extract_surface(clay)); }

/// The farthest that the surface lies from a ball's, in voxels.
double farthest_miss(const Clay& clay, const Ball& ball) {
  double most = 0.0;
  for (const Vec3& p : extract_surface(clay).positions) {
    most = std::max(most, std::abs(ball.distance(p)));
  }
  return most / kPartVoxel;
}

std::vector<std::string> names_of(const Sculpture& sculpture) {
  std::vector<std::string> names;
  for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
    names.push_back(sculpture.look(n).name);
  }
  return names;
}

// ---- places ------------------------------------------------------------------------------------

TEST(SculpturePlaces, AreChangedTogetherInOneStep) {
  Sculpture sculpture(clay_of_balls({{{}, 4.0}}));
  ASSERT_TRUE(sculpture.apply(CopyPiece{"Clay", "B"}));
  const std::uint64_t before = sculpture.hash();
  const int depth = sculpture.undo_depth();
  const Placement one{{1.0, 2.0, 3.0}, {}};
  const Placement other{{-4.0, 0.0, 0.5}, {0.0, 2.0, 0.0, 0.0}};
  ASSERT_TRUE(sculpture.apply(PlacePieces{{{"B", other}, {"Clay", one}}}));
  EXPECT_EQ(sculpture.look(0).placement.position_mm, one.position_mm);
  EXPECT_EQ(sculpture.look(1).placement.position_mm, other.position_mm);
  EXPECT_EQ(sculpture.look(1).placement.orientation, (Quat{0.0, 1.0, 0.0, 0.0})) << "of one length";
  EXPECT_EQ(sculpture.undo_depth(), depth + 1);
  const std::uint64_t after = sculpture.hash();
  ASSERT_TRUE(sculpture.undo());
  EXPECT_EQ(sculpture.hash(), before);
  ASSERT_TRUE(sculpture.redo());
  EXPECT_EQ(sculpture.hash(), after);
}

TEST(SculpturePlaces, AreAllRefusedWhereOneIs) {
  Sculpture sculpture(clay_of_balls({{{}, 4.0}}));
  ASSERT_TRUE(sculpture.apply(CopyPiece{"Clay", "B"}));
  ASSERT_TRUE(sculpture.apply(ChangePiece{.name = "B", .is_locked = true}));
  const std::uint64_t before = sculpture.hash();
  const Placement there{{1.0, 0.0, 0.0}, {}};
  const auto refuses = [&](const PlacePieces& place, const char* message) {
    const auto done = sculpture.apply(place);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr(message));
    EXPECT_EQ(sculpture.hash(), before);
  };
  refuses({{{"Clay", there}, {"B", there}}}, "'B' is locked");
  refuses({{{"Clay", there}, {"C", there}}}, "no piece 'C'");
  refuses({{{"Clay", there}, {"Clay", there}}}, "placed twice");
  refuses({{{"Clay", there}, {"Clay", Placement{{2e6, 0.0, 0.0}, {}}}}}, "twice");
  refuses({{{"Clay", Placement{{2e6, 0.0, 0.0}, {}}}}}, "1 km");
  refuses({}, "no piece is named");
}

// ---- size --------------------------------------------------------------------------------------

TEST(SculptureScale, KeepsTheShapeTheDetailAndThePointThatItIsScaledAbout) {
  for (const double factor : {0.37, 2.0, 13.0}) {
    Clay clay = clay_of_balls({{{}, 4.0}, {{3.0, 1.0, 0.0}, 2.5}});
    const Clay former = copy_of(clay);
    Sculpture sculpture(std::move(clay));
    const Placement there{{5.0, -3.0, 8.0}, normalized(Quat{0.9, 0.1, -0.3, 0.2})};
    ASSERT_TRUE(sculpture.apply(ChangePiece{.name = "Clay", .placement = there}));
    const std::uint64_t before = sculpture.hash();
    const Vec3 fixed{1.0, 2.0, 3.0};
    ASSERT_TRUE(sculpture.apply(ScalePiece{"Clay", factor, fixed}));
    const Clay& scaled = sculpture.clay();
    EXPECT_DOUBLE_EQ(scaled.options().voxel_mm, factor * kPartVoxel);
    ASSERT_EQ(scaled.level_count(), former.level_count());
    for (int level = 0; level < scaled.level_count(); ++level) {
      const auto n = static_cast<std::size_t>(level);
      EXPECT_EQ(scaled.level_stats()[n].leaves, former.level_stats()[n].leaves);
    }
    EXPECT_THAT(scaled.validate(), IsEmpty());
    // As a picture of the former about the fixed point.
    const Placement& now = sculpture.look(0).placement;
    EXPECT_EQ(now.orientation, sculpture.look(0).placement.orientation);
    const TriangleMesh was = extract_surface(former);
    const TriangleMesh is = extract_surface(scaled);
    // Where two ways of cutting a face in two are alike, rounding may choose the other.
    ASSERT_EQ(is.triangles.size(), was.triangles.size());
    ASSERT_EQ(is.positions.size(), was.positions.size());
    for (std::size_t n = 0; n < is.positions.size(); ++n) {
      const Vec3 wanted = fixed + factor * (placed(there, was.positions[n]) - fixed);
      EXPECT_LT(length(placed(now, is.positions[n]) - wanted), 1e-5 * factor);
    }
    const std::uint64_t after = sculpture.hash();
    ASSERT_TRUE(sculpture.undo());
    EXPECT_EQ(sculpture.hash(), before);
    ASSERT_TRUE(sculpture.redo());
    EXPECT_EQ(sculpture.hash(), after);
  }
}

TEST(SculptureScale, ByTwoAndBackKeepsEveryBitAndThePlace) {
  Clay clay = clay_of_balls({{{}, 4.0}, {{3.0, 1.0, 0.0}, 2.5}});
  ASSERT_TRUE(clay.apply(Operation(Cut{{0.0, 0.0, 1.0}, {0.2, 0.3, 1.0}, false})));
  Sculpture sculpture(std::move(clay));
  const std::uint64_t before = sculpture.hash();
  ASSERT_TRUE(sculpture.apply(ScalePiece{"Clay", 2.0}));
  EXPECT_TRUE(sculpture.is_plain()) << "scaled about its origin it stays in its place";
  EXPECT_NE(sculpture.hash(), before);
  ASSERT_TRUE(sculpture.apply(ScalePiece{"Clay", 0.5}));
  EXPECT_EQ(sculpture.hash(), before);
}

TEST(SculptureScale, TakesTheMaskAlong) {
  Clay clay = clay_of_balls({{{}, 4.0}});
  Stroke stroke;
  stroke.tool.action = Action::mask;
  stroke.tool.radii_mm = {2.0, 2.0, 2.0};
  for (int n = 0; n < 4; ++n) {
    stroke.samples.push_back({0.01 * n, {0.2 * n, 0.0, 4.0}, {}, 1.0});
  }
  ASSERT_TRUE(clay.apply(stroke));
  ASSERT_TRUE(clay.has_mask());
  const Clay former = copy_of(clay);
  Sculpture sculpture(std::move(clay));
  ASSERT_TRUE(sculpture.apply(ScalePiece{"Clay", 3.0}));
  double most = 0.0;
  for (int n = 0; n < 200; ++n) {
    const Vec3 p{0.02 * n - 2.0, 0.01 * n - 1.0, 4.0 - 0.005 * n};
    most = std::max(most, former.mask_at(p));
    EXPECT_NEAR(sculpture.clay().mask_at(3.0 * p), former.mask_at(p), 1e-9);
  }
  EXPECT_GT(most, 0.5);
  EXPECT_THAT(sculpture.clay().validate(), IsEmpty());
}

/// What it was stays for undo.
TEST(SculptureScale, AsksForMemoryBeforeItTakesIt) {
  Sculpture sculpture(clay_of_balls({{{}, 4.0}}));
  const std::int64_t bytes = sculpture.clay().use().level_bytes;
  const std::uint64_t before = sculpture.hash();
  ASSERT_TRUE(sculpture.set_limits({.memory_bytes = 2 * bytes - 1}));
  const auto scaled = sculpture.apply(ScalePiece{"Clay", 2.0});
  ASSERT_FALSE(scaled);
  EXPECT_EQ(scaled.error().kind, ErrorKind::memory);
  EXPECT_EQ(sculpture.hash(), before);
  ASSERT_TRUE(sculpture.set_limits({.memory_bytes = 2 * bytes}));
  EXPECT_TRUE(sculpture.apply(ScalePiece{"Clay", 2.0}));
}

TEST(SculptureScale, RefusesWhatNoClayCanBeAndStopsWhenAsked) {
  Sculpture sculpture(clay_of_balls({{{}, 4.0}}));
  const std::uint64_t before = sculpture.hash();
  const auto refuses = [&](const ScalePiece& scale, const char* message) {
    const auto done = sculpture.apply(scale);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(done.error().message, HasSubstr(message));
    EXPECT_EQ(sculpture.hash(), before);
  };
  refuses({"Clay", 1.0}, "changes nothing");
  refuses({"Clay", 0.0}, "must be from");
  refuses({"Clay", -2.0}, "must be from");
  refuses({"Clay", std::nan("")}, "must be from");
  refuses({"Clay", 1e-4}, "to 3333.33");
  refuses({"Clay", 4000.0}, "to 3333.33");
  refuses({"Clay", 2.0, Vec3{1e7, 0.0, 0.0}}, "1 km");
  refuses({"Clay", 3000.0, Vec3{9e5, 0.0, 0.0}}, "1 km");
  refuses({"Ear", 2.0}, "no piece 'Ear'");
  const auto stopped =
      sculpture.apply(ScalePiece{"Clay", 2.0}, [](std::string_view, double) { return false; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted);
  EXPECT_EQ(sculpture.hash(), before);
  ASSERT_TRUE(sculpture.apply(ChangePiece{.name = "Clay", .is_locked = true}));
  const auto locked = sculpture.apply(ScalePiece{"Clay", 2.0});
  ASSERT_FALSE(locked);
  EXPECT_THAT(locked.error().message, HasSubstr("locked"));
}

// ---- parts -------------------------------------------------------------------------------------

TEST(SculptureSplit, SolidsThatAreFarApartKeepTheirBits) {
  const Ball small{{0.0, 0.0, 0.0}, 3.0};
  Sculpture sculpture(clay_of_balls({small}));
  const Clay alone = copy_of(sculpture.clay());
  AddPiece add;
  add.look.name = "Far";
  add.look.placement.position_mm = {14.0, 0.0, 0.0};
  add.clay = std::make_shared<const Clay>(clay_of_balls({{{}, 4.0}}));
  ASSERT_TRUE(sculpture.apply(add));
  ASSERT_TRUE(sculpture.apply(MergePiece{"Clay", "Far"}));
  const std::uint64_t before = sculpture.hash();
  ASSERT_TRUE(sculpture.apply(SplitPiece{"Clay"}));
  EXPECT_EQ(names_of(sculpture), (std::vector<std::string>{"Clay", "Clay 2"}));
  EXPECT_EQ(sculpture.look(sculpture.active()).name, "Clay");
  EXPECT_LT(farthest_miss(sculpture.clay(0), {{14.0, 0.0, 0.0}, 4.0}), 0.06)
      << "the larger is the first";
  EXPECT_EQ(sculpture.clay(1).hash(), alone.hash());
  const std::uint64_t after = sculpture.hash();
  // Also while one that came is the active one.
  ASSERT_TRUE(sculpture.apply(SelectPiece{"Clay 2"}));
  ASSERT_TRUE(sculpture.undo());
  EXPECT_EQ(sculpture.hash(), before);
  ASSERT_TRUE(sculpture.redo());
  EXPECT_EQ(sculpture.hash(), after);
}

/// Down to less than a voxel between them each becomes the ball that it is, without a scar where
/// the other was.
TEST(SculptureSplit, SolidsThatNearlyTouchBecomeWhatTheyAre) {
  for (const double gap_voxels : {0.8, 1.5, 4.0, 9.0}) {
    SCOPED_TRACE(gap_voxels);
    const Ball large{{0.04, -0.03, 0.11}, 4.0};
    const Ball small{{0.04 + 4.0 + gap_voxels * kPartVoxel + 3.0, -0.03, 0.11}, 3.0};
    const Clay together = clay_of_balls({large, small});
    const double usual = std::max(farthest_miss(clay_of_balls({large}), large),
                                  farthest_miss(clay_of_balls({small}), small));
    Sculpture sculpture(copy_of(together));
    ASSERT_TRUE(sculpture.apply(SplitPiece{"Clay"}));
    ASSERT_EQ(sculpture.piece_count(), 2U);
    for (const auto& [n, ball] :
         {std::pair{std::size_t{0}, large}, std::pair{std::size_t{1}, small}}) {
      const Clay& part = sculpture.clay(n);
      EXPECT_THAT(part.validate(), IsEmpty());
      EXPECT_NEAR(volume(part), ball.volume_mm3(), 0.01 * ball.volume_mm3());
      EXPECT_LT(farthest_miss(part, ball), usual + 0.05);
      // Distances around it, too, where the other was.
      const Clay alone = clay_of_balls({ball});
      for (double x = 0.2; x < 3.0; x += 0.1) {
        const Vec3 way = n == 0 ? Vec3{1.0, 0.0, 0.0} : Vec3{-1.0, 0.0, 0.0};
        const Vec3 p = ball.at + (ball.radius_mm + x * kPartVoxel) * way;
        EXPECT_NEAR(part.distance_at(p), alone.distance_at(p), 0.2 * kPartVoxel) << x;
      }
    }
  }
}

/// A hollow block with a ball loose in it, and a ball outside that has a cavity, too.
TEST(SculptureSplit, ACavityStaysWithItsSolidAndWhatIsInItDoesNot) {
  const Ball loose{{0.0, 0.0, 0.0}, 2.0};
  const Ball outside{{14.0, 1.0, 0.0}, 4.0};
  const auto formula = [&](const Vec3& p) {
    const double shell = std::max(Ball{{}, 7.0}.distance(p), -Ball{{}, 4.5}.distance(p));
    const double hollow = std::max(outside.distance(p), -Ball{outside.at, 2.0}.distance(p));
    return std::min({shell, hollow, loose.distance(p)});
  };
  const Box3 box{{-7.0, -7.0, -7.0}, {18.0, 7.0, 7.0}};
  Sculpture sculpture(Clay::from_distance(formula, box, {kPartVoxel, 0.1}).value());
  ASSERT_TRUE(sculpture.apply(SplitPiece{"Clay"}));
  ASSERT_EQ(sculpture.piece_count(), 3U);
  const std::vector<double> wanted{Ball{{}, 7.0}.volume_mm3() - Ball{{}, 4.5}.volume_mm3(),
                                   outside.volume_mm3() - Ball{{}, 2.0}.volume_mm3(),
                                   loose.volume_mm3()};
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_NEAR(volume(sculpture.clay(n)), wanted[n], 0.015 * wanted[n]) << n;
    EXPECT_THAT(sculpture.clay(n).validate(), IsEmpty());
  }
  EXPECT_LT(sculpture.clay(0).distance_at({5.7, 0.0, 0.0}), 0.0);
  EXPECT_GT(sculpture.clay(0).distance_at({}), 0.0) << "the ball went";
  EXPECT_GT(sculpture.clay(2).distance_at({5.7, 0.0, 0.0}), 0.0);
}

TEST(SculptureSplit, CrumbsStayWithTheLargest) {
  const std::vector<Ball> balls{{{}, 5.0}, {{9.0, 0.0, 0.0}, 2.5}, {{0.0, 7.0, 0.0}, 0.7}};
  Sculpture sculpture(clay_of_balls(balls));
  SplitPiece split{"Clay", 0.01};
  ASSERT_TRUE(sculpture.apply(split));
  ASSERT_EQ(sculpture.piece_count(), 2U);
  EXPECT_NEAR(volume(sculpture.clay(0)) + volume(sculpture.clay(1)), volume(clay_of_balls(balls)),
              0.1);
  EXPECT_LT(sculpture.clay(0).distance_at(balls[2].at), 0.0);
  const auto again = sculpture.apply(split);
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().message, HasSubstr("one solid and crumbs"));
  split.crumb_share = 0.0;
  ASSERT_TRUE(sculpture.apply(split));
  EXPECT_EQ(names_of(sculpture), (std::vector<std::string>{"Clay", "Clay 3", "Clay 2"}));
  const auto single = sculpture.apply(split);
  ASSERT_FALSE(single);
  EXPECT_THAT(single.error().message, HasSubstr("is one solid"));
}

TEST(SculptureSplit, KeepsLookPlaceAndMaskAndRefusesWhatItCannot) {
  Clay clay = clay_of_balls({{{}, 4.0}, {{9.0, 0.0, 0.0}, 3.0}});
  ASSERT_TRUE(clay.apply(MaskEdit::fill));
  Sculpture sculpture(std::move(clay), {.name = "Pair"});
  ChangePiece look{"Pair"};
  look.placement = Placement{{0.0, 5.0, 1.0}, {0.0, 0.0, 0.0, 1.0}};
  look.color = Rgb8{1, 2, 3};
  ASSERT_TRUE(sculpture.apply(look));
  const std::uint64_t before = sculpture.hash();
  const auto refuses = [&](const SplitPiece& split, const char* message) {
    const auto done = sculpture.apply(split);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr(message));
    EXPECT_EQ(sculpture.hash(), before);
  };
  refuses({"Pair", -0.1}, "from 0 to 1");
  refuses({"Pair", std::nan("")}, "from 0 to 1");
  refuses({"Ear"}, "no piece");
  // At whatever moment it is stopped.
  int asked = 0;
  ASSERT_TRUE(
      sculpture.apply(SplitPiece{"Pair"}, [&](std::string_view, double) { return ++asked > 0; }));
  ASSERT_TRUE(sculpture.undo());
  ASSERT_GE(asked, 4) << "its surface, and each of its levels";
  for (int most = 1; most <= asked; ++most) {
    int told = 0;
    const auto stopped = sculpture.apply(SplitPiece{"Pair"},
                                         [&](std::string_view, double) { return ++told < most; });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted);
    EXPECT_EQ(sculpture.hash(), before);
  }
  // Memory is asked for before the solids are made, each of whose levels would be told of.
  const ClayLimits limits = sculpture.clay().limits();
  ASSERT_TRUE(sculpture.set_limits({.memory_bytes = sculpture.clay().use().level_bytes * 3 / 2}));
  int told = 0;
  const auto too_large =
      sculpture.apply(SplitPiece{"Pair"}, [&](std::string_view, double) { return ++told > 0; });
  ASSERT_FALSE(too_large);
  EXPECT_EQ(too_large.error().kind, ErrorKind::memory);
  EXPECT_LT(told, asked);
  EXPECT_EQ(sculpture.hash(), before);
  ASSERT_TRUE(sculpture.set_limits(limits));
  ASSERT_TRUE(sculpture.apply(SplitPiece{"Pair"}));
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(sculpture.look(n).placement.position_mm, (Vec3{0.0, 5.0, 1.0}));
    EXPECT_EQ(sculpture.look(n).color, (Rgb8{1, 2, 3}));
    EXPECT_EQ(sculpture.clay(n).mask_at({}), 1.0);
  }
}

/// Cavities find their solid whatever lies beside them, by the line to the right of each.
TEST(SolidsOfASurface, AreNumberedByVolumeWithTheirCavities) {
  const auto formula = [](const Vec3& p) {
    double all = std::numeric_limits<double>::infinity();
    for (int n = 0; n < 3; ++n) {
      const Vec3 at{12.0 * n, 0.5 * n, 0.0};
      const double outer = 3.0 + n;
      // Two cavities side by side: the line from the left one meets the right one first.
      double solid = Ball{at, outer}.distance(p);
      solid = std::max(solid, -Ball{at - Vec3{1.2, 0.0, 0.0}, 0.8}.distance(p));
      solid = std::max(solid, -Ball{at + Vec3{1.2, 0.1, 0.0}, 0.8}.distance(p));
      all = std::min(all, solid);
    }
    return all;
  };
  const Box3 box{{-3.0, -6.0, -5.0}, {29.0, 6.0, 5.0}};
  const TriangleMesh surface =
      extract_surface(Clay::from_distance(formula, box, {0.25, 0.1}).value());
  const SurfaceSolids solids = solids_of(surface);
  ASSERT_EQ(solids.volume_mm3.size(), 3U);
  for (std::size_t n = 0; n < 3; ++n) {
    const double wanted =
        Ball{{}, 5.0 - static_cast<double>(n)}.volume_mm3() - 2.0 * Ball{{}, 0.8}.volume_mm3();
    EXPECT_NEAR(solids.volume_mm3[n], wanted, 0.02 * wanted);
  }
  for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
    const double x = surface.positions[surface.triangles[n][0]].x;
    EXPECT_EQ(solids.of_triangle[n], 2U - static_cast<std::uint32_t>(std::lround(x / 12.0)));
  }
}

TEST(SculptureGolden, PartsAndSizeHaveTheSameBitsForAnyThreadCount) {
  const Clay clay = clay_of_balls({{{}, 4.0}, {{7.4, 0.0, 0.0}, 3.0}, {{0.0, 7.0, 2.0}, 2.5}});
  std::uint64_t wanted = 0;
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Sculpture sculpture(copy_of(clay));
    ASSERT_TRUE(sculpture.apply(ScalePiece{"Clay", 1.7, Vec3{1.0, 0.0, 0.0}}));
    ASSERT_TRUE(sculpture.apply(SplitPiece{"Clay"}));
    ASSERT_EQ(sculpture.piece_count(), 3U);
    if (wanted == 0) wanted = sculpture.hash();
    EXPECT_EQ(sculpture.hash(), wanted) << threads;
  }
}

}  // namespace
}  // namespace argil
