// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/pick.h"
#include "argil/engine/surface.h"

#include "brush/displace.h"
#include "support/alpha_maker.h"
#include "support/effort.h"
#include "support/measure/mesh_topology.h"
#include "support/stroke_maker.h"

namespace argil {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string out;
  for (const auto& line : lines) out += line + "\n";
  return out;
}

Clay ball(double radius_mm, double voxel_mm) {
  return Clay::ball(radius_mm, ClayOptions{.voxel_mm = voxel_mm}).value();
}

/// A ball whose every part is kept at the finest level: bumps of ten voxels' wavelength.
Clay bumpy_ball(double radius_mm, double voxel_mm, double height_mm) {
  const double k = 2.0 * 3.14159265358979 / (10.0 * voxel_mm);
  Box3 box;
  box.include(Vec3{-radius_mm, -radius_mm, -radius_mm} * 1.1);
  box.include(Vec3{radius_mm, radius_mm, radius_mm} * 1.1);
  return Clay::from_distance(
             [=](const Vec3& p) {
               return length(p) - radius_mm -
                      height_mm * std::sin(k * p.x) * std::sin(k * p.y) * std::sin(k * p.z);
             },
             box, ClayOptions{.voxel_mm = voxel_mm})
      .value();
}

/// Where a ray along -x first meets the clay; NaN when it does not.
double height_at(const Clay& clay, double y, double z) {
  const auto hit = pick(clay, Ray{{100.0, y, z}, {-1.0, 0.0, 0.0}});
  return hit.ok() && hit.value() ? hit.value()->point_mm.x : std::nan("");
}

// ---- every action ------------------------------------------------------------------------------

class AnyActionProperty : public testing::TestWithParam<int> {};

TEST_P(AnyActionProperty, KeepsEveryInvariantOneClosedSurfaceAndTheWayBack) {
  constexpr int kSequences = 6;
  for (int n = 0; n < test::effort(1, kSequences); ++n) {
    const auto seed = static_cast<std::uint32_t>(7000 + GetParam() * kSequences + n);
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    Clay clay = random_start(random);
    const std::uint64_t start = clay.hash();
    Surface surface;
    surface.update(clay);
    for (int i = 0; i < 4; ++i) {
      Stroke stroke = random_dab(random, 10.0);
      stroke.tool.action = kActionInfos[random() % kActionCount].action;
      stroke.tool.strength = std::abs(stroke.tool.strength);
      if (is_signed(stroke.tool.action) && random() % 2 == 0) stroke.tool.strength *= -1.0;
      const auto falloff = static_cast<Falloff>(random() % kFalloffNames.size());
      if (takes(stroke.tool.action, falloff)) stroke.tool.falloff = falloff;
      if (stroke.tool.action == Action::emboss) {
        stroke.tool.alpha = test::letter_image();
        stroke.tool.alpha_mode = static_cast<AlphaMode>(i % 3);
      }
      stroke.tool.pressure_to_size = random() % 2 == 0 ? 0.0 : 0.7;
      stroke.samples[0].pressure = 0.3 + 0.1 * static_cast<double>(random() % 8);
      if (random() % 4 == 0) stroke.radial = {static_cast<int>(2 + random() % 4), random() % 3};
      if (random() % 4 == 0) {
        ASSERT_TRUE(clay.apply(static_cast<MaskEdit>(random() % 4)).ok());
      }
      SCOPED_TRACE("stroke " + std::to_string(i) + ": " + describe(stroke));
      const std::uint64_t before = clay.hash();
      ASSERT_TRUE(clay.apply(stroke).ok());
      ASSERT_EQ(joined(clay.validate()), "");
      surface.update(clay);
      const TriangleMesh mesh = surface.weld();
      ASSERT_EQ(test::find_mesh_faults(mesh), test::MeshFaults{});
      ASSERT_EQ(mesh.positions, extract_surface(clay).positions);
      const std::uint64_t after = clay.hash();
      ASSERT_TRUE(clay.undo());
      ASSERT_EQ(clay.hash(), before);
      ASSERT_TRUE(clay.redo());
      ASSERT_EQ(clay.hash(), after);
    }
    while (clay.undo()) {
    }
    ASSERT_EQ(clay.hash(), start);
  }
}
INSTANTIATE_TEST_SUITE_P(Clay, AnyActionProperty, testing::Range(0, 20));

