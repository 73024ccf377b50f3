// SPDX-License-Identifier: GPL-3.0-or-later
// What the program says to a command line it cannot use: exit status 2, option, value, remedy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::string usage_error(const std::vector<std::string>& arguments) {
  const Ended run = run_argil(arguments);
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, StartsWith("argil: "));
  return run.err;
}

TEST(CliUsage, PrintsHelpAndVersion) {
  for (const char* command : {"import", "info", "sculpt", "export", "check", "render", "force"}) {
    const Ended all = run_argil({"--help"});
    EXPECT_EQ(all.status, 0);
    EXPECT_THAT(all.out, HasSubstr(command));
    const Ended one = run_argil({command, "--help"});
    EXPECT_EQ(one.status, 0);
    EXPECT_THAT(one.out, AllOf(HasSubstr("--json"), HasSubstr("--threads"), HasSubstr("--quiet")));
  }
  const Ended version = run_argil({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, testing::MatchesRegex("argil [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(CliUsage, AsksForASubcommand) {
  EXPECT_THAT(usage_error({}), HasSubstr("--help"));
  EXPECT_THAT(usage_error({"sculp"}),
              HasSubstr("'sculp' is not a command; must be one of import, info, sculpt"));
  EXPECT_THAT(usage_error({"info"}), HasSubstr("PROJECT"));
  EXPECT_THAT(usage_error({"info", "a.vdb", "--colour"}), HasSubstr("--colour"));
}

TEST(CliUsage, RefusesCoordinatesThatAreNotThreeNumbers) {
  for (const char* at : {"1,2", "1,2,nan", "1,2,inf", "1,2,3,4", "", "1,,3", "1, 2, 3", "a,b,c",
                         "1,2,3mm", "1e999,0,0"}) {
    EXPECT_THAT(usage_error({"force", "a.vdb", "--tool", "ball:1", "--at", at}),
                HasSubstr("--at is '" + std::string(at) + "'; must be three numbers X,Y,Z"));
  }
}

/// Eq. 3 to 8 of Blanch et al. 2004, by the same names wherever something is felt.
TEST(CliUsage, RefusesWeightsAndFiltersOutOfRangeByNameValueAndRange) {
  const auto refused = [](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return usage_error(words);
  };
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"lab", "clay"}, {"view"}, {"bridge", "--clay", "some.vdb"}}) {
    for (const char* gain : {"0", "0.0001", "1.5", "nan"}) {
      EXPECT_THAT(refused(command, {"--filter", gain}),
                  AllOf(HasSubstr("--filter is '" + std::string(gain) + "'; must be"),
                        HasSubstr("0.001 to 1")));
    }
    EXPECT_THAT(refused(command, {"--filter", "0.2", "--filter-lambda", "11"}),
                AllOf(HasSubstr("--filter-lambda is '11'; must be"), HasSubstr("10")));
    EXPECT_THAT(refused(command, {"--filter-lambda", "1"}), HasSubstr("--filter"));
    EXPECT_THAT(refused(command, {"--mix-passive", "1"}),
                HasSubstr("DRAG of --mix-passive CONTACT,DRAG is ''; must be"));
    EXPECT_THAT(refused(command, {"--mix-passive", "1,0.3,4"}), HasSubstr("is '0.3,4'; must be"));
    EXPECT_THAT(refused(command, {"--mix-active", "0,1"}),
                AllOf(HasSubstr("CONTACT of --mix-active CONTACT,DRAG is '0'; must be"),
                      HasSubstr("0.01 to 2")));
    EXPECT_THAT(refused(command, {"--mix-active", "0.3,2.1"}), HasSubstr("is '2.1'; must be"));
    EXPECT_THAT(refused(command, {"--mix-active", "1.5,2"}),
                AllOf(HasSubstr("CONTACT of --mix-passive is 1 and CONTACT of --mix-active is 1.5"),
                      HasSubstr("CONTACT of --mix-passive must be greater than CONTACT of "
                                "--mix-active")));
    EXPECT_THAT(refused(command, {"--mix-ramp", "2.5"}),
                AllOf(HasSubstr("--mix-ramp is '2.5'; must be"), HasSubstr("0 to 2")));
  }
  EXPECT_THAT(usage_error({"bridge", "--mix-ramp", "1"}), HasSubstr("--clay"));
  EXPECT_THAT(usage_error({"lab", "sphere", "--mix-ramp", "0.1"}),
              HasSubstr("--mix-ramp is of the scene 'clay'"))
      << "the usual value too";
  EXPECT_THAT(usage_error({"lab", "sphere", "--mix-ramp", "1"}),
              HasSubstr("is of the scene 'clay'; SCENE is 'sphere'"));
}

TEST(CliUsage, RefusesToolsItDoesNotKnow) {
  for (const char* tool : {"cube:3", "ball", "3", "ellipsoid:1,0,2"}) {
    EXPECT_THAT(usage_error({"force", "a.vdb", "--at", "0,0,0", "--tool", tool}),
                HasSubstr("--tool is '" + std::string(tool) + "'; must be ball:R, ellipsoid"));
  }
  EXPECT_THAT(usage_error({"force", "a.vdb", "--at", "0,0,0", "--tool", "ball:-1"}),
              HasSubstr("--tool ball:R is '-1'; must be a number greater than 0"));
  EXPECT_THAT(usage_error({"force", "a.vdb", "--at", "0,0,0", "--tool", "ellipsoid:1,2"}),
              HasSubstr("--tool ellipsoid:A,B,C is '1,2'; must be three numbers"));
}

