// SPDX-License-Identifier: GPL-3.0-or-later
// Commands on projects of several pieces: none means another piece than it was told, or loses one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// A folder with p.vdb: a ball and a box beside it, which was selected last.
class CliPieces : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(io::write_mesh(folder / "box.stl", box_mesh({6.0, 4.0, 5.0})));
    fill(path("s.strokes.jsonl"),
         R"({"argil_strokes":1,"start":{"shape":"ball","radius_mm":5,"voxel_mm":0.4}})"
         "\n"
         R"({"piece":"add","name":"Box","of":"box.stl","position_mm":[20,0,0],"color":"#c08060"})"
         "\n");
    const Ended run = argil({"sculpt", "--strokes", path("s.strokes.jsonl"), "-o", path("p.vdb")});
    ASSERT_EQ(run.status, 0) << run.err;
  }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  static Ended argil(std::vector<std::string> words) { return run_argil(std::move(words)); }
  json info(const std::string& name) const { return argil({"info", path(name), "--json"}).json(); }

  ScratchFolder folder;
};

TEST_F(CliPieces, InfoListsThem) {
  const json found = info("p.vdb");
  ASSERT_EQ(found["pieces"].size(), 2U);
  EXPECT_EQ(found["active"], "Box");
  EXPECT_EQ(found["pieces"][1]["position_mm"], json({20.0, 0.0, 0.0}));
  EXPECT_EQ(found["pieces"][1]["color"], "#c08060");
  EXPECT_NEAR(found["pieces"][1]["volume_mm3"].get<double>(), 120.0, 2.0);
  EXPECT_THAT(argil({"info", path("p.vdb")}).out, HasSubstr("piece 'Box' at 20,0,0 mm, active"));
}

TEST_F(CliPieces, CommandsOfOneClayAskWhichIsMeant) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"export", path("p.vdb"), "-o", path("x.vdb")},
        {"force", path("p.vdb"), "--tool", "ball:2", "--at", "0,0,5"},
        {"edit", path("p.vdb"), "-o", path("q.vdb"), "--offset", "0.5"}}) {
    const Ended run = argil(words);
    EXPECT_EQ(run.status, 3) << words[0];
    EXPECT_THAT(run.err, AllOf(HasSubstr("'Clay', 'Box'"), HasSubstr("--piece"))) << words[0];
  }
  const Ended none = argil({"export", path("p.vdb"), "--piece", "Bax", "-o", path("x.vdb")});
  EXPECT_EQ(none.status, 3);
  EXPECT_THAT(none.err, HasSubstr("there is no piece 'Bax'"));
  const Ended mesh = argil({"check", path("box.stl"), "--piece", "Box"});
  EXPECT_EQ(mesh.status, 3);
  EXPECT_THAT(mesh.err, HasSubstr("leave out --piece"));
}

TEST_F(CliPieces, EditChangesOneAndKeepsTheRest) {
  const Ended run = argil(
      {"edit", path("p.vdb"), "--piece", "Clay", "-o", path("q.vdb"), "--offset", "0.5", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const json before = info("p.vdb");
  const json after = info("q.vdb");
  EXPECT_EQ(after["active"], "Box");
  EXPECT_EQ(after["hash"], run.json()["hash"]);
  EXPECT_EQ(before["hash"], run.json()["start_hash"]);
  EXPECT_EQ(after["pieces"][1], before["pieces"][1]);
  EXPECT_GT(after["pieces"][0]["volume_mm3"], before["pieces"][0]["volume_mm3"]);
}

TEST_F(CliPieces, ScriptsSculptThemAndTakeAllBack) {
  fill(path("t.strokes.jsonl"),
       "{\"argil_strokes\":1}\n"
       R"({"piece":"select","name":"Clay"})"
       "\n"
       R"({"tool":"carve","shape":"ball","radius_mm":1,"strength":1,"poses":[[0,0,0,5]]})"
       "\n"
       R"({"piece":"difference","name":"Box","other":"Clay","keeps_other":true})"
       "\n"
       R"({"piece":"remove","name":"Clay"})"
       "\n");
  const std::vector<std::string> words{
      "sculpt", path("p.vdb"), "--strokes", path("t.strokes.jsonl"), "-o", path("q.vdb")};
  const Ended done = argil(words);
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(info("q.vdb")["pieces"].size(), 1U);
  std::vector<std::string> back = words;
  back.back() = path("r.vdb");
  back.emplace_back("--undo-all");
  const Ended undone = argil(back);
  ASSERT_EQ(undone.status, 0) << undone.err;
  EXPECT_EQ(info("r.vdb")["hash"], info("p.vdb")["hash"]);
  fill(path("t.strokes.jsonl"),
       "{\"argil_strokes\":1}\n"
       R"({"piece":"select","name":"Nose"})"
       "\n");
  const Ended refused = argil(words);
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, HasSubstr("step 1: there is no piece 'Nose'"));
}

TEST_F(CliPieces, PictureShowsThemAllOrOne) {
  const auto triangles = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"render", path("p.vdb"), "-o",   path("p.png"),
                                   "--json", "--size",      "64x48"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended run = argil(words);
    EXPECT_EQ(run.status, 0) << run.err;
    return run.json()["triangles"].get<std::int64_t>();
  };
  EXPECT_EQ(triangles({}), triangles({"--piece", "Clay"}) + triangles({"--piece", "Box"}));
}

}  // namespace
}  // namespace argil::test
