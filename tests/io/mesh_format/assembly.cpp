// SPDX-License-Identifier: GPL-3.0-or-later
// An assembly through a 3MF: as we write and read it, and by way of the 3MF consortium's library.
#include "argil/io/assembly.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"

#include "io/support/lamp.h"
#include "io/support/lib3mf_file.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

using test::corners_sorted;
using test::lamp;
using test::ScratchFolder;
using testing::HasSubstr;
using testing::IsEmpty;

void expect_same(const Assembly& made, const Assembly& given) {
  ASSERT_EQ(made.objects.size(), given.objects.size());
  for (std::size_t o = 0; o < made.objects.size(); ++o) {
    EXPECT_EQ(made.objects[o].name, given.objects[o].name);
    EXPECT_EQ(made.objects[o].color, given.objects[o].color) << o;
    EXPECT_EQ(corners_sorted(made.objects[o].mesh), corners_sorted(given.objects[o].mesh)) << o;
  }
  ASSERT_EQ(made.items.size(), given.items.size());
  for (std::size_t i = 0; i < made.items.size(); ++i) {
    EXPECT_EQ(made.items[i].name, given.items[i].name);
    ASSERT_EQ(made.items[i].placements.size(), given.items[i].placements.size());
    for (std::size_t p = 0; p < made.items[i].placements.size(); ++p) {
      EXPECT_EQ(made.items[i].placements[p].object, given.items[i].placements[p].object);
      EXPECT_EQ(made.items[i].placements[p].to_mm.rows, given.items[i].placements[p].to_mm.rows);
    }
  }
}

TEST(WriteAssembly, IsReadBackWithNamesColorsAndPlaces) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_assembly(folder / "lamp.3mf", lamp()));
  const auto read = read_assembly(folder / "lamp.3mf");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_THAT(read.value().notes, IsEmpty());
  expect_same(read.value().assembly, lamp());
  EXPECT_EQ(read.value().frame.unit, LengthUnit::mm);
  EXPECT_NEAR(read.value().frame.largest_side_mm, 59.0, 1e-12);
  // And as one mesh, as ever.
  EXPECT_EQ(corners_sorted(read_mesh(folder / "lamp.3mf").value()), corners_sorted(joined(lamp())));
}

TEST(WriteAssembly, GivesTheSameBytesEveryTimeAlsoOfWhatWasReadBack) {
  const ScratchFolder folder;
  for (const char* name : {"1", "2", "3"}) std::filesystem::create_directory(folder / name);
  const auto file = [&](const std::string& name) { return folder / name / "lamp.3mf"; };
  ASSERT_TRUE(write_assembly(file("1"), lamp()));
  ASSERT_TRUE(write_assembly(file("2"), lamp()));
  ASSERT_TRUE(write_assembly(file("3"), read_assembly(file("1")).value().assembly));
  EXPECT_EQ(test::content_of(file("1")), test::content_of(file("2")));
  EXPECT_EQ(test::content_of(file("1")), test::content_of(file("3")));
}

TEST(WriteAssembly, RefusesFormatsThatHoldNoParts) {
  const ScratchFolder folder;
  const auto written = write_assembly(folder / "lamp.stl", lamp());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(written.error().message, HasSubstr("write a .3mf"));
  EXPECT_EQ(write_assembly(folder / "lamp.3mf", {{{"empty", {}, {}}}, {}}).error().kind,
            ErrorKind::bad_input);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(WriteAssembly, StopsWhenProgressSaysSo) {
  const ScratchFolder folder;
  Assembly many;
  many.objects.push_back({"", {}, test::ball_mesh(10.0, 6)});
  for (double x = 0; x < 50; ++x) many.items.push_back({"", {{0, {}}}});
  const auto written = write_assembly(folder / "a.3mf", many,
                                      [](std::string_view, double done) { return done < 0.5; });
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::interrupted);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(WriteAssembly, IsReadByLib3mfWithNamesAndColors) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_assembly(folder / "lamp.3mf", lamp()));
  const test::Lib3mfFile file = test::lib3mf_file(folder / "lamp.3mf");
  ASSERT_TRUE(file.is_read);
  EXPECT_EQ(file.items, 2);
  EXPECT_EQ(file.components, 2);
  ASSERT_EQ(file.objects.size(), 3U);
  const char* colors[] = {"#C81E00", "#00A0FF", "#FFFFFE"};
  for (std::size_t o = 0; o < 3; ++o) {
    EXPECT_EQ(file.objects[o].name, lamp().objects[o].name);
    EXPECT_EQ(file.objects[o].color, colors[o]);
    EXPECT_TRUE(file.objects[o].manifold);
  }
}

