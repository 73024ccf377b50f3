// SPDX-License-Identifier: GPL-3.0-or-later
// Files of several parts through the commands: parts stay parts, by their names.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/assembly.h"
#include "argil/io/mesh_file.h"

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

io::Affine at(const Vec3& place) { return {{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, place}}; }

/// A body, a lid that stands on it but for a gap, and a pin beside it.
io::Assembly pot(double gap_mm) {
  io::Assembly pot;
  pot.objects = {{"Body", io::Srgb{255, 0, 0}, box_mesh({10, 10, 4})},
                 {"Lid", io::Srgb{0, 255, 0}, box_mesh({10, 10, 2})},
                 {"Pin/1", io::Srgb{0, 0, 255}, box_mesh({2, 2, 4})}};
  pot.items = {{"Pot", {{0, {}}, {1, at({0, 0, 3 + gap_mm})}}}, {"", {{2, at({20, 0, 0})}}}};
  return pot;
}

class CliParts : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string write_pot(const io::Assembly& assembly) const {
    EXPECT_TRUE(io::write_assembly(folder_ / "pot.3mf", assembly));
    return path("pot.3mf");
  }
  Ended run(std::vector<std::string> arguments) const {
    arguments.push_back("--json");
    return run_argil(arguments);
  }
  static std::vector<std::string> names_in(const json& list) {
    std::vector<std::string> names;
    for (const json& one : list) names.push_back(one["name"]);
    return names;
  }

  ScratchFolder folder_;
};

TEST_F(CliParts, CheckJudgesEachByItself) {
  const Ended apart = run({"check", write_pot(pot(0.5)), "--min-gap-mm", "0.8"});
  EXPECT_EQ(apart.status, 0) << apart.err;
  const json report = apart.json();
  EXPECT_THAT(names_in(report["parts"]), ElementsAre("Body", "Lid", "Pin/1"));
  EXPECT_EQ(report["parts"][1]["printable"], true);
  EXPECT_NEAR(report["parts"][1]["volume_mm3"].get<double>(), 200.0, 1e-9);
  ASSERT_EQ(report["part_gaps"].size(), 1U);
  EXPECT_EQ(report["part_gaps"][0]["parts"], (json{"Body", "Lid"}));
  EXPECT_NEAR(report["part_gaps"][0]["gap_mm"].get<double>(), 0.5, 1e-9);
  EXPECT_NEAR(report["part_gaps"][0]["at_mm"][2].get<double>(), 2.25, 1e-9);
  EXPECT_THAT(run_argil({"check", path("pot.3mf"), "--min-gap-mm", "0.8"}).out,
              HasSubstr("'Body' and 'Lid' are 0.5 mm apart at "));
}

TEST_F(CliParts, CheckNamesThePartThatIsBroken) {
  io::Assembly broken = pot(1.0);
  broken.objects[1].mesh.triangles.pop_back();
  const Ended checked = run_argil({"check", write_pot(broken)});
  EXPECT_EQ(checked.status, 1);
  EXPECT_THAT(checked.out, HasSubstr("'Body': printable: yes"));
  EXPECT_THAT(checked.out, HasSubstr("'Lid': printable: no\n  3 open edges"));
}

/// Which the whole, where it counts as a cavity, would not tell.
TEST_F(CliParts, CheckSeesAPartInsideOutWithinAnother) {
  io::Assembly inside = pot(1.0);
  inside.objects[2].mesh = inside_out(box_mesh({1, 1, 1}));
  inside.items[1].placements[0].to_mm = {};
  const Ended checked = run({"check", write_pot(inside)});
  EXPECT_EQ(checked.status, 1);
  EXPECT_EQ(checked.json()["printable"], true);
  EXPECT_EQ(checked.json()["parts"][2]["outward"], false);
}

