// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/print_preparation.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/import.h"
#include "argil/mesh/print_orientation.h"

#include "support/profile_solids.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kPi = std::numbers::pi;

Clay clay_of(const TriangleMesh& mesh, double voxel_mm) {
  ClayOptions options;
  options.voxel_mm = voxel_mm;
  options.edge_radius_mm = 0.0;
  auto made = import_mesh(mesh, options);
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  return std::move(made.value().clay);
}

PrintPreparation prepared(const Clay& clay, const PreparationOptions& options) {
  auto made = prepare_print(clay, options);
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  return made ? std::move(made).value() : PrintPreparation{};
}

PreparationOptions standing() {
  PreparationOptions options;
  options.up = Vec3{0.0, 0.0, 1.0};
  options.base = PrintBase::none;
  return options;
}

mesh::Printer resin_printer() {
  mesh::Printer printer;
  printer.bed_mm = {100.0, 100.0, 100.0};
  printer.needs_drains = true;
  return printer;
}

TEST(PrintPreparation, LaysATOnItsSideInTheMiddleOfTheBed) {
  PreparationOptions options;
  options.printer.bed_mm = {100.0, 80.0, 100.0};
  const PrintPreparation made = prepared(clay_of(test::letter_t(), 0.25), options);
  ASSERT_THAT(made.pieces, SizeIs(1));
  EXPECT_THAT(made.orientations, SizeIs(3));
  EXPECT_EQ(made.cut_mm, 0.0);  // it stands firmly on that side
  const Box3 box = bounds(made.pieces[0].mesh);
  EXPECT_NEAR(box.min.z, 0.0, 1e-5);
  EXPECT_NEAR(box.max.z, 8.0, 0.05);
  EXPECT_NEAR(box.center().x, 50.0, 1e-4);
  EXPECT_NEAR(box.center().y, 40.0, 1e-4);
  EXPECT_TRUE(made.is_printable());
  EXPECT_NEAR(made.pieces[0].verdict.volume_mm3, (10.0 * 20.0 + 30.0 * 10.0) * 8.0, 40.0);
}

TEST(PrintPreparation, CutsAFlatBaseWhereABallTouchesInAPoint) {
  const PrintPreparation made = prepared(clay_of(test::ball_mesh(20.0, 5), 0.5), {});
  EXPECT_GT(made.cut_mm, 0.0);
  EXPECT_LE(made.cut_mm, 0.05 * 40.0 + 1e-9);
  const mesh::BedContact contact = mesh::bed_contact(made.pieces.at(0).mesh, 0.0);
  EXPECT_NEAR(contact.area_mm2, kPi * (400.0 - std::pow(20.0 - made.cut_mm, 2)), 8.0);
  EXPECT_NEAR(contact.area_mm2, made.chosen.contact_mm2, 8.0);
}

TEST(PrintPreparation, CutsAsMuchAsItIsTold) {
  PreparationOptions options = standing();
  options.base = PrintBase::cut;
  options.cut_mm = 20.0;
  const PrintPreparation made = prepared(clay_of(test::letter_t(), 0.25), options);
  EXPECT_NEAR(bounds(made.pieces.at(0).mesh).size().z, 10.0, 0.06);
}

TEST(PrintPreparation, LaysAConeOnItsSide) {
  PreparationOptions options = standing();
  options.up = Vec3{0.0, 0.1, 1.0};
  options.base = PrintBase::lay;
  const auto cone = test::revolved({{0.001, 0, 0}, {8, 0, 40}, {0.001, 0, 40}}, 64);
  const PrintPreparation made = prepared(clay_of(cone, 0.25), options);
  EXPECT_NEAR(bounds(made.pieces.at(0).mesh).size().z, 16.0 * std::cos(std::atan2(8.0, 40.0)), 0.3);
}

