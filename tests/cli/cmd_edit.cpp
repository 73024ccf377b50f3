// SPDX-License-Identifier: GPL-3.0-or-later
// argil edit: operations in the order they are named, each with its numbers.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"
#include "argil/io/session.h"

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

double ball_volume(double radius) { return 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3); }

/// A folder with a ball of 10 mm as p.vdb.
class CliEdit : public testing::Test {
 protected:
  void SetUp() override {
    fill(path("s.strokes.jsonl"),
         R"({"argil_strokes":1,"start":{"shape":"ball","radius_mm":10,"voxel_mm":0.25}})"
         "\n");
    ASSERT_EQ(
        run_argil({"sculpt", "--strokes", path("s.strokes.jsonl"), "-o", path("p.vdb")}).status, 0);
  }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  Ended edit(std::vector<std::string> more) const {
    more.insert(more.begin(), {"edit", path("p.vdb"), "-o", path("q.vdb"), "--json"});
    return run_argil(more);
  }
  double volume() const {
    return run_argil({"info", path("q.vdb"), "--json"}).json()["volume_mm3"].get<double>();
  }

  ScratchFolder folder;
};

TEST_F(CliEdit, RunsOperationsInTheirOrder) {
  const Ended run = edit({"--cut", "0,0,0,0,0,1", "--offset", "1", "--cut", "0,0,0,1,0,0"});
  ASSERT_EQ(run.status, 0) << run.err;
  const json report = run.json();
  ASSERT_EQ(report["operations"].size(), 3U);
  EXPECT_EQ(report["operations"][0]["operation"], "cut");
  EXPECT_EQ(report["operations"][1]["operation"], "offset");
  EXPECT_TRUE(report["operations"][1]["replaced_levels"].get<bool>());
  EXPECT_GT(report["operations"][2]["changed_leaves"].get<int>(), 0);
  EXPECT_NE(report["hash"], report["start_hash"]);
  // Half of the half ball grown by 1 mm: half of both halves' sum is known only roughly.
  EXPECT_GT(volume(), 0.25 * ball_volume(10.0));
  EXPECT_LT(volume(), 0.5 * ball_volume(11.0));
}

TEST_F(CliEdit, ScalesAndSplitsThePiece) {
  const Ended scaled = edit({"--scale", "1.5"});
  ASSERT_EQ(scaled.status, 0) << scaled.err;
  EXPECT_NEAR(volume(), ball_volume(15.0), 0.002 * ball_volume(15.0));
  const auto larger = io::load_sculpture(path("q.vdb"));
  ASSERT_TRUE(larger);
  EXPECT_TRUE(larger.value().is_plain());
  EXPECT_DOUBLE_EQ(larger.value().clay().options().voxel_mm, 0.375);
  // Two caps of the ball, apart.
  ASSERT_TRUE(io::write_mesh(path("slab.stl"), box_mesh({30.0, 30.0, 6.0})));
  const Ended split = edit({"--difference", path("slab.stl"), "--split", "0.001", "--scale", "2"});
  ASSERT_EQ(split.status, 0) << split.err;
  EXPECT_EQ(split.json()["operations"][0]["pieces"], 1);
  EXPECT_EQ(split.json()["operations"][1]["operation"], "split");
  EXPECT_EQ(split.json()["operations"][1]["pieces"], 2);
  const auto pieces = io::load_sculpture(path("q.vdb"));
  ASSERT_TRUE(pieces);
  ASSERT_EQ(pieces.value().piece_count(), 2U);
  EXPECT_EQ(pieces.value().look(1).name, "Clay 2");
  EXPECT_DOUBLE_EQ(pieces.value().clay(0).options().voxel_mm, 0.5) << "scaled after it was split";
  EXPECT_DOUBLE_EQ(pieces.value().clay(1).options().voxel_mm, 0.25);
  EXPECT_THAT(edit({"--split", "0.001"}).err, HasSubstr("split: the piece 'Clay' is one solid"));
  EXPECT_THAT(edit({"--scale", "1"}).err, HasSubstr("scale: the factor is 1"));
  EXPECT_THAT(edit({"--scale", "-1"}).err, HasSubstr("--scale"));
  EXPECT_THAT(edit({"--scale", "2", "--at", "0,0,1"}).err, HasSubstr("--at belongs to"));
}

