// SPDX-License-Identifier: GPL-3.0-or-later
// argil prepare: its options, its keys and the files that it writes.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "support/profile_solids.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

/// A folder with a mesh and a printer profile.
class CliPrepare : public testing::Test {
 protected:
  void SetUp() override {
    put(box_mesh({150.0, 30.0, 30.0}), "block.obj");
    put(joined(box_mesh({20.0, 20.0, 20.0}), inside_out(ball_mesh(6.0, 4))), "hollow.obj");
    put(ball_mesh(10.0, 4), "ball.obj");
    fill(path("printer.json"),
         R"({"argil_printer": 1, "name": "small", "bed_mm": [100, 100, 100],
             "max_overhang_deg": 45, "needs_drains": true})");
  }
  void put(const TriangleMesh& mesh, const std::string& name) const {
    fill(path(name), obj_text(mesh));
  }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  /// Prepares a mesh of the folder as out.stl, on its printer.
  Ended prepare(const std::string& name, std::vector<std::string> more) const {
    std::vector<std::string> words{"prepare",   path(name),           "-o",    path("out.stl"),
                                   "--printer", path("printer.json"), "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run_argil(words);
  }

  ScratchFolder folder;
};

TEST_F(CliPrepare, TellsOrientationsAndWhatItMade) {
  const Ended run =
      prepare("ball.obj", {"--voxel-mm", "0.4", "--wall-mm", "2", "--pictures", path("made/here")});
  ASSERT_EQ(run.status, 0) << run.err;
  const json made = run.json();
  EXPECT_TRUE(made["printable"].get<bool>());
  ASSERT_GE(made["orientations"].size(), 1U);
  for (const char* key : {"up", "overhang_mm2", "support_mm3", "scars_mm2", "height_mm",
                          "contact_mm2", "footing_mm", "cost"}) {
    EXPECT_TRUE(made["orientations"][0].contains(key)) << key;
  }
  EXPECT_GT(made["cut_mm"].get<double>(), 0.0);
  EXPECT_EQ(made["wall_mm"].get<double>(), 2.0);
  ASSERT_EQ(made["holes"].size(), 2U);
  EXPECT_FALSE(made["holes"][0]["air"].get<bool>());
  ASSERT_EQ(made["pieces"].size(), 1U);
  EXPECT_EQ(made["pieces"][0]["file"], path("out.stl"));
  EXPECT_EQ(made["pieces"][0]["pockets"].size(), 0U);
  EXPECT_THAT(made["pictures"],
              ElementsAre(path("made/here/orientations.png"), path("made/here/pieces.png"),
                          path("made/here/drains.png")));
  for (const auto& picture : made["pictures"]) {
    EXPECT_GT(std::filesystem::file_size(picture.get<std::string>()), 10'000U);
  }
  const auto back = io::read_mesh(path("out.stl"));
  ASSERT_TRUE(back);
  EXPECT_NEAR(bounds(back.value()).min.z, 0.0, 1e-5);
  EXPECT_NEAR(bounds(back.value()).center().x, 50.0, 1e-3);
}

TEST_F(CliPrepare, WritesAFileForEachPieceAndOneOfPlugs) {
  const Ended run = prepare("block.obj", {"--voxel-mm", "0.6", "--keep-orientation", "--fit"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json()["plugs"], 2);
  EXPECT_THAT(folder.names(),
              UnorderedElementsAre("ball.obj", "block.obj", "hollow.obj", "out-1.stl", "out-2.stl",
                                   "out-plugs.stl", "printer.json"));
}

TEST_F(CliPrepare, SaysNoToAPieceThatIsTooLargeButWritesIt) {
  const Ended run = prepare("block.obj", {"--voxel-mm", "0.6", "--keep-orientation"});
  EXPECT_EQ(run.status, 1) << run.err;
  const json made = run.json();
  EXPECT_FALSE(made["printable"].get<bool>());
  EXPECT_EQ(made["pieces"][0]["problems"][0]["kind"], "too_large");
  EXPECT_TRUE(std::filesystem::exists(path("out.stl")));
}

TEST_F(CliPrepare, SaysNoToAClosedCavityWhereDrainsAreNeeded) {
  const Ended run = prepare("hollow.obj", {"--voxel-mm", "0.4", "--up", "0,0,2"});
  EXPECT_EQ(run.status, 1) << run.err;
  const json piece = run.json()["pieces"][0];
  ASSERT_EQ(piece["pockets"].size(), 1U);
  EXPECT_TRUE(piece["pockets"][0]["closed"].get<bool>());
  EXPECT_NEAR(piece["pockets"][0]["lowest_mm"][2].get<double>(), 4.0, 0.3);
}

TEST_F(CliPrepare, TakesAProjectAsWell) {
  fill(path("s.strokes.jsonl"),
       R"({"argil_strokes":1,"start":{"shape":"ball","radius_mm":10,"voxel_mm":0.5}})"
       "\n");
  ASSERT_EQ(run_argil({"sculpt", "--strokes", path("s.strokes.jsonl"), "-o", path("p.vdb")}).status,
            0);
  const Ended run = prepare("p.vdb", {"--keep-orientation", "--base", "cut:10"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(run.json()["pieces"][0]["size_mm"][2].get<double>(), 10.0, 0.1);
}

TEST_F(CliPrepare, NamesWhatItCannotUse) {
  const auto refusal = [&](const std::vector<std::string>& more, int status) {
    const Ended run = prepare("ball.obj", more);
    EXPECT_EQ(run.status, status) << run.out;
    return run.err;
  };
  EXPECT_THAT(refusal({"--base", "flat"}, 2), HasSubstr("auto, cut:MM, lay or none"));
  EXPECT_THAT(refusal({"--base", "cut:-1"}, 2), HasSubstr("--base cut:MM"));
  EXPECT_THAT(refusal({"--up", "0,1"}, 2), HasSubstr("--up"));
  EXPECT_THAT(refusal({"--up", "0,0,1", "--keep-orientation"}, 2), HasSubstr("excludes"));
  EXPECT_THAT(refusal({"--plug-tolerance-mm", "3"}, 2), HasSubstr("from 0 to 2"));
  EXPECT_THAT(refusal({"--up", "0,0,0"}, 3), HasSubstr("is zero"));
  EXPECT_THAT(refusal({"--keep-orientation", "--wall-mm", "0.05"}, 3), HasSubstr("hollow"));
  EXPECT_THAT(refusal({"--pictures", path("ball.obj")}, 5), HasSubstr("ball.obj"));
  EXPECT_FALSE(std::filesystem::exists(path("out.stl")));
}

TEST_F(CliPrepare, LeavesNothingWhenInterrupted) {
  RunOptions stopped;
  stopped.interrupt_after_ms = 300;
  const Ended run =
      run_argil({"prepare", path("ball.obj"), "--voxel-mm", "0.1", "-o", path("out.stl")}, stopped);
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_THAT(folder.names(),
              UnorderedElementsAre("ball.obj", "block.obj", "hollow.obj", "printer.json"));
}

}  // namespace
}  // namespace argil::test