TEST(PrintPreparation, DrainsAHollowBallAtItsLowestPlace) {
  PreparationOptions options = standing();
  options.printer = resin_printer();
  options.wall_mm = 2.0;
  const PrintPreparation made = prepared(clay_of(test::ball_mesh(20.0, 5), 0.5), options);
  ASSERT_THAT(made.holes, SizeIs(2));
  EXPECT_FALSE(made.holes[0].is_for_air);
  EXPECT_NEAR(made.holes[0].mouth_mm.z, 0.0, 0.5);
  EXPECT_NEAR(made.holes[0].inward.z, 1.0, 1e-9);
  EXPECT_TRUE(made.holes[1].is_for_air);
  EXPECT_NEAR(made.holes[1].mouth_mm.z, 40.0, 0.5);
  EXPECT_THAT(made.pieces.at(0).pockets, IsEmpty());
  EXPECT_EQ(made.pieces[0].verdict.cavities, 0);
  EXPECT_TRUE(made.is_printable());
  const double shell = 4.0 / 3.0 * kPi * (8000.0 - 5832.0);
  EXPECT_NEAR(made.pieces[0].verdict.volume_mm3, shell - 2 * 2.0 * kPi * 1.5 * 1.5, 0.01 * shell);
}

/// Of a flat floor in its middle, where no thin wall is left beside the hole.
TEST(PrintPreparation, DrainsAFlatFloorInItsMiddle) {
  PreparationOptions options = standing();
  options.printer = resin_printer();
  options.printer.min_wall_mm = 0.8;
  options.wall_mm = 2.0;
  const PrintPreparation made = prepared(clay_of(test::box_mesh({20.0, 30.0, 20.0}), 0.4), options);
  ASSERT_THAT(made.holes, SizeIs(2));
  EXPECT_NEAR(made.holes[0].mouth_mm.x, 50.0, 2.0);
  EXPECT_NEAR(made.holes[0].mouth_mm.y, 50.0, 2.0);
  EXPECT_THAT(made.pieces.at(0).pockets, IsEmpty());
  EXPECT_TRUE(made.is_printable());
}

/// Two balls joined by a bar: the cavity has two lows, and both are drained.
TEST(PrintPreparation, DrainsEachLowOfACavity) {
  const TriangleMesh dumbbell =
      test::joined(test::joined(test::ball_mesh(12.0, 5, {-18.0, 0.0, 0.0}),
                                test::ball_mesh(10.0, 5, {18.0, 0.0, 0.0})),
                   test::box_mesh({36.0, 10.0, 10.0}));
  PreparationOptions options = standing();
  options.wall_mm = 2.0;
  const PrintPreparation made = prepared(clay_of(dumbbell, 0.5), options);
  ASSERT_THAT(made.holes, SizeIs(2));  // no resin, no air
  EXPECT_NEAR(std::abs(made.holes[0].mouth_mm.x - made.holes[1].mouth_mm.x), 36.0, 1.5);
  EXPECT_THAT(made.pieces.at(0).pockets, IsEmpty());
}

/// Two columns that meet in a neck hardly wider than two walls: by the wall that is asked for their
/// cavities would leave a film there.
TEST(PrintPreparation, ThickensAWallThatWouldLeaveAFilm) {
  const double half_neck = 2.18;
  const double apart = std::sqrt(64.0 - half_neck * half_neck);
  TriangleMesh left = test::revolved({{0.001, 0, -6}, {8, 0, -6}, {8, 0, 6}, {0.001, 0, 6}}, 128);
  TriangleMesh right = left;
  for (Vec3& p : left.positions) p.x -= apart;
  for (Vec3& p : right.positions) p.x += apart;
  const Clay columns = clay_of(test::joined(left, right), 0.2);
  PreparationOptions options = standing();
  options.printer = resin_printer();
  options.wall_mm = 2.0;
  EXPECT_EQ(prepared(columns, options).wall_mm, 2.0);  // the printer takes any film
  options.printer.min_wall_mm = 0.5;
  const PrintPreparation made = prepared(columns, options);
  EXPECT_GT(made.wall_mm, 2.0);
  EXPECT_LE(made.wall_mm, 2.2);
  EXPECT_TRUE(made.is_printable());
}

TEST(PrintPreparation, TellsOfABowlThatKeepsResin) {
  PreparationOptions options = standing();
  options.printer = resin_printer();
  const PrintPreparation made = prepared(clay_of(test::cup(), 0.5), options);
  ASSERT_THAT(made.pieces.at(0).pockets, SizeIs(1));
  EXPECT_FALSE(made.pieces[0].pockets[0].closed);
  EXPECT_NEAR(made.pieces[0].pockets[0].volume_mm3, kPi * 18.0 * 18.0 * 28.0, 500.0);
}