TEST_F(CliEdit, ChangesTheMask) {
  const std::string start = run_argil({"info", path("p.vdb"), "--json"}).json()["hash"];
  const Ended run = edit({"--mask", "fill", "--offset", "0.5", "--mask", "blur"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json()["operations"][0]["operation"], "mask fill");
  fill(path("carve.strokes.jsonl"),
       R"({"argil_strokes":1})"
       "\n"
       R"({"tool":"carve","shape":"ball","radius_mm":4,"poses":[[0,10,0,0]]})"
       "\n");
  const Ended held = run_argil({"sculpt", path("q.vdb"), "--strokes", path("carve.strokes.jsonl"),
                                "-o", path("r.vdb"), "--json"});
  ASSERT_EQ(held.status, 0) << held.err;
  EXPECT_EQ(held.json()["hash"], held.json()["start_hash"]) << "all is held";
  const Ended cleared = edit({"--mask", "invert", "--mask", "clear"});
  ASSERT_EQ(cleared.status, 0) << cleared.err;
  EXPECT_EQ(cleared.json()["hash"], start);
  EXPECT_THAT(edit({"--mask", "soften"}).err,
              HasSubstr("--mask is 'soften'; must be clear, invert, blur, fill, sharpen, grow:MM"));
}

TEST_F(CliEdit, GrowsTheMaskAndMasksCavities) {
  fill(path("mask.strokes.jsonl"),
       R"({"argil_strokes":1})"
       "\n"
       R"({"tool":"mask","shape":"ball","radius_mm":4,"poses":[[0,10,0,0],[0.1,10,0.01,0]]})"
       "\n");
  ASSERT_EQ(run_argil({"sculpt", path("p.vdb"), "--strokes", path("mask.strokes.jsonl"), "-o",
                       path("p.vdb")})
                .status,
            0);
  const auto held_after = [&](const std::vector<std::string>& masks) {
    std::vector<std::string> arguments;
    for (const std::string& mask : masks) arguments.insert(arguments.end(), {"--mask", mask});
    const Ended run = edit(arguments);
    EXPECT_EQ(run.status, 0) << run.err;
    const auto clay = io::load_project(path("q.vdb"));
    EXPECT_TRUE(clay.ok());
    // 5 mm along the ball from where it was painted.
    return clay.value().mask_at(10.0 * Vec3{std::cos(0.5), std::sin(0.5), 0.0});
  };
  EXPECT_LT(held_after({"sharpen"}), 0.01);
  EXPECT_GT(held_after({"grow:4", "sharpen"}), 0.9);
  EXPECT_LT(held_after({"grow:4", "shrink:4"}), 0.05);
  EXPECT_NEAR(held_after({"cavity:1,-1"}), 0.2, 0.05) << "2 / R of a ball";
  EXPECT_NEAR(held_after({"cavity-inverted:1,-1"}), 0.8, 0.05);
  EXPECT_EQ(held_after({"cavity:1"}), 0.0);
  EXPECT_THAT(edit({"--mask", "grow:x"}).err, HasSubstr("--mask grow"));
  EXPECT_THAT(edit({"--mask", "grow:-1"}).err, HasSubstr("--mask grow"));
  EXPECT_THAT(edit({"--mask", "cavity:1,2,3"}).err, HasSubstr("cavity:RADIUS,FACTOR"));
  EXPECT_THAT(edit({"--mask", "cavity:0.001"}).err, HasSubstr("two voxels of the clay"));
  EXPECT_THAT(edit({"--mask", "melt:3"}).err, HasSubstr("--mask is 'melt:3'"));
}

/// The same operations as lines of a script, on the project itself: a session.
TEST_F(CliEdit, DoesWhatAScriptOfOperationsDoes) {
  ASSERT_TRUE(io::write_mesh(path("bar.stl"), box_mesh({3.0, 3.0, 30.0})));
  const Ended edited = edit({"--cut", "0,0,2,0,0,1", "--difference", path("bar.stl"), "--at",
                             "4,0,0", "--voxel-mm", "0.3", "--offset", "-0.5"});
  ASSERT_EQ(edited.status, 0) << edited.err;
  fill(path("o.strokes.jsonl"), R"({"argil_strokes":1}
{"operation":"cut","point_mm":[0,0,2],"normal":[0,0,1]}
{"operation":"difference","with":"bar.stl","position_mm":[4,0,0]}
{"operation":"resample","voxel_mm":0.3}
{"operation":"offset","distance_mm":-0.5}
{"history":"undo"}
{"history":"redo"}
)");
  const Ended sculpted = run_argil({"sculpt", path("p.vdb"), "--strokes", path("o.strokes.jsonl"),
                                    "-o", path("p.vdb"), "--json"});
  ASSERT_EQ(sculpted.status, 0) << sculpted.err;
  EXPECT_EQ(sculpted.json()["operations"], 4);
  EXPECT_EQ(sculpted.json()["strokes"], 0);
  EXPECT_EQ(sculpted.json()["hash"], edited.json()["hash"]);
  EXPECT_EQ(run_argil({"info", path("p.vdb"), "--json"}).json()["hash"], edited.json()["hash"]);
}

TEST_F(CliEdit, NamesTheLineThatCannotBeDone) {
  fill(path("o.strokes.jsonl"), R"({"argil_strokes":1}
{"operation":"offset","distance_mm":0.5}
{"operation":"cut","point_mm":[0,0,-50],"normal":[0,0,1]}
)");
  const std::string before = content_of(path("p.vdb"));
  const Ended run = run_argil(
      {"sculpt", path("p.vdb"), "--strokes", path("o.strokes.jsonl"), "-o", path("p.vdb")});
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, HasSubstr("o.strokes.jsonl: operation 2: nothing would be left"));
  EXPECT_EQ(content_of(path("p.vdb")), before);
  fill(path("o.strokes.jsonl"), R"({"argil_strokes":1}
{"operation":"union","with":"gone.stl"}
)");
  const Ended gone = run_argil(
      {"sculpt", path("p.vdb"), "--strokes", path("o.strokes.jsonl"), "-o", path("p.vdb")});
  EXPECT_EQ(gone.status, 3);
  EXPECT_THAT(gone.err, HasSubstr("o.strokes.jsonl:2: key 'with' cannot be used: '"));
  EXPECT_EQ(folder.names().size(), 3U) << "nothing is left behind";
}

