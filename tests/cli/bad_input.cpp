// SPDX-License-Identifier: GPL-3.0-or-later
// Files that cannot be used: exit status 3, a message that names thing, value and remedy, nothing
// written.
#include <cmath>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// A file in a folder of its own, so that anything written beside it shows.
struct OneFile {
  OneFile(const std::string& name, const std::string& content) : file((folder / name).string()) {
    fill(file, content);
  }
  ScratchFolder folder;
  std::string file;
};

/// Runs, expects status 3 in both forms of output and no new file; returns the message.
std::string refusal(const OneFile& input, const std::vector<std::string>& arguments) {
  const std::vector<std::string> before = input.folder.names();
  std::vector<std::string> with_json = arguments;
  with_json.push_back("--json");
  const Ended run = run_argil(with_json);
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_EQ(input.folder.names(), before) << "something was written";
  const nlohmann::json json = run.json();
  if (!json.contains("error")) return run.out;
  EXPECT_EQ(json.at("error").at("kind"), "bad_input");
  const std::string message = json.at("error").at("message");
  EXPECT_EQ(run.err, "argil: " + message + "\n");
  return message;
}

std::string import_refusal(const std::string& name, const std::string& content,
                           const std::vector<std::string>& more = {}) {
  const OneFile input(name, content);
  std::vector<std::string> arguments{"import", input.file, "-o",
                                     (input.folder / "out.vdb").string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const std::string message = refusal(input, arguments);
  const bool names_it = message.find(name) != std::string::npos ||
                        message.find("mesh") != std::string::npos ||
                        message.find("voxel") != std::string::npos;
  EXPECT_TRUE(names_it) << message;
  return message;
}

std::string strokes_refusal(const std::string& line) {
  const OneFile input("s.strokes.jsonl",
                      R"({"argil_strokes":1,"start":{"shape":"ball","radius_mm":5}})"
                      "\n" +
                          line + "\n");
  return refusal(input,
                 {"sculpt", "--strokes", input.file, "-o", (input.folder / "q.vdb").string()});
}

std::string scaled_box(double size_mm) { return obj_text(box_mesh({size_mm, size_mm, size_mm})); }

std::string lying_stl() {
  std::string bytes(84 + 2 * 50, '\0');
  const std::uint32_t count = 1'000'000;
  std::memcpy(bytes.data() + 80, &count, sizeof count);
  return bytes;
}

TEST(CliBadInput, RefusesMissingFilesAndFolders) {
  const OneFile input("a.txt", "x");
  const std::string gone = (input.folder / "gone.obj").string();
  EXPECT_THAT(refusal(input, {"check", gone}), HasSubstr("gone.obj': no such file"));
  EXPECT_THAT(refusal(input, {"info", gone}), HasSubstr("gone.obj': no such file"));
  EXPECT_THAT(refusal(input, {"check", input.folder.path().string()}), HasSubstr("it is a folder"));
}

TEST(CliBadInput, RefusesEmptyMeshFiles) {
  for (const char* name : {"a.obj", "a.stl", "a.ply", "a.3mf"}) {
    EXPECT_THAT(import_refusal(name, ""), HasSubstr("is empty"));
  }
}

TEST(CliBadInput, RefusesEndingsItDoesNotRead) {
  EXPECT_THAT(import_refusal("a.step", "ISO-10303-21;"), HasSubstr(".step"));
}

TEST(CliBadInput, RefusesNanAndInfinity) {
  for (const char* bad : {"nan", "inf", "-inf", "1e999"}) {
    const std::string text = "v 0 0 0\nv 1 0 " + std::string(bad) + "\nv 0 1 0\nf 1 2 3\n";
    EXPECT_THAT(import_refusal("a.obj", text), HasSubstr("2")) << bad;  // the line
  }
}

TEST(CliBadInput, RefusesMeshesWithoutTriangles) {
  EXPECT_THAT(import_refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), HasSubstr("triangle"));
}

TEST(CliBadInput, RefusesFlatMeshes) {
  EXPECT_THAT(import_refusal("a.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\nf 1 3 2\n"),
              HasSubstr("volume"));
}

TEST(CliBadInput, RefusesSizesThatAreNoObject) {
  EXPECT_THAT(import_refusal("a.obj", scaled_box(1e5)),
              AllOf(HasSubstr("is 100000 mm across"), HasSubstr("--size-mm")));
  EXPECT_THAT(import_refusal("a.obj", scaled_box(1e12)),
              AllOf(HasSubstr("a.obj:"), HasSubstr("at most 1e+06 are possible")));
  EXPECT_THAT(import_refusal("a.obj", scaled_box(1e-12)),
              AllOf(HasSubstr("is 1e-12 mm across"), HasSubstr("--size-mm")));
}