TEST(PrintPreparation, FillsCavitiesTooSmallForADrain) {
  const TriangleMesh with_bubbles =
      test::joined(test::box_mesh({20.0, 20.0, 20.0}),
                   test::joined(test::inside_out(test::ball_mesh(1.2, 3, {4.0, 0.0, 0.0})),
                                test::inside_out(test::ball_mesh(3.0, 4, {-4.0, 0.0, 0.0}))));
  PreparationOptions options = standing();
  options.printer = resin_printer();
  const PrintPreparation made = prepared(clay_of(with_bubbles, 0.2), options);
  EXPECT_EQ(made.pieces.at(0).filled_cavities, 1);
  EXPECT_EQ(made.pieces[0].verdict.cavities, 1);
  EXPECT_FALSE(made.is_printable());
}

/// A block of 150 x 30 x 30 for a bed of 100: two halves with two plugs, each on its cut face.
class LongBlock : public testing::Test {
 protected:
  PrintPreparation in_pieces(double tolerance_mm) const {
    PreparationOptions options = standing();
    options.printer.bed_mm = {100.0, 100.0, 100.0};
    options.fits_bed = true;
    options.plug_tolerance_mm = tolerance_mm;
    return prepared(clay_of(test::box_mesh({150.0, 30.0, 30.0}), 0.5), options);
  }
};

TEST_F(LongBlock, BecomesTwoHalvesOnTheirCutFacesWithPlugs) {
  const PrintPreparation made = in_pieces(0.15);
  ASSERT_THAT(made.pieces, SizeIs(3));
  EXPECT_EQ(made.pieces[0].name, "piece 1");
  EXPECT_EQ(made.pieces[2].name, "plugs");
  EXPECT_EQ(made.plugs, 2);
  EXPECT_EQ(made.joints_without_plug, 0);
  EXPECT_TRUE(made.is_printable());
  const double r = made.plug_radius_mm;
  const double hole = kPi * (r + 0.15) * (r + 0.15) * (2.0 * r + 0.15);
  for (const std::size_t half : {0U, 1U}) {
    EXPECT_NEAR(bounds(made.pieces[half].mesh).size().z, 75.0, 0.05);
    EXPECT_NEAR(made.pieces[half].verdict.volume_mm3, 75.0 * 900.0 - 2.0 * hole, 140.0);
    // The holes are in the face that lies on the bed.
    EXPECT_NEAR(mesh::bed_contact(made.pieces[half].mesh, 0.5).area_mm2,
                900.0 - 2.0 * kPi * (r + 0.15) * (r + 0.15), 3.0);
    EXPECT_NEAR(mesh::bed_contact(made.pieces[half].mesh, 70.0).area_mm2, 900.0, 1.0);
  }
}

TEST_F(LongBlock, HasHolesThatLeaveTheToleranceAroundThePlugs) {
  const PrintPreparation tight = in_pieces(0.0);
  const PrintPreparation loose = in_pieces(0.4);
  const double r = tight.plug_radius_mm;
  ASSERT_EQ(loose.plug_radius_mm, r);
  // 5 mm deep in the holes, where their mouths are not rounded.
  const auto hole_radius = [](const PrintPreparation& made) {
    const double solid = mesh::bed_contact(made.pieces.at(0).mesh, 5.0).area_mm2;
    return std::sqrt((900.0 - solid) / (2.0 * kPi));
  };
  EXPECT_NEAR(hole_radius(tight), r, 0.03);
  EXPECT_NEAR(hole_radius(loose), r + 0.4, 0.03);
  const Box3 plugs = bounds(loose.pieces.at(2).mesh);
  EXPECT_NEAR(plugs.size().z, 4.0 * r, 1e-5);
  EXPECT_NEAR(plugs.size().y, 2.0 * r, 1e-5);
}