TEST_F(CliEdit, StartsFromWhatAKilledSessionLeft) {
  {
    auto session = io::Session::open(path("p.vdb"));
    ASSERT_TRUE(session) << session.error().message;
    const io::ScriptStep step = Operation(Offset{1.0});
    ASSERT_TRUE(io::apply_step(session.value().sculpture(), step));
    session.value().record(step);
    ASSERT_TRUE(session.value().flush());
  }
  const Ended run = edit({"--cut", "0,0,0,0,0,1"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json()["recovered_strokes"], 1);
  EXPECT_NEAR(volume(), 0.5 * ball_volume(11.0), 0.01 * ball_volume(11.0));
}

TEST_F(CliEdit, HollowsWithDrains) {
  const Ended run = edit({"--hollow", "2", "--drain", "0,0,-10,0,0,1,1.5"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(volume(), ball_volume(10.0) - ball_volume(8.0), 0.02 * ball_volume(10.0));
}

TEST_F(CliEdit, CombinesWithMeshesAndProjects) {
  fill(path("box.obj"), obj_text(box_mesh({4, 4, 40})));
  Ended run = edit({"--difference", path("box.obj")});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_LT(volume(), ball_volume(10.0) - 4.0 * 4.0 * 19.0);
  run = edit({"--union", path("p.vdb"), "--at", "30,0,0", "--turn", "1,0,0,1"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(volume(), 2.0 * ball_volume(10.0), 0.01 * ball_volume(10.0));
}

TEST_F(CliEdit, RefusesWhatCannotBeUsed) {
  const Ended none = edit({});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("no operation was named"));
  EXPECT_THAT(edit({"--subtract", path("none.obj")}).err, HasSubstr("--subtract"));
  EXPECT_EQ(edit({"--drain", "0,0,0,0,0,1,1"}).status, 2);
  EXPECT_EQ(edit({"--cut", "0,0,0"}).status, 2);
  EXPECT_EQ(edit({"--offset", "nan"}).status, 2);
  EXPECT_EQ(edit({"--union", path("none.obj")}).status, 3);
  const Ended run = edit({"--offset", "-20"});
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, HasSubstr("nothing would be left"));
  EXPECT_FALSE(std::filesystem::exists(path("q.vdb")));
}

}  // namespace
}  // namespace argil::test
