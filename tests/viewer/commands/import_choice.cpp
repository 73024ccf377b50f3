// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/import_choice.h"

#include <gtest/gtest.h>

#include "commands/command.h"
#include "support/shapes.h"
#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

/// A box of 30 x 60 x 120, as a file without a unit.
MeshOffer box_offer() {
  MeshOffer offer;
  offer.file = "box.obj";
  offer.size_mm = {30.0, 60.0, 120.0};
  offer.outlook = io::ImportOutlook(test::box_mesh({30.0, 60.0, 120.0}));
  return offer;
}

ImportChoice filled(const MeshOffer& offer) {
  ImportChoice choice;
  fill(choice, offer);
  return choice;
}

TEST(ImportChoiceOf, ProposesWhatTheFileSaysAndAVoxelOfTwoDigits) {
  const MeshOffer offer = box_offer();
  const ImportChoice choice = filled(offer);
  EXPECT_EQ(choice.unit, io::LengthUnit::mm);
  EXPECT_EQ(choice.up, io::UpAxis::z);
  EXPECT_EQ(size_of(choice, offer), (Vec3{30.0, 60.0, 120.0}));
  EXPECT_DOUBLE_EQ(choice.voxel_mm, 0.47);  // 120 / 256
  ASSERT_EQ(choice.guesses.size(), 1U);
  EXPECT_EQ(choice.guesses[0], "Unit: the file names none, so mm.");
}

TEST(ImportChoiceOf, TakesTheGuessesOfTheReaderAndSaysSo) {
  MeshOffer offer = box_offer();
  offer.frame.unit_looks_like = io::LengthUnit::cm;
  offer.frame.up_looks_like = io::UpAxis::y;
  const ImportChoice choice = filled(offer);
  EXPECT_EQ(size_of(choice, offer), (Vec3{300.0, 1200.0, 600.0}));
  ASSERT_EQ(choice.guesses.size(), 2U);
  EXPECT_EQ(choice.guesses[0], "Unit: a guess by its size, cm.");
  EXPECT_EQ(choice.guesses[1], "Up: a guess by how it stands, y.");
}

TEST(ImportChoiceOf, OneSideTakesTheOthersWithIt) {
  const MeshOffer offer = box_offer();
  ImportChoice choice = filled(offer);
  set_size(choice, offer, 1, 30.0);
  EXPECT_EQ(size_of(choice, offer), (Vec3{15.0, 30.0, 60.0}));
  EXPECT_DOUBLE_EQ(choice.voxel_mm, 0.23);
  set_voxel(choice, 0.5);
  set_size(choice, offer, 2, 120.0);
  EXPECT_DOUBLE_EQ(choice.voxel_mm, 0.5) << "it was typed";
  EXPECT_EQ(request_of(choice, offer).how.preparation.size_mm, 0.0) << "as the file has it";
  // What nobody could import is not taken.
  set_size(choice, offer, 0, 0.0);
  EXPECT_NEAR(size_of(choice, offer).z, kLeastImportMm, 1e-12);
}

TEST(ImportChoiceOf, AnotherUnitIsAnotherSize) {
  const MeshOffer offer = box_offer();
  ImportChoice choice = filled(offer);
  set_size(choice, offer, 2, 50.0);
  set_unit(choice, offer, io::LengthUnit::in);
  EXPECT_NEAR(size_of(choice, offer).z, 120.0 * 25.4, 1e-9);
  const ImportMesh request = request_of(choice, offer);
  EXPECT_EQ(request.how.preparation.frame.unit, io::LengthUnit::in);
  EXPECT_EQ(request.how.preparation.size_mm, 0.0);
}

TEST(ImportChoiceOf, CostsMoreWithFinerVoxels) {
  const MeshOffer offer = box_offer();
  ImportChoice choice = filled(offer);
  const double usual = cost_of(choice, offer).vertices;
  set_voxel(choice, 0.5 * choice.voxel_mm);
  EXPECT_GT(cost_of(choice, offer).vertices, 1.5 * usual);
}

TEST_F(GesturesTest, AMeshIsAskedAboutAndAProjectIsNot) {
  open_file(folder_ / "m.stl", ui_, document_);
  EXPECT_EQ(open_dialog(ui_), Dialog::import_mesh);
  EXPECT_EQ(ui_.import.file, folder_ / "m.stl");
  key(kKeyEscape);
  EXPECT_EQ(open_dialog(ui_), Dialog::none);
  open_file(folder_ / "p.vdb", ui_, document_);
  EXPECT_EQ(open_dialog(ui_), Dialog::none);
}

}  // namespace
}  // namespace argil::viewer