TEST(CliBadInput, RefusesFacesThatNameMissingVertices) {
  EXPECT_THAT(import_refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"),
              AllOf(HasSubstr("4"), HasSubstr("vert")));
}

TEST(CliBadInput, RefusesAnStlWhoseCountLies) {
  EXPECT_THAT(import_refusal("a.stl", lying_stl()), HasSubstr("1000000"));
}

TEST(CliBadInput, RefusesVoxelsThatWouldNotFitInMemory) {
  const std::string message = import_refusal("a.obj", scaled_box(5000.0), {"--voxel-mm", "0.02"});
  EXPECT_THAT(message, HasSubstr("mm or larger"));
}

TEST(CliBadInput, TakesNoMoreMemoryThanItIsLet) {
  std::string text;
  for (int i = 0; i < 8'000'000; ++i) text += "v 0 0 0\n";
  const OneFile input("a.obj", text);
  const Ended run = run_argil({"check", input.file, "--max-memory", "0.25", "--json"});
  EXPECT_EQ(run.status, 5);
  EXPECT_EQ(run.json().at("error").at("kind"), "memory");
  EXPECT_THAT(run.err, HasSubstr("(--max-memory is 0.25 GB)"));
}

/// Two balls turned against each other, one of them wavy: their surfaces cross everywhere.
std::string crossing_balls(int splits) {
  TriangleMesh wavy = ball_mesh(10.0, splits);
  const Quat turn = normalized(Quat{0.9, 0.2, 0.3, 0.1});
  for (Vec3& p : wavy.positions) {
    const double wave = std::sin(4.0 * p.x) * std::sin(4.0 * p.y + 1.0) * std::sin(4.0 * p.z + 2.0);
    p = (1.0 + 0.02 * wave) * rotate(turn, p);
  }
  return obj_text(joined(ball_mesh(10.0, splits), wavy));
}

/// Exact numbers of crossing parts, made by a library that would abort.
TEST(CliBadInput, UnitesPartsWithNoMoreMemoryThanItIsLet) {
  const OneFile input("a.obj", crossing_balls(6));
  const Ended run = run_argil({"repair", input.file, "-o", (input.folder / "b.stl").string(),
                               "--max-memory", "0.25", "--json"});
  EXPECT_EQ(run.signal, 0) << run.err;
  EXPECT_EQ(run.status, 5) << run.err;
  EXPECT_EQ(run.json().at("error").at("kind"), "memory");
  EXPECT_THAT(run.err, AllOf(HasSubstr("a.obj"), HasSubstr("(--max-memory is 0.25 GB)")));
  EXPECT_THAT(input.folder.names(), ElementsAre("a.obj"));
}

/// An estimate that does not fit is the voxel's fault; memory that runs out under way is not.
TEST(CliBadInput, TellsAVoxelThatDoesNotFitFromMemoryThatRanOut) {
  const auto imported = [](const OneFile& input, const char* resolution) {
    return run_argil({"import", input.file, "-o", (input.folder / "p.vdb").string(), "--resolution",
                      resolution, "--max-memory", "0.25", "--json"});
  };
  const OneFile fine("a.obj", crossing_balls(6));
  const Ended refused = imported(fine, "1000");
  EXPECT_EQ(refused.status, 3) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("mm or larger"));
  EXPECT_THAT(refused.err, Not(HasSubstr("--max-memory is 0.25 GB")));
  // Every voxel fits, but the mesh itself does not.
  std::string text = obj_text(ball_mesh(10.0, 3));
  for (int i = 0; i < 8'000'000; ++i) text += "v 0 0 0\n";
  const OneFile large("b.obj", text);
  const Ended ran_out = imported(large, "40");
  EXPECT_EQ(ran_out.status, 5) << ran_out.err;
  EXPECT_THAT(ran_out.err, HasSubstr("--max-memory is 0.25 GB"));
  EXPECT_THAT(ran_out.err, Not(HasSubstr("mm or larger")));
}

TEST(CliBadInput, NamesTheFileWhoseTrianglesAreAtFault) {
  const OneFile flat("flat.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\nf 1 3 2\n");
  const std::string out = (flat.folder / "out.stl").string();
  EXPECT_THAT(refusal(flat, {"repair", flat.file, "-o", out}),
              AllOf(StartsWith("'" + flat.file + "': "), HasSubstr("flat")));
  EXPECT_THAT(import_refusal("flat.obj", content_of(flat.file)), HasSubstr("flat.obj': "));
  const std::string line = "v 0 0 0\nv 9 0 0\nv 5 0 0\nf 1 2 3\n";
  EXPECT_THAT(import_refusal("line.obj", line),
              AllOf(HasSubstr("line.obj': "), HasSubstr("no triangle with an area")));
}