TEST(CliUsage, RefusesNumbersOutOfRange) {
  const auto import = [](const std::string& option, const std::string& value) {
    return usage_error({"import", "a.obj", "-o", "a.vdb", option, value});
  };
  EXPECT_THAT(import("--voxel-mm", "0"),
              HasSubstr("--voxel-mm is '0'; must be a number from 0.0001 to 1000"));
  EXPECT_THAT(import("--voxel-mm", "nan"), HasSubstr("--voxel-mm is 'nan'; must be a number"));
  EXPECT_THAT(import("--size-mm", "-3"), HasSubstr("--size-mm is '-3'; must be a number greater"));
  EXPECT_THAT(import("--resolution", "1"),
              HasSubstr("--resolution is '1'; must be a whole number"));
  EXPECT_THAT(import("--resolution", "2.5"), HasSubstr("--resolution is '2.5'; must be a whole"));
  EXPECT_THAT(import("--repair", "maybe"), HasSubstr("--repair is 'maybe'; must be one of auto"));
  EXPECT_THAT(import("--threads", "0"),
              HasSubstr("--threads is '0'; must be a whole number from 1"));
  EXPECT_THAT(
      usage_error({"import", "a.obj", "-o", "a.vdb", "--voxel-mm", "1", "--resolution", "100"}),
      HasSubstr("--resolution"));
}

/// Nothing lies beyond a kilometre; a number that only this input makes too large is status 3.
TEST(CliUsage, RefusesLengthsAndPlacesBeyondAKilometre) {
  for (const char* value : {"1000001", "1e7", "1.7e308"}) {
    EXPECT_THAT(usage_error({"import", "a.obj", "-o", "a.vdb", "--size-mm", value}),
                HasSubstr("--size-mm is '" + std::string(value) +
                          "'; must be a number greater than 0, at most 1e+06"));
    EXPECT_THAT(usage_error({"force", "a.vdb", "--tool", "ball:1", "--at",
                             "0,-" + std::string(value) + ",0"}),
                HasSubstr("must be three numbers from -1e+06 to 1e+06"));
    EXPECT_THAT(usage_error({"edit", "a.vdb", "-o", "b.vdb", "--cut",
                             "0,0," + std::string(value) + ",0,0,1"}),
                HasSubstr("must be a number from -1e+06 to 1e+06"));
    EXPECT_THAT(
        usage_error({"force", "a.vdb", "--at", "0,0,0", "--tool", "ball:" + std::string(value)}),
        HasSubstr("at most 1e+06"));
  }
}

TEST(CliUsage, RefusesOutputNamesOfAnotherFormat) {
  EXPECT_THAT(usage_error({"import", "a.obj", "-o", "a.stl"}), HasSubstr("ending in one of .vdb"));
  EXPECT_THAT(usage_error({"export", "a.vdb", "-o", "a.step"}),
              HasSubstr("'a.step'; must be a file name ending in one of .3mf, .stl, .obj, .ply"));
  EXPECT_THAT(usage_error({"render", "a.vdb", "-o", "a.jpg"}), HasSubstr("ending in one of .png"));
}

TEST(CliUsage, RefusesOptionsOfMeshesForAField) {
  EXPECT_THAT(usage_error({"export", "a.vdb", "-o", "b.vdb", "--triangles", "1000"}),
              HasSubstr("--triangles is for meshes, which -o does not name"));
}

TEST(CliUsage, RefusesPartsWhereTheFormatHasNone) {
  for (const char* file : {"b.stl", "b.vdb", "b.glb"}) {
    EXPECT_THAT(usage_error({"export", "a.vdb", "-o", file, "--parts"}),
                HasSubstr("--parts is for .3mf files, which -o does not name"));
  }
}

TEST(CliUsage, RefusesPicturesItCannotMake) {
  for (const char* size : {"100", "100x", "x100", "0x100", "100x99999", "100x100x100", "-5x100"}) {
    EXPECT_THAT(usage_error({"render", "a.vdb", "-o", "a.png", "--size", size}),
                HasSubstr("--size is '" + std::string(size) + "'; must be WIDTHxHEIGHT"));
  }
  EXPECT_THAT(usage_error({"render", "a.vdb", "-o", "a.png", "--view", "behind"}),
              HasSubstr("--view is 'behind'; must be iso, front"));
}

TEST(CliUsage, AnswersInJsonWhenAsked) {
  const Ended run = run_argil({"force", "a.vdb", "--tool", "ball:1", "--at", "1,2", "--json"});
  EXPECT_EQ(run.status, 2);
  const nlohmann::json error = run.json().at("error");
  EXPECT_EQ(error.at("kind"), "usage");
  EXPECT_EQ(error.at("status"), 2);
  EXPECT_THAT(error.at("message").get<std::string>(), StartsWith("--at is '1,2'; must be"));
}

TEST(CliUsage, WantsSomethingToSculpt) {
  const ScratchFolder folder;
  fill(folder / "a.strokes.jsonl", "{\"argil_strokes\":1}\n");
  const Ended run = run_argil({"sculpt", "--strokes", (folder / "a.strokes.jsonl").string(), "-o",
                               (folder / "a.vdb").string()});
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, HasSubstr("has no 'start' and no project was given; name a project"));
  EXPECT_THAT(folder.names(), testing::ElementsAre("a.strokes.jsonl"));
}

TEST(CliUsage, NamesAFolderThatIsNotThereBeforeItWorks) {
  const ScratchFolder folder;
  fill(folder / "a.strokes.jsonl", kSmallScript);
  const Ended run = run_argil({"sculpt", "--strokes", (folder / "a.strokes.jsonl").string(), "-o",
                               (folder / "missing/a.vdb").string()});
  EXPECT_EQ(run.status, 5);
  EXPECT_THAT(run.err, AllOf(HasSubstr("there is no folder"), HasSubstr("create it first")));
}

}  // namespace
}  // namespace argil::test