TEST(AnchoredStroke, EndsTheSameInPiecesAndInOne) {
  for (const ActionInfo& info : kActionInfos) {
    if (info.kind != ActionKind::anchored) continue;
    const Stroke stroke =
        stroke_of(info.action, 4.0, 0.9, {{9, 0, 0}, {9.5, 1, 0}, {11, 2, 1}, {12, 2, 2}});
    Clay whole = bumpy_ball(9.0, 0.5, 0.2);
    Clay pieces = bumpy_ball(9.0, 0.5, 0.2);
    ASSERT_TRUE(whole.apply(stroke).ok());
    ASSERT_TRUE(pieces.begin_stroke(stroke.tool, stroke).ok());
    for (const StrokeSample& sample : stroke.samples) {
      ASSERT_TRUE(pieces.extend_stroke({&sample, 1}).ok());
    }
    ASSERT_TRUE(pieces.end_stroke().ok());
    EXPECT_EQ(pieces.hash(), whole.hash()) << info.name;
  }
}

/// Until it ends, each piece is resampled from what the one before left.
TEST(AnchoredStroke, LooksInPiecesMuchAsItEnds) {
  for (const Action action : {Action::grab, Action::twist, Action::elastic, Action::slide}) {
    // A dab a millimetre: next to nothing is left for the end.
    const Stroke stroke = stroke_of(
        action, 4.0, 0.9, {{9, 0, 0}, {10.001, 0, 0}, {10.001, 1.001, 0}, {10.001, 1.001, 1.001}});
    Clay clay = bumpy_ball(9.0, 0.25, 0.1);
    ASSERT_TRUE(clay.begin_stroke(stroke.tool, stroke).ok());
    for (const StrokeSample& sample : stroke.samples) {
      ASSERT_TRUE(clay.extend_stroke({&sample, 1}).ok());
    }
    const std::vector<Vec3> shown = extract_surface(clay).positions;
    ASSERT_TRUE(clay.end_stroke().ok());
    std::vector<double> apart;
    for (const Vec3& point : shown) {
      if (length(point - Vec3{10, 1, 1}) < 5.0) apart.push_back(std::abs(clay.distance_at(point)));
    }
    std::sort(apart.begin(), apart.end());
    ASSERT_GT(apart.size(), 1000U);
    RecordProperty("p95_" + std::to_string(static_cast<int>(action)),
                   std::to_string(apart[apart.size() * 95 / 100] / 0.25));
    EXPECT_LT(apart[apart.size() * 95 / 100], 0.25 * 0.25) << "a quarter of a voxel";
  }
}

TEST(DisplaceStep, GoesEquallyFarEachTimeAndAsFarAsAskedInAll) {
  for (const float part : {0.0F, 0.25F, 0.8F, 1.0F}) {
    float left = 1.0F;
    for (int at = 0; at < 5; ++at) {
      const float gone = left * DisplaceStep{at, 5}.part_of(part);
      EXPECT_LT(std::abs(gone - part / 5.0F), 1e-6F);
      left -= gone;
    }
    EXPECT_LT(std::abs(left - (1.0F - part)), 1e-6F);
  }
  EXPECT_EQ(DisplaceStep{}.part_of(0.3F), 0.3F);
}

// ---- what each one does ------------------------------------------------------------------------

/// A dab fits its plane once, in however many steps of a fine lattice the surface goes there.
TEST(ActionFlatten, GoesOnceToAPlaneThatLiesFartherOut) {
  std::vector<double> rises;
  for (const double voxel : {0.5, 0.125}) {
    Clay clay = bumpy_ball(10.0, voxel, 0.3 * voxel);
    Stroke dab = stroke_of(Action::fill, 4.0, 0.5, {{10, 0, 0}});
    dab.tool.plane_offset = 0.5;
    ASSERT_TRUE(clay.apply(dab).ok());
    rises.push_back(height_at(clay, 0, 0) - height_at(bumpy_ball(10.0, voxel, 0.3 * voxel), 0, 0));
    std::printf("voxel %g: %.3f mm\n", voxel, rises.back());
  }
  EXPECT_NEAR(rises[1], rises[0], 0.1 * rises[0]);
}