TEST(CliBadInput, NamesLineAndValueOfAMotion) {
  const OneFile input("m.csv", "0,0,20,0,0\n1,0,1e308,0,3\n");
  EXPECT_THAT(refusal(input, {"bridge", "--lockstep", "--motion", input.file, "--port", "0"}),
              AllOf(HasSubstr("m.csv' line 2 has '1e308'"), HasSubstr("-1e6 to 1e6")));
  fill(input.file, "0,0,20,0,0\n1,0,-1000001,0,3\n");
  EXPECT_THAT(refusal(input, {"bridge", "--lockstep", "--motion", input.file, "--port", "0"}),
              HasSubstr("'-1000001'"));
}

TEST(CliBadInput, RefusesStartsThatWouldNotFitInMemory) {
  const OneFile input(
      "s.strokes.jsonl",
      R"({"argil_strokes":1,"start":{"shape":"ball","radius_mm":1e9,"voxel_mm":0.001}})"
      "\n");
  EXPECT_THAT(
      refusal(input, {"sculpt", "--strokes", input.file, "-o", (input.folder / "q.vdb").string()}),
      HasSubstr("start: "));
}

TEST(CliBadInput, RefusesOpenMeshesWhenRepairIsOff) {
  const std::string text = obj_text(without(box_mesh({10.0, 10.0, 10.0}), 0));
  EXPECT_THAT(import_refusal("a.obj", text, {"--repair", "none"}),
              AllOf(HasSubstr("has 3 open edges"), HasSubstr("--repair auto")));
}

TEST(CliBadInput, NamesLineAndKeyOfStrokes) {
  EXPECT_THAT(
      strokes_refusal(R"({"tool":"add","shape":"ball","radius_mm":"4","poses":[[0,0,0,0]]})"),
      HasSubstr("s.strokes.jsonl:2: key 'radius_mm' is \"4\"; must be a number"));
  EXPECT_THAT(
      strokes_refusal(R"({"tool":"drill","shape":"ball","radius_mm":4,"poses":[[0,0,0,0]]})"),
      HasSubstr("s.strokes.jsonl:2: key 'tool' is \"drill\"; must be one of 'add'"));
  EXPECT_THAT(
      strokes_refusal(R"({"tool":"add","shape":"ball","radius_mm":-4,"poses":[[0,0,0,0]]})"),
      HasSubstr("s.strokes.jsonl:2: key 'radius_mm' is -4; must be greater than 0"));
}

TEST(CliBadInput, RefusesProjectsThatAreNotOurs) {
  const OneFile input("p.vdb", "");
  const std::vector<std::vector<std::string>> readers{
      {"info", input.file},
      {"export", input.file, "-o", (input.folder / "o.stl").string()},
      {"render", input.file, "-o", (input.folder / "o.png").string()},
      {"force", input.file, "--tool", "ball:1", "--at", "0,0,0"}};
  for (const auto& arguments : readers) {
    EXPECT_THAT(refusal(input, arguments), HasSubstr("p.vdb' is empty")) << arguments[0];
  }
  fill(input.file, scaled_box(10.0));
  for (const auto& arguments : readers) {
    EXPECT_THAT(refusal(input, arguments), HasSubstr("p.vdb' is not a VDB file")) << arguments[0];
  }
  openvdb::initialize();
  openvdb::io::File(input.file)
      .write({openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(5.0F, {}, 0.5F)});
  for (const auto& arguments : readers) {
    EXPECT_THAT(refusal(input, arguments), HasSubstr("is a VDB but not a project of Argil"));
  }
}

TEST(CliBadInput, RefusesTruncatedProjects) {
  const OneFile input("s.strokes.jsonl", kSmallScript);
  const std::string project = (input.folder / "p.vdb").string();
  ASSERT_EQ(run_argil({"sculpt", "--strokes", input.file, "-o", project}).status, 0);
  const std::string bytes = content_of(project);
  // Every 97th byte is tried inside one process by ProjectFile.RefusesEveryTruncation.
  for (const std::size_t length : {bytes.size() - 1, bytes.size() / 2, std::size_t{97}}) {
    fill(project, bytes.substr(0, length));
    EXPECT_THAT(refusal(input, {"info", project}), HasSubstr("p.vdb")) << length;
  }
}

}  // namespace
}  // namespace argil::test