TEST_F(CliParts, RepairMendsEachAndKeepsTheRest) {
  io::Assembly broken = pot(0.0);
  broken.objects[2].mesh.triangles.pop_back();
  const Ended repaired = run({"repair", write_pot(broken), "-o", path("whole.3mf")});
  EXPECT_EQ(repaired.status, 0) << repaired.err;
  const json report = repaired.json();
  EXPECT_THAT(names_in(report["parts"]), ElementsAre("Body", "Lid", "Pin/1"));
  EXPECT_EQ(report["parts"][0]["way"], "nothing");
  EXPECT_EQ(report["parts"][2]["holes_closed"], 1);
  EXPECT_EQ(report["holes_closed"], 1);
  EXPECT_EQ(report["way"], "local");
  EXPECT_NEAR(report["volume_mm3"].get<double>(), 616.0, 1e-3);
  ASSERT_EQ(report["part_gaps"].size(), 1U);
  EXPECT_EQ(report["part_gaps"][0]["parts"], (json{"Body", "Lid"}));
  const io::Assembly made = io::read_assembly(folder_ / "whole.3mf").value().assembly;
  ASSERT_EQ(made.objects.size(), 3U);
  for (std::size_t o = 0; o < 3; ++o) {
    EXPECT_EQ(made.objects[o].name, broken.objects[o].name);
    EXPECT_EQ(made.objects[o].color, broken.objects[o].color);
    EXPECT_EQ(made.objects[o].mesh.triangles.size(), 12U);
  }
  ASSERT_EQ(made.items.size(), 2U);
  EXPECT_EQ(made.items[0].name, "Pot");
  EXPECT_EQ(made.items[1].placements[0].to_mm.rows, broken.items[1].placements[0].to_mm.rows);
}

TEST_F(CliParts, RepairUnitesOnRequestOrWhereTheFormatHasNoParts) {
  const Ended united = run({"repair", write_pot(pot(-1.0)), "-o", path("one.3mf"), "--unite"});
  EXPECT_EQ(united.status, 0) << united.err;
  EXPECT_EQ(united.json()["components"], 2);
  EXPECT_EQ(united.json()["parts"], json::array());
  EXPECT_EQ(io::read_assembly(folder_ / "one.3mf").value().assembly.objects.size(), 1U);
  const Ended stl = run({"repair", path("pot.3mf"), "-o", path("one.stl")});
  EXPECT_EQ(stl.status, 0) << stl.err;
  EXPECT_THAT(stl.err, HasSubstr("has 3 parts, which become one mesh; name a .3mf with -o"));
}

TEST_F(CliParts, RepairKeepsBodiesThatOverlapOnRequest) {
  fill(path("two.obj"), obj_text(joined(box_mesh({4, 4, 4}), box_mesh({2, 2, 8}))));
  const Ended united = run({"repair", path("two.obj"), "-o", path("one.3mf")});
  EXPECT_EQ(united.json()["united_parts"], 1);
  const Ended kept = run({"repair", path("two.obj"), "-o", path("two.3mf"), "--keep-parts"});
  EXPECT_EQ(kept.status, 0) << kept.err;
  EXPECT_THAT(names_in(kept.json()["parts"]), ElementsAre("two 1", "two 2"));
  EXPECT_EQ(kept.json()["part_gaps"][0]["gap_mm"], 0.0);
  const Ended refused = run_argil({"repair", path("two.obj"), "-o", path("a.stl"), "--keep-parts"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("name a .3mf"));
}

TEST_F(CliParts, ImportNamesEveryPairThatFuses) {
  io::Assembly three = pot(0.2);
  three.items[1].placements[0].to_mm = at({6.0, 0, 0});  // in touch with the body
  const Ended imported =
      run({"import", write_pot(three), "-o", path("p.vdb"), "--voxel-mm", "0.45"});
  ASSERT_EQ(imported.status, 0) << imported.err;
  const json report = imported.json();
  EXPECT_EQ(report["part_names"], (json{"Body", "Lid", "Pin/1"}));
  EXPECT_EQ(report["bodies"], 1);
  ASSERT_EQ(report["fused"].size(), 3U);
  EXPECT_EQ(report["fused"][0]["parts"], (json{"Body", "Pin/1"}));
  EXPECT_EQ(report["fused"][0]["gap_mm"], 0.0);
  EXPECT_NEAR(report["fused"][1]["gap_mm"].get<double>(), 0.2, 1e-6);
  EXPECT_NEAR(report["fused"][2]["gap_mm"].get<double>(), 0.2, 1e-6);
  EXPECT_THAT(imported.err, HasSubstr("'Body' and 'Lid' are 0.2 mm apart at "));
  EXPECT_THAT(imported.err, HasSubstr("'Lid' and 'Pin/1' are 0.2 mm apart at 5, "));
  EXPECT_THAT(imported.err, HasSubstr("with --keep-parts"));
  // Farther apart than two voxels nothing fuses, and nothing is said.
  const Ended fine = run({"import", write_pot(pot(1.5)), "-o", path("p.vdb"), "--voxel-mm", "0.5"});
  EXPECT_EQ(fine.json()["fused"], json::array());
  EXPECT_EQ(fine.json()["bodies"], 3);
}

TEST_F(CliParts, ImportKeepsEachInAClayOfItsOwn) {
  const std::vector<std::string> command{"import",       write_pot(pot(-0.5)), "-o", path("clays/"),
                                         "--keep-parts", "--resolution",       "130"};
  const Ended imported = run(command);
  ASSERT_EQ(imported.status, 0) << imported.err;
  const json projects = imported.json()["projects"];
  EXPECT_THAT(names_in(projects), ElementsAre("Body", "Lid", "Pin/1"));
  const double volumes[] = {400.0, 200.0, 16.0};
  const double lowest[] = {-2.0, 1.5, -2.0};
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_NEAR(projects[p]["volume_mm3"].get<double>(), volumes[p], 0.05 * volumes[p]);
    const json info = run({"info", projects[p]["file"]}).json();
    EXPECT_EQ(info["hash"], projects[p]["hash"]);
    EXPECT_NEAR(info["bbox_mm"][0][2].get<double>(), lowest[p], 0.05);
    EXPECT_EQ(info["levels"][0]["voxel_mm"], imported.json()["voxel_mm"]);
  }
  EXPECT_TRUE(std::filesystem::exists(path("clays/Pin_1.vdb")));
  // Not over projects that nobody named.
  const Ended again = run_argil(command);
  EXPECT_EQ(again.status, 3);
  EXPECT_THAT(again.err, HasSubstr("Body.vdb' is there already; remove it, or name another"));
}