TEST(ActionFlatten, DrawsTheSurfaceToAPlaneAndScrapeAndFillOnlyHalfOfIt) {
  const Clay before = ball(20.0, 0.25);
  const double cap = height_at(before, 0, 0) - height_at(before, 3.0, 0);  // of the ball, .226
  for (const Action action : {Action::flatten, Action::scrape, Action::fill}) {
    Clay clay = ball(20.0, 0.25);
    const std::vector<Vec3> still(12, Vec3{20, 0, 0});
    for (const Vec3& place : still) {
      ASSERT_TRUE(clay.apply(stroke_of(action, 8.0, 1.0, {place})).ok());
    }
    const double middle = height_at(clay, 0, 0);
    const double beside = height_at(clay, 3.0, 0);
    EXPECT_EQ(joined(clay.validate()), "");
    if (action != Action::fill) {
      EXPECT_LT(middle, 20.0 - 0.2) << static_cast<int>(action);
    }
    if (action == Action::fill) {
      EXPECT_NEAR(middle, 20.0, 0.05);
    }
    if (action == Action::flatten) {
      EXPECT_LT(std::abs(middle - beside), 0.25 * cap);
    }
    // Scrape adds nothing, fill takes nothing away, to a tenth of the tool's voxel (1 mm here):
    // what is drawn again is drawn on its level.
    for (double y = -9.0; y <= 9.0; y += 0.5) {
      const double change = height_at(clay, y, 0.3) - height_at(before, y, 0.3);
      if (action == Action::scrape) {
        EXPECT_LT(change, 0.1) << y;
      }
      if (action == Action::fill) {
        EXPECT_GT(change, -0.1) << y;
      }
    }
  }
}

TEST(ActionFlatten, LeavesTheBackOfAThinWall) {
  Clay clay = Clay::block({3, 30, 30}, ClayOptions{.voxel_mm = 0.25}).value();
  ASSERT_TRUE(clay.apply(stroke_of(Action::carve, 3.0, 1.0, {{3.9, 0, 0}})).ok());
  ASSERT_TRUE(clay.apply(stroke_of(Action::fill, 5.0, 1.0, {{1.5, 0, 0}, {1.5, 3, 0}})).ok());
  for (double y = -6.0; y <= 6.0; y += 0.5) {
    EXPECT_NEAR(clay.distance_at({-1.5, y, 0.0}), 0.0, 0.03) << y;
  }
}

/// A ball with a small knob beside the axis of the tool; where the knob's top is.
double knob_angle(const Clay& clay) {
  double best = 0.0;
  double angle = 0.0;
  for (double a = -1.5; a <= 1.5; a += 0.01) {
    const Vec3 along{std::cos(a), std::sin(a), 0.0};
    const auto hit = pick(clay, Ray{along * 40.0, -along});
    if (!hit.ok() || !hit.value()) continue;
    const double far = length(hit.value()->point_mm);
    if (far > best) {
      best = far;
      angle = a;
    }
  }
  return angle;
}

TEST(ActionPinch, MovesMatterTowardsTheAxisAndBack) {
  for (const double strength : {1.0, -1.0}) {
    Clay clay = ball(10.0, 0.2);
    ASSERT_TRUE(
        clay.apply(stroke_of(Action::add, 1.0, 1.0, {{10 * std::cos(0.2), 10 * std::sin(0.2), 0}}))
            .ok());
    const double start = knob_angle(clay);
    for (int i = 0; i < 6; ++i) {
      ASSERT_TRUE(clay.apply(stroke_of(Action::pinch, 5.0, strength, {{10, 0, 0}})).ok());
    }
    if (strength > 0.0) {
      EXPECT_LT(knob_angle(clay), start - 0.05);
    }
    if (strength < 0.0) {
      EXPECT_GT(knob_angle(clay), start + 0.05);
    }
  }
}

TEST(ActionGrab, TakesTheMiddleAlongAllOfItsWay) {
  Clay clay = ball(10.0, 0.2);
  ASSERT_TRUE(clay.apply(stroke_of(Action::grab, 5.0, 1.0, {{10, 0, 0}, {14, 0, 0}})).ok());
  EXPECT_NEAR(height_at(clay, 0, 0), 14.0, 0.1);
  EXPECT_NEAR(clay.distance_at({-10, 0, 0}), 0.0, 0.02);
  Clay in = ball(10.0, 0.2);
  ASSERT_TRUE(in.apply(stroke_of(Action::grab, 5.0, 1.0, {{10, 0, 0}, {7, 0, 0}})).ok());
  EXPECT_NEAR(height_at(in, 0, 0), 7.0, 0.1);
}

