// SPDX-License-Identifier: GPL-3.0-or-later
// An assembly of named, colored parts through the slicer of a print shop and back.
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/assembly.h"
#include "argil/mesh/check.h"

#include "io/support/lamp.h"
#include "support/clients.h"
#include "support/scratch.h"

namespace argil::io {
namespace {

using test::lamp;
using test::ScratchFolder;
using testing::IsEmpty;

/// Has PrusaSlicer load a file and write what it loaded as another; what went wrong, or nothing.
std::string rewrite_by_slicer(const std::filesystem::path& from, const std::filesystem::path& to,
                              const std::vector<std::string>& options = {}) {
  std::vector<std::string> words{"prusa-slicer", "--loglevel", "1", "--export-3mf"};
  words.insert(words.end(), options.begin(), options.end());
  words.insert(words.end(), {"-o", to.string(), from.string()});
  const test::ProgramRun run = test::run_program(words);
  return run.status == 0 && std::filesystem::exists(to) ? "" : run.output;
}

/// PrusaSlicer makes an object of each part and knows no colors: those alone are lost.
TEST(AssemblyClient, GoesThroughPrusaSlicerWithNamesShapesAndPlaces) {
  ARGIL_CLIENT_OR_SKIP("prusa-slicer");
  const ScratchFolder folder;
  ASSERT_TRUE(write_assembly(folder / "lamp.3mf", lamp()));
  ASSERT_EQ(rewrite_by_slicer(folder / "lamp.3mf", folder / "back.3mf", {"--no-ensure-on-bed"}),
            "");
  const auto read = read_assembly(folder / "back.3mf");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_THAT(read.value().notes, IsEmpty());
  const Assembly& back = read.value().assembly;
  const std::vector<PlacedPart> given = placed_parts(lamp());
  const std::vector<PlacedPart> made = placed_parts(back);
  ASSERT_EQ(made.size(), 3U);
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_EQ(made[p].name, given[p].name);
    EXPECT_EQ(back.objects[made[p].object].color, std::nullopt);
    const TriangleMesh was = placed_mesh(lamp().objects[given[p].object].mesh, given[p].to_mm);
    const TriangleMesh is = placed_mesh(back.objects[made[p].object].mesh, made[p].to_mm);
    EXPECT_EQ(is.triangles.size(), was.triangles.size());
    EXPECT_NEAR(signed_volume(is), signed_volume(was), 1e-4 * signed_volume(was));
    // The slicer counts from the middle of the bed it was left with: the same shift for all.
    const Vec3 shift = bounds(is).center() - bounds(was).center();
    EXPECT_NEAR(
        length(shift -
               (bounds(placed_mesh(back.objects[made[0].object].mesh, made[0].to_mm)).center() -
                bounds(placed_mesh(lamp().objects[0].mesh, {})).center())),
        0.0, 1e-4)
        << p;
    EXPECT_NEAR(length(bounds(is).size() - bounds(was).size()), 0.0, 1e-4) << p;
  }
}

TEST(AssemblyClient, IsThreeManifoldObjectsForPrusaSlicer) {
  ARGIL_CLIENT_OR_SKIP("prusa-slicer");
  const ScratchFolder folder;
  ASSERT_TRUE(write_assembly(folder / "lamp.3mf", lamp()));
  const test::SlicerInfo info = test::slicer_info(folder / "lamp.3mf");
  EXPECT_THAT(info.complaints, IsEmpty());
  EXPECT_EQ(info.objects, 3);
  EXPECT_EQ(info.parts, 3);
  EXPECT_NEAR(info.volume_mm3, signed_volume(joined(lamp())), 0.1);
}

/// What the slicer merges into one mesh of an object is parted again by what it notes beside it.
TEST(AssemblyClient, IsPartedAgainWherePrusaSlicerMergedIt) {
  ARGIL_CLIENT_OR_SKIP("prusa-slicer");
  const ScratchFolder folder;
  Assembly two;  // volumes of one object, as the slicer writes them of two that overlap in height
  two.objects = {{"Peg", {}, test::box_mesh({2, 2, 20})}, {"Plate", {}, test::box_mesh({9, 9, 2})}};
  two.items = {{"", {{0, {}}}}, {"", {{1, {}}}}};
  ASSERT_TRUE(write_assembly(folder / "two.3mf", two));
  ASSERT_EQ(rewrite_by_slicer(folder / "two.3mf", folder / "one.3mf", {"--merge"}), "");
  const auto read = read_assembly(folder / "one.3mf");
  ASSERT_TRUE(read) << read.error().message;
  std::vector<std::string> names;
  for (const PlacedPart& part : placed_parts(read.value().assembly)) names.push_back(part.name);
  EXPECT_THAT(names, testing::ElementsAre("Peg", "Plate"));
}

}  // namespace
}  // namespace argil::io