TEST_F(CliParts, ExportMakesOneFileOfSeveralClays) {
  ASSERT_EQ(run_argil({"import", write_pot(pot(0.5)), "-o", path("clays"), "--keep-parts",
                       "--voxel-mm", "0.25"})
                .status,
            0);
  const std::vector<std::string> clays{path("clays/Body.vdb"), path("clays/Lid.vdb"),
                                       path("clays/Pin_1.vdb")};
  std::vector<std::string> command{"export"};
  command.insert(command.end(), clays.begin(), clays.end());
  command.insert(command.end(), {"--triangles", "500", "-o"});
  std::vector<std::string> to_3mf = command;
  to_3mf.push_back(path("set.3mf"));
  const Ended exported = run(to_3mf);
  ASSERT_EQ(exported.status, 0) << exported.err;
  const json report = exported.json();
  EXPECT_THAT(names_in(report["projects"]), ElementsAre("Body", "Lid", "Pin_1"));
  EXPECT_LE(report["projects"][1]["triangles"].get<int>(), 500);
  EXPECT_EQ(report["part_gaps"], json::array());
  const io::Assembly set = io::read_assembly(folder_ / "set.3mf").value().assembly;
  ASSERT_EQ(set.objects.size(), 3U);
  EXPECT_EQ(set.objects[1].name, "Lid");
  EXPECT_EQ(set.objects[1].mesh.triangles.size(), report["projects"][1]["triangles"]);
  EXPECT_NEAR(bounds(set.objects[1].mesh).min.z, 2.5, 0.05);
  EXPECT_EQ(run({"check", path("set.3mf")}).json()["parts"].size(), 3U);
  // What only one can be, or holds no parts.
  std::vector<std::string> to_stl = command;
  to_stl.push_back(path("set.stl"));
  EXPECT_EQ(run_argil(to_stl).status, 2);
  EXPECT_THAT(run_argil(to_stl).err, HasSubstr("parts of one .3mf"));
  to_3mf.push_back("--parts");
  EXPECT_THAT(run_argil(to_3mf).err, HasSubstr("--parts is for one project"));
}