/// Matter that goes back leaves nothing behind on the coarser levels.
TEST(ActionGrab, LeavesNoGhostOfWhatItTookBack) {
  for (const double radius : {3.0, 6.0}) {
    Clay clay = ball(10.0, 0.2);
    const double far = 10.0 + 2.0 * radius;
    ASSERT_TRUE(clay.apply(stroke_of(Action::grab, radius, 1.0, {{10, 0, 0}, {far, 0, 0}})).ok());
    ASSERT_TRUE(clay.apply(stroke_of(Action::grab, radius, 1.0, {{far, 0, 0}, {10, 0, 0}})).ok());
    double most = 0.0;
    for (const Vec3& vertex : extract_surface(clay).positions) {
      most = std::max(most, std::abs(length(vertex) - 10.0));
    }
    EXPECT_LT(most, 0.1 * radius) << radius;
    EXPECT_EQ(joined(clay.validate()), "");
  }
}

/// A mask that the tool's box holds and the tool does not reach has matter moved point by point,
/// in doubles.
TEST(ActionGrab, MovesRowsOfNodesAsItMovesPoints) {
  const Stroke grab =
      stroke_of(Action::grab, 4.0, 1.0, {{10, 0, 0}, {11, 1.5, 0.5}, {11.5, 1, 2.5}});
  Clay by_rows = bumpy_ball(10.0, 0.25, 0.1);
  Clay by_points = bumpy_ball(10.0, 0.25, 0.1);
  ASSERT_TRUE(by_points.apply(stroke_of(Action::mask, 0.5, 1.0, {{6.6, -3.4, -3.4}})).ok());
  ASSERT_TRUE(by_rows.apply(grab).ok());
  ASSERT_TRUE(by_points.apply(grab).ok());
  EXPECT_GT(height_at(by_rows, 1.0, 2.5), 11.0);
  double apart = 0.0;
  for (const Vec3& vertex : extract_surface(by_rows).positions) {
    const double off = by_points.distance_at(vertex) - by_rows.distance_at(vertex);
    apart = std::max(apart, std::abs(off));
  }
  EXPECT_LT(apart, 0.0025) << "a hundredth of a voxel";
  EXPECT_GT(apart, 0.0) << "both were moved in the same way";
}

TEST(ActionTwist, TurnsTheMiddleByItsWayOverItsRadius) {
  Clay clay = ball(10.0, 0.2);
  // A knob on the x axis; the tool's z axis through the origin, large against the knob's distance.
  ASSERT_TRUE(clay.apply(stroke_of(Action::add, 1.0, 1.0, {{10, 0, 0}})).ok());
  const Stroke turn = stroke_of(Action::twist, 30.0, 0.5, {{0, 0, -3}, {0, 0, 3}});
  ASSERT_TRUE(clay.apply(turn).ok());
  const double r = 10.5 / 30.0;  // about the knob's middle
  const double falloff = (1.0 - r * r) * (1.0 - r * r);
  EXPECT_NEAR(knob_angle(clay), 0.5 * 6.0 / 30.0 * falloff, 0.02);
}

// ---- detail survives ---------------------------------------------------------------------------

/// Text-like: short strokes, up, down and across, 4 voxels wide, on the ball's +x side; a letter in
/// the middle and some to either side.
void engrave(Clay& clay, double radius_mm, int beside = 2) {
  for (int letter = -beside; letter <= beside; ++letter) {
    const double y = 2.4 * letter;
    const auto on_ball = [&](double dy, double z) {
      const double x = std::sqrt(radius_mm * radius_mm - (y + dy) * (y + dy) - z * z);
      return Vec3{x, y + dy, z};
    };
    const Stroke down = stroke_of(Action::carve, 0.4, 1.0, {on_ball(0, 1.5), on_ball(0, -1.5)});
    const Stroke bar = stroke_of(Action::carve, 0.4, 1.0, {on_ball(-0.7, 0.5), on_ball(0.7, 0.5)});
    ASSERT_TRUE(clay.apply(down).ok());
    ASSERT_TRUE(clay.apply(bar).ok());
  }
}

/// Depth of the groove of the letter in the middle, against clay without letters.
double groove_depth(const Clay& plain, const Clay& clay) {
  return height_at(plain, 0.0, -0.5) - height_at(clay, 0.0, -0.5);
}