TEST(PrintPreparation, CutsAlongSeveralAxes) {
  PreparationOptions options = standing();
  options.printer.bed_mm = {50.0, 50.0, 50.0};
  options.fits_bed = true;
  const PrintPreparation made = prepared(clay_of(test::box_mesh({80.0, 80.0, 80.0}), 1.0), options);
  ASSERT_THAT(made.pieces, SizeIs(9));
  EXPECT_EQ(made.plugs, 24);
  double volume = 0.0;
  for (std::size_t i = 0; i < 8; ++i) {
    volume += made.pieces[i].verdict.volume_mm3;
    EXPECT_TRUE(made.pieces[i].verdict.printable);
  }
  const double r = made.plug_radius_mm;
  const double hole = kPi * (r + 0.15) * (r + 0.15) * (2.0 * r + 0.15);
  EXPECT_NEAR(volume, 512'000.0 - 48.0 * hole, 0.003 * 512'000.0);
}

/// A U whose legs are cut off: the upper half is in two.
TEST(PrintPreparation, MakesAPieceOfEachBodyThatACutParts) {
  PreparationOptions options = standing();
  options.printer.bed_mm = {60.0, 60.0, 30.0};
  options.fits_bed = true;
  const TriangleMesh u = test::extruded({{0, 0, 0},
                                         {50, 0, 0},
                                         {50, 0, 50},
                                         {35, 0, 50},
                                         {35, 0, 15},
                                         {15, 0, 15},
                                         {15, 0, 50},
                                         {0, 0, 50}},
                                        15.0);
  const PrintPreparation made = prepared(clay_of(u, 0.5), options);
  ASSERT_THAT(made.pieces, SizeIs(4));
  EXPECT_EQ(made.pieces[3].name, "plugs");
  for (const PreparedPiece& piece : made.pieces) {
    EXPECT_EQ(piece.verdict.components, piece.name == "plugs" ? made.plugs : 1) << piece.name;
    EXPECT_THAT(piece.islands, IsEmpty()) << piece.name;
  }
}

TEST(PrintPreparation, RefusesWhatItCannotDo) {
  const Clay clay = clay_of(test::box_mesh({20.0, 20.0, 20.0}), 0.5);
  PreparationOptions no_bed = standing();
  no_bed.fits_bed = true;
  EXPECT_THAT(prepare_print(clay, no_bed).error().message, HasSubstr("bed"));
  PreparationOptions thin = standing();
  thin.wall_mm = 0.6;  // below three voxels
  EXPECT_THAT(prepare_print(clay, thin).error().message, HasSubstr("hollow"));
  PreparationOptions no_up = standing();
  no_up.up = Vec3{};
  EXPECT_EQ(prepare_print(clay, no_up).error().kind, ErrorKind::bad_input);
  PreparationOptions all = standing();
  all.base = PrintBase::cut;
  all.cut_mm = 30.0;
  EXPECT_THAT(prepare_print(clay, all).error().message, HasSubstr("base"));
}

TEST(PrintPreparation, EndsWhenItIsInterrupted) {
  const Clay clay = clay_of(test::ball_mesh(10.0, 4), 0.5);
  const std::uint64_t hash = clay.hash();
  for (const double at : {0.02, 0.3, 0.52, 0.7, 0.9}) {
    PreparationOptions options;
    options.wall_mm = 2.0;
    if (at > 0.5) options.up = Vec3{0.0, 0.0, 1.0};  // the search is over by then
    const auto stopped =
        prepare_print(clay, options, [&](std::string_view, double f) { return f < at; });
    ASSERT_FALSE(stopped) << at;
    EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted) << at;
  }
  EXPECT_EQ(clay.hash(), hash);
}

TEST(PrintPreparationGolden, GivesTheSameBitsForAnyThreadCount) {
  const Clay clay = clay_of(test::letter_t(), 0.4);
  PreparationOptions options;
  options.up = Vec3{0.3, 0.2, 1.0};
  options.wall_mm = 1.6;
  options.drain_radius_mm = 1.0;
  const PrintPreparation all = prepared(clay, options);
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const PrintPreparation again = prepared(clay, options);
    EXPECT_EQ(again.chosen.up, all.chosen.up);
    EXPECT_EQ(again.pieces.at(0).mesh.positions, all.pieces.at(0).mesh.positions);
    EXPECT_EQ(again.pieces[0].mesh.triangles, all.pieces[0].mesh.triangles);
  }
}

}  // namespace
}  // namespace argil::io