TEST_F(CliParts, ImportKeepsThemAsPiecesOfOneProject) {
  const Ended imported = run(
      {"import", write_pot(pot(0.5)), "-o", path("set.vdb"), "--keep-parts", "--voxel-mm", "0.25"});
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_THAT(names_in(imported.json()["pieces"]), ElementsAre("Body", "Lid", "Pin/1"));
  const json info = run({"info", path("set.vdb")}).json();
  EXPECT_EQ(info["hash"], imported.json()["hash"]);
  EXPECT_THAT(names_in(info["pieces"]), ElementsAre("Body", "Lid", "Pin/1"));
  // Back to a 3MF, with a place and a color that a script gave.
  fill(path("s.strokes.jsonl"),
       "{\"argil_strokes\":1}\n"
       R"({"piece":"change","name":"Lid","position_mm":[0,0,3],)"
       R"("orientation":[1,0,0,0],"color":"#c81e00"})"
       "\n"
       R"({"piece":"change","name":"Body","visible":false})"
       "\n");
  ASSERT_EQ(run_argil({"sculpt", path("set.vdb"), "--strokes", path("s.strokes.jsonl"), "-o",
                       path("moved.vdb")})
                .status,
            0);
  const Ended exported = run({"export", path("moved.vdb"), "-o", path("set.3mf")});
  ASSERT_EQ(exported.status, 0) << exported.err;
  const io::Assembly set = io::read_assembly(folder_ / "set.3mf").value().assembly;
  ASSERT_EQ(set.objects.size(), 2U) << "what is hidden is left out";
  EXPECT_EQ(set.objects[0].name, "Lid");
  EXPECT_EQ(set.objects[0].color, (io::Srgb{200, 30, 0}));
  EXPECT_FALSE(set.objects[1].color);
  const io::PlacedPart lid = io::placed_parts(set)[0];
  EXPECT_NEAR(io::placed_bounds(set.objects[0].mesh, lid.to_mm).min.z,
              bounds(set.objects[0].mesh).min.z + 3.0, 1e-6);
  // One by name, into any format; all of them only where they have names.
  EXPECT_EQ(
      run_argil({"export", path("moved.vdb"), "--piece", "Lid", "-o", path("lid.stl")}).status, 0);
  const Ended stl = run_argil({"export", path("moved.vdb"), "-o", path("set.stl")});
  EXPECT_EQ(stl.status, 3);
  EXPECT_THAT(stl.err, HasSubstr("--piece"));
}

TEST_F(CliParts, ImportKeepsAllOrNone) {
  io::Assembly sheet = pot(1.0);
  sheet.objects[2].mesh.triangles.resize(2);
  const Ended open = run_argil({"import", write_pot(sheet), "-o", path("clays"), "--keep-parts",
                                "--voxel-mm", "0.25", "--repair", "none"});
  EXPECT_EQ(open.status, 3);
  EXPECT_THAT(open.err, HasSubstr("part 'Pin/1': it has 4 open edges"));
  EXPECT_FALSE(std::filesystem::exists(path("clays")));
  RunOptions full;
  full.largest_file_bytes = 8000;
  const Ended disk = run_argil(
      {"import", write_pot(pot(1.0)), "-o", path("clays"), "--keep-parts", "--voxel-mm", "0.25"},
      full);
  EXPECT_EQ(disk.status, 5);
  EXPECT_FALSE(std::filesystem::exists(path("clays")));
}

TEST_F(CliParts, ImportKeepsBodiesOfAFileWithoutNames) {
  fill(path("two.obj"), obj_text(joined(box_mesh({4, 4, 4}), box_mesh({2, 2, 2}, {5, 0, 0}))));
  const Ended imported =
      run({"import", path("two.obj"), "-o", path("clays"), "--keep-parts", "--voxel-mm", "0.25"});
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_THAT(names_in(imported.json()["projects"]), ElementsAre("two 1", "two 2"));
  EXPECT_TRUE(std::filesystem::exists(path("clays/two 2.vdb")));
}

TEST_F(CliParts, ImportGivesDistinctFilesToNamesThatAreAlike) {
  io::Assembly alike = pot(1.0);
  alike.objects[0].name = "..";
  alike.objects[1].name = "a:b";
  alike.objects[2].name = "A*B";
  const Ended imported =
      run({"import", write_pot(alike), "-o", path("clays"), "--keep-parts", "--voxel-mm", "0.5"});
  ASSERT_EQ(imported.status, 0) << imported.err;
  for (const char* file : {"clays/_...vdb", "clays/a_b.vdb", "clays/A_B-2.vdb"}) {
    EXPECT_TRUE(std::filesystem::exists(path(file))) << file;
  }
}

TEST_F(CliParts, ImportSaysWhichOutputItMeans) {
  const std::string file = write_pot(pot(1.0));
  EXPECT_THAT(run_argil({"import", file, "-o", path("a")}).err,
              HasSubstr("must be a file name ending in one of .vdb"));
  EXPECT_THAT(run_argil({"import", file, "-o", path("no/a"), "--keep-parts"}).err,
              HasSubstr("there is no folder"));
}

}  // namespace
}  // namespace argil::test
