// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/piece_export.h"

#include <filesystem>
#include <memory>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/scratch.h"

namespace argil::io {
namespace {

using testing::HasSubstr;

/// A lid beside a pot, turned a quarter about x, and a hidden knob.
Sculpture pot() {
  Sculpture sculpture(Clay::block({12.0, 12.0, 8.0}, {}).value(), {"Pot"});
  AddPiece lid;
  lid.look.name = "Lid";
  lid.look.color = Rgb8{10, 200, 30};
  lid.look.placement = {{20.0, 3.0, 1.0}, normalized(Quat{1.0, 1.0, 0.0, 0.0})};
  lid.clay = std::make_shared<const Clay>(Clay::block({10.0, 10.0, 4.0}, {}).value());
  EXPECT_TRUE(sculpture.apply(lid).ok());
  AddPiece knob;
  knob.look.name = "Knob";
  knob.look.is_visible = false;
  knob.clay = std::make_shared<const Clay>(Clay::ball(3.0, {}).value());
  EXPECT_TRUE(sculpture.apply(knob).ok());
  return sculpture;
}

TEST(PieceExport, WritesVisiblePiecesByNameAndColourWhereTheyStand) {
  const test::ScratchFolder folder;
  const auto exported = export_pieces(folder / "pot.3mf", pot(), {});
  ASSERT_TRUE(exported.ok()) << exported.error().message;
  ASSERT_EQ(exported.value().size(), 2U);
  const auto read = read_assembly(folder / "pot.3mf");
  ASSERT_TRUE(read.ok());
  const Assembly& assembly = read.value().assembly;
  const std::vector<PlacedPart> parts = placed_parts(assembly);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].name, "Pot");
  EXPECT_EQ(parts[1].name, "Lid");
  EXPECT_EQ(assembly.objects[parts[1].object].color, (Srgb{10, 200, 30}));
  const Box3 lid = placed_bounds(assembly.objects[parts[1].object].mesh, parts[1].to_mm);
  EXPECT_LT(length(lid.center() - Vec3{20.0, 3.0, 1.0}), 0.05);
  EXPECT_NEAR(lid.size().y, 4.0, 0.1) << "its height lies along y";
  for (std::size_t n = 0; n < 2; ++n) {
    const PieceExport& one = exported.value()[n];
    EXPECT_EQ(one.name, parts[n].name);
    EXPECT_TRUE(one.report.verdict.printable);
    EXPECT_EQ(one.report.triangles,
              static_cast<std::int64_t>(assembly.objects[parts[n].object].mesh.triangles.size()));
  }
}

TEST(PieceExport, SaysWhichPieceCannotBeWrittenAndLeavesNoFile) {
  const test::ScratchFolder folder;
  ExportOptions options;
  options.triangles = 4;
  options.max_error_mm = 1e-9;
  const auto exported = export_pieces(folder / "pot.3mf", pot(), options);
  ASSERT_FALSE(exported.ok());
  EXPECT_THAT(exported.error().message, HasSubstr("'Pot': "));
  EXPECT_FALSE(std::filesystem::exists(folder / "pot.3mf"));
}

TEST(PieceExport, RefusesASculptureOfWhichNothingIsSeen) {
  const test::ScratchFolder folder;
  Sculpture sculpture = pot();
  for (const char* name : {"Pot", "Lid"}) {
    ChangePiece hide{name};
    hide.is_visible = false;
    ASSERT_TRUE(sculpture.apply(hide).ok());
  }
  const auto exported = export_pieces(folder / "pot.3mf", sculpture, {});
  ASSERT_FALSE(exported.ok());
  EXPECT_EQ(exported.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(exported.error().message, HasSubstr("show one first"));
}

TEST(PieceExport, RefusesAFormatWithoutPartsBeforeAnyWork) {
  const test::ScratchFolder folder;
  int told = 0;
  const auto exported = export_pieces(folder / "pot.stl", pot(), {},
                                      [&](std::string_view, double) { return ++told > 0; });
  ASSERT_FALSE(exported.ok());
  EXPECT_EQ(exported.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(exported.error().message, HasSubstr((folder / "pot.stl").string() + ": "));
  EXPECT_THAT(exported.error().message, HasSubstr("write a .3mf"));
  EXPECT_EQ(told, 0);
}

TEST(PieceExport, TellsHowFarAllPiecesAreAndStopsWhenToldTo) {
  const test::ScratchFolder folder;
  double last = 0.0;
  const auto rises = [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1.0);
    last = fraction;
    return true;
  };
  ASSERT_TRUE(export_pieces(folder / "pot.3mf", pot(), {}, rises).ok());
  EXPECT_GT(last, 0.95);
  const auto stopped = export_pieces(folder / "lid.3mf", pot(), {},
                                     [](std::string_view, double done) { return done < 0.6; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted);
  EXPECT_FALSE(std::filesystem::exists(folder / "lid.3mf"));
}

}  // namespace
}  // namespace argil::io
