// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/mesh/print_orientation.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "support/profile_solids.h"
#include "support/shapes.h"

namespace argil::mesh {
namespace {

using test::box_mesh;
using test::letter_t;
using testing::SizeIs;

const Progress kSearchProgress;

PrintOrientation orientation_of(const TriangleMesh& mesh, const Vec3& up,
                                const OrientationOptions& options = {}) {
  return orientation_at(mesh, up, options, Pace(kSearchProgress, "orient"));
}

std::vector<PrintOrientation> best_of(const TriangleMesh& mesh) {
  return best_orientations(mesh, {}, 3, Pace(kSearchProgress, "orient"));
}

TEST(OrientationAt, MeasuresATThatStands) {
  const PrintOrientation standing = orientation_of(letter_t(), {0.0, 0.0, 1.0});
  EXPECT_NEAR(standing.overhang_mm2, 2 * 10.0 * 8.0, 1e-9);
  EXPECT_NEAR(standing.support_mm3, 2 * 10.0 * 8.0 * 20.0, 0.05 * 3200.0);
  EXPECT_NEAR(standing.height_mm, 30.0, 1e-9);
  EXPECT_NEAR(standing.contact_mm2, 80.0, 1e-9);
  EXPECT_NEAR(standing.footing_mm, 4.0, 1e-9);
  // Both arms' undersides are seen, from some sides but not through the stem.
  EXPECT_GT(standing.scars_mm2, 0.3 * standing.overhang_mm2);
  EXPECT_LT(standing.scars_mm2, standing.overhang_mm2);
}

TEST(OrientationAt, SeesThatAnOverturnedTNeedsNoSupport) {
  const PrintOrientation overturned = orientation_of(letter_t(), {0.0, 0.0, -1.0});
  EXPECT_EQ(overturned.overhang_mm2, 0.0);
  EXPECT_EQ(overturned.support_mm3, 0.0);
  EXPECT_NEAR(overturned.contact_mm2, 30.0 * 8.0, 1e-9);
}

TEST(OrientationAt, MeasuresContactAtTheCut) {
  OrientationOptions options;
  options.cut_mm = 2.0;
  const PrintOrientation cut = orientation_of(test::ball_mesh(10.0, 5), {0.0, 0.0, 1.0}, options);
  EXPECT_NEAR(cut.contact_mm2, 3.14159 * (100.0 - 64.0), 0.5);
  EXPECT_NEAR(cut.footing_mm, 6.0, 0.05);
  EXPECT_NEAR(cut.height_mm, 18.0, 1e-9);
}

TEST(OrientationAt, CountsWhatSupportsStandOn) {
  // A slab above another: the lower one bears the supports of the upper.
  const TriangleMesh table = test::extruded({{0, 0, 0},
                                             {30, 0, 0},
                                             {30, 0, 4},
                                             {4, 0, 4},
                                             {4, 0, 14},
                                             {30, 0, 14},
                                             {30, 0, 18},
                                             {0, 0, 18}},
                                            20.0);
  const PrintOrientation found = orientation_of(table, {0.0, 0.0, 1.0});
  EXPECT_NEAR(found.overhang_mm2, 26.0 * 20.0, 1e-9);
  EXPECT_NEAR(found.support_mm3, 26.0 * 20.0 * 10.0, 0.05 * 5200.0);
}

TEST(BestOrientations, LayATOnItsSide) {
  const auto found = best_of(letter_t());
  ASSERT_THAT(found, SizeIs(3));
  EXPECT_NEAR(std::abs(found[0].up.y), 1.0, 1e-9);
  EXPECT_NEAR(found[0].height_mm, 8.0, 1e-9);
  EXPECT_EQ(found[0].overhang_mm2, 0.0);
  EXPECT_LE(found[0].cost, found[1].cost);
  EXPECT_LE(found[1].cost, found[2].cost);
}

TEST(BestOrientations, StandACupOnItsFloorOrRim) {
  const auto found = best_of(test::cup());
  EXPECT_NEAR(std::abs(found.at(0).up.z), 1.0, 1e-6);
  EXPECT_LT(found[0].overhang_mm2, 1.0);
}

TEST(BestOrientations, FindAFlatSideThatIsAskew) {
  // A dome: half a ball whose flat side faces some odd way.
  TriangleMesh dome = test::ball_mesh(10.0, 4);
  for (Vec3& p : dome.positions) p.z = std::max(p.z, 0.0);
  const Vec3 odd = normalized(Vec3{0.3, -0.5, 0.7});
  for (Vec3& p : dome.positions) p = rotate(conjugate(turn_up(odd)), p);
  const auto found = best_of(dome);
  EXPECT_GT(dot(found.at(0).up, odd), 0.99999);
  EXPECT_NEAR(found[0].contact_mm2, 314.0, 6.0);
}

TEST(BestOrientationsGolden, GivesTheSameBitsForAnyThreadCount) {
  const TriangleMesh mesh = letter_t();
  const auto all = best_of(mesh);
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto again = best_of(mesh);
    ASSERT_EQ(again.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_EQ(again[i].up, all[i].up);
      EXPECT_EQ(again[i].cost, all[i].cost);
    }
  }
}

TEST(LaidFlat, RollsUntilTheCentreIsAboveTheContact) {
  // A box on its corner comes to lie on one of its sides; one on its small end stays there.
  const TriangleMesh box = box_mesh({10.0, 20.0, 40.0});
  const Vec3 rested = laid_flat(box, normalized(Vec3{1.0, 0.2, 0.3}));
  EXPECT_NEAR(std::max({std::abs(rested.x), std::abs(rested.y), std::abs(rested.z)}), 1.0, 1e-12);
  EXPECT_EQ(rested.x, 1.0);
  EXPECT_EQ(laid_flat(box, {0.0, 0.0, 1.0}), (Vec3{0.0, 0.0, 1.0}));
}

TEST(LaidFlat, LaysAStandingConeOnItsSide) {
  const TriangleMesh cone = test::revolved({{0.001, 0, 0}, {5, 0, 40}, {0.001, 0, 40}}, 64);
  const Vec3 rested = laid_flat(cone, normalized(Vec3{0.0, 0.1, 1.0}));
  // Half of its opening angle from the horizontal, the tip level with the rim.
  EXPECT_NEAR(rested.z, std::sin(std::atan2(5.0, 40.0)), 0.01);
}

TEST(TurnUp, BringsItsDirectionToZ) {
  for (const Vec3& up : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{0.6, 0.0, -0.8}}) {
    const Vec3 turned = rotate(turn_up(up), up);
    EXPECT_NEAR(turned.z, 1.0, 1e-12);
  }
}

TEST(BedContact, IsThatOfWhatStands) {
  const BedContact stem = bed_contact(letter_t(), 0.0);
  EXPECT_NEAR(stem.area_mm2, 80.0, 1e-9);
  EXPECT_NEAR(stem.footing_mm, 4.0, 1e-9);
  EXPECT_NEAR(bed_contact(letter_t(), 20.5).area_mm2, 240.0, 1e-9);
}

}  // namespace
}  // namespace argil::mesh