/// Nothing is lost on the way there and back: names, colors, places, items and every coordinate.
TEST(AssemblyRoundTrip, GoesThroughLib3mf) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_assembly(folder / "lamp.3mf", lamp()));
  ASSERT_TRUE(test::rewrite_by_lib3mf(folder / "lamp.3mf", folder / "back.3mf"));
  const auto read = read_assembly(folder / "back.3mf");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_THAT(read.value().notes, IsEmpty());
  expect_same(read.value().assembly, lamp());
}

TEST(WithTrueSizes, GivesWhatIsPlacedInAnotherSizeAMeshOfThatSize) {
  Assembly bolts = lamp();
  // Three times the foot: as it is, mirrored, and of half its size and mirrored.
  const Affine mirrored{{Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{50, 0, 0}}};
  const Affine half{{Vec3{-0.5, 0, 0}, Vec3{0, 0.5, 0}, Vec3{0, 0, 0.5}, Vec3{90, 1, 0}}};
  bolts.items[0].placements.push_back({0, mirrored});
  bolts.items[0].placements.push_back({0, half});
  const Assembly sized = with_true_sizes(bolts);
  ASSERT_EQ(sized.objects.size(), 4U);
  EXPECT_EQ(sized.items[0].placements[1].object, sized.items[0].placements[0].object);
  EXPECT_EQ(sized.objects[1].name, sized.objects[0].name);
  EXPECT_EQ(sized.objects[1].color, sized.objects[0].color);
  EXPECT_NEAR(signed_volume(sized.objects[1].mesh), 30 * 20 * 5 / 8.0, 1e-9);
  EXPECT_EQ(sized.items[0].placements[2].to_mm.rows[3], (Vec3{90, 1, 0}));
  EXPECT_EQ(corners_sorted(joined(sized)), corners_sorted(joined(bolts)));
}

TEST(ReadAssembly, NamesTheOnePartOfOtherFormatsByTheFile) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_mesh(folder / "a knob.stl", test::box_mesh({1, 2, 3})));
  const auto read = read_assembly(folder / "a knob.stl", {LengthUnit::cm, UpAxis::y});
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read.value().assembly.objects.size(), 1U);
  EXPECT_EQ(read.value().assembly.objects[0].name, "a knob");
  EXPECT_EQ(bounds(read.value().assembly.objects[0].mesh).size(), (Vec3{10, 30, 20}));
  EXPECT_EQ(read.value().frame.unit, LengthUnit::cm);
}

TEST(ReadAssembly, TurnsWhatStandsAlongY) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_assembly(folder / "lamp.3mf", lamp()));
  auto upright = read_assembly(folder / "lamp.3mf", {{}, UpAxis::y});
  ASSERT_TRUE(upright);
  const TriangleMesh as_before = joined(lamp());
  const TriangleMesh turned = joined(std::move(upright.value().assembly));
  ASSERT_EQ(turned.positions.size(), as_before.positions.size());
  for (std::size_t v = 0; v < turned.positions.size(); ++v) {
    const Vec3& p = as_before.positions[v];
    EXPECT_NEAR(length(turned.positions[v] - Vec3{p.x, -p.z, p.y}), 0.0, 1e-5);
  }
}

}  // namespace
}  // namespace argil::io