TEST(DetailSurvives, ALargeMoveKeepsTheAmplitudeOfWhatItCarries) {
  Clay plain = ball(20.0, 0.1);
  Clay clay = ball(20.0, 0.1);
  engrave(clay, 20.0, test::effort(1, 2));
  const double before = groove_depth(plain, clay);
  ASSERT_GT(before, 0.25);
  // 100 finest voxels in radius, moved by 60.
  const Stroke move = stroke_of(Action::grab, 10.0, 1.0, {{20, 0, 0}, {26, 0, 0}});
  ASSERT_TRUE(plain.apply(move).ok());
  ASSERT_TRUE(clay.apply(move).ok());
  EXPECT_EQ(joined(clay.validate()), "");
  EXPECT_NEAR(height_at(clay, 1.0, -0.5), 26.0, 0.3);
  const double after = groove_depth(plain, clay);
  RecordProperty("amplitude_kept", std::to_string(after / before));
  std::printf("amplitude kept: %.3f\n", after / before);
  EXPECT_NEAR(after / before, 1.0, 0.1);
}

TEST(DetailSurvives, LargeEditsElsewhereLeaveItsBits) {
  Clay clay = ball(20.0, 0.1);
  engrave(clay, 20.0);
  std::vector<double> before;
  for (double y = -5.5; y <= 5.5; y += 0.05) {
    for (double z = -1.8; z <= 1.8; z += 0.05) {
      before.push_back(clay.distance_at({std::sqrt(400 - y * y - z * z), y, z}));
    }
  }
  ASSERT_TRUE(clay.apply(stroke_of(Action::grab, 8.0, 1.0, {{-20, 0, 0}, {-26, 0, 0}})).ok());
  ASSERT_TRUE(clay.apply(stroke_of(Action::smooth, 8.0, 1.0, {{0, 20, 0}, {0, 19, 5}})).ok());
  ASSERT_TRUE(clay.apply(stroke_of(Action::add, 6.0, 1.0, {{0, 0, 20}, {0, 8, 18}})).ok());
  std::size_t n = 0;
  for (double y = -5.5; y <= 5.5; y += 0.05) {
    for (double z = -1.8; z <= 1.8; z += 0.05) {
      ASSERT_EQ(clay.distance_at({std::sqrt(400 - y * y - z * z), y, z}), before[n++]);
    }
  }
}

/// Many faint dabs along one side of a plate: what is finer than the level that a copy came from
/// must not be averaged away, under the tool or beside it.
TEST(ThinWalls, OutlastManyFaintDabs) {
  constexpr double kVoxel = 0.2;
  const double way_mm = test::effort(2.5, 5.0);  // beyond what reaches the points looked at
  for (const Action action :
       {Action::smooth, Action::inflate, Action::flatten, Action::scrape, Action::fill}) {
    for (const double wall : test::effort<std::vector<double>>({0.6, 1.6}, {0.6, 0.8, 1.2, 1.6})) {
      const auto plate = [wall](const Vec3& p) {
        const Vec3 d{std::abs(p.x) - 0.5 * wall, std::abs(p.y) - 8.0, std::abs(p.z) - 8.0};
        const Vec3 out{std::max(d.x, 0.0), std::max(d.y, 0.0), std::max(d.z, 0.0)};
        return length(out) + std::min(0.0, std::max({d.x, d.y, d.z}));
      };
      Box3 box;
      box.include({-3, -9, -9});
      box.include({3, 9, 9});
      Clay clay = Clay::from_distance(plate, box, ClayOptions{.voxel_mm = kVoxel}).value();
      const double x = 0.5 * wall;
      Stroke stroke = stroke_of(action, 2.0, 0.02, {{x, 0, -way_mm}, {x, 0, way_mm}});
      stroke.spacing = 0.1;
      ASSERT_TRUE(clay.apply(stroke).ok());
      for (const double y : {0.0, 1.0, 3.0}) {
        const auto front = pick(clay, Ray{{30, y, 0}, {-1, 0, 0}});
        const auto back = pick(clay, Ray{{-30, y, 0}, {1, 0, 0}});
        ASSERT_TRUE(front.ok() && front.value() && back.ok() && back.value());
        const double left = front.value()->point_mm.x - back.value()->point_mm.x;
        EXPECT_NEAR(left, wall, 0.2 * kVoxel) << static_cast<int>(action) << " at y " << y;
      }
    }
  }
}

}  // namespace
}  // namespace argil
