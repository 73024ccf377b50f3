// SPDX-License-Identifier: GPL-3.0-or-later
// --unit and --up of every command that reads a mesh.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"

#include "cli/run_argil.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class MeshInput : public testing::Test {
 protected:
  MeshInput() {
    // Flat below along y and a point along z: it stands along y, and is 0.15 across.
    TriangleMesh wedge{{{0, 0, 0}, {0.1, 0, 0}, {0.1, 0, 0.15}, {0, 0.05, 0.075}}, {}, {}};
    wedge.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    EXPECT_TRUE(io::write_mesh(mesh_, wedge));
  }

  Ended run(std::vector<std::string> arguments) const { return run_argil(arguments); }

  ScratchFolder folder_;
  std::string mesh_ = (folder_ / "wedge.obj").string();
  std::string out_ = (folder_ / "out.3mf").string();
};

TEST_F(MeshInput, IsAssumedAndDoubtedWhereNobodySays) {
  const Ended check = run({"check", mesh_, "--json"});
  EXPECT_EQ(check.json()["unit"],
            (json{{"value", "mm"}, {"source", "assumed"}, {"looks_like", "m"}}));
  EXPECT_EQ(check.json()["up"], (json{{"value", "z"}, {"source", "assumed"}, {"looks_like", "y"}}));
  EXPECT_EQ(check.json()["size_mm"][2], 0.15);
  EXPECT_THAT(check.err, AllOf(HasSubstr("give --unit m"), HasSubstr("give --up y")));
}

TEST_F(MeshInput, IsTakenAsIsSaidByEveryCommand) {
  const std::vector<std::string> said{"--unit", "m", "--up", "y", "--json"};
  for (std::vector<std::string> words : std::vector<std::vector<std::string>>{
           {"check", mesh_},
           {"import", mesh_, "-o", (folder_ / "a.vdb").string(), "--resolution", "40"},
           {"repair", mesh_, "-o", out_},
           {"render", mesh_, "-o", (folder_ / "a.png").string(), "--size", "64x64"}}) {
    words.insert(words.end(), said.begin(), said.end());
    const Ended ended = run(words);
    ASSERT_EQ(ended.status, 0) << ended.out << ended.err;
    const json told = ended.json();
    EXPECT_EQ(told["unit"], (json{{"value", "m"}, {"source", "given"}, {"looks_like", nullptr}}));
    EXPECT_EQ(told["up"], (json{{"value", "y"}, {"source", "given"}, {"looks_like", nullptr}}));
    EXPECT_THAT(ended.err, Not(HasSubstr("--u"))) << words[0];
    if (words[0] == "render") continue;
    EXPECT_NEAR(told["size_mm"][1].get<double>(), 150.0, 1e-4) << words[0];
    EXPECT_NEAR(told["size_mm"][2].get<double>(), 50.0, 1e-4) << words[0];
  }
}

TEST_F(MeshInput, NeedsNoUnitForASizeThatIsGiven) {
  const std::string project = (folder_ / "a.vdb").string();
  const Ended import =
      run({"import", mesh_, "-o", project, "--size-mm", "30", "--up", "y", "--resolution", "40"});
  ASSERT_EQ(import.status, 0) << import.err;
  EXPECT_THAT(import.err, Not(HasSubstr("--unit")));
  EXPECT_EQ(run({"import", mesh_, "-o", project, "--size-mm", "30", "--unit", "m"}).status, 2);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"check", project, "--up", "y"},
        {"render", project, "-o", (folder_ / "a.png").string(), "--unit", "mm"}}) {
    const Ended refused = run(words);
    EXPECT_EQ(refused.status, 3) << words[0];
    EXPECT_THAT(refused.err, HasSubstr("is a project, in mm and z up; leave out --unit and --up"));
  }
}

TEST_F(MeshInput, RefusesOtherUnitsAndAxes) {
  EXPECT_EQ(run({"check", mesh_, "--unit", "km"}).status, 2);
  EXPECT_EQ(run({"check", mesh_, "--up", "x"}).status, 2);
}

}  // namespace
}  // namespace argil::test
