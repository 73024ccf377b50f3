// SPDX-License-Identifier: GPL-3.0-or-later
// Operations on the whole clay and tools of a mesh, as lines of a script.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "argil/engine/tool_mesh.h"
#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"
#include "argil/io/solid_file.h"
#include "argil/io/stroke_script.h"

#include "support/effort.h"
#include "support/scratch.h"
#include "support/shapes.h"
#include "support/stroke_script_file.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::fill;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kOperationsHeader = "{\"argil_strokes\":1,\"units\":\"mm\"}\n";

Clay ball() { return Clay::ball(8.0, {test::effort(0.6, 0.4), 0.1}).value(); }

/// Coordinates that no float holds.
TriangleMesh odd_rod() { return test::box_mesh({1.0 / 3.0, 0.7, 10.1}, {0.1, 0.2, 0.3}); }

Stroke rod_stroke(const TriangleMesh& rod) {
  Stroke stroke;
  stroke.tool = {Action::add, Shape::mesh, {1.0, 1.0, 3.0}, 1.0};
  stroke.tool.mesh = ToolMesh::make(rod).value();
  stroke.samples.push_back({0.0, {0.0, 0.0, 8.0}, {}, 1.0});
  return stroke;
}

Combine combination(CombineKind kind, const Vec3& at) {
  Combine with;
  with.kind = kind;
  with.placement = {at, {0.9, 0.1, 0.2, 1.0 / 3.0}};
  return with;
}

/// One of each, such that each can be applied after the one before.
StrokeScript one_of_each() {
  StrokeScript script;
  script.steps.push_back(rod_stroke(odd_rod()));
  script.steps.push_back(Offset{-0.3});
  Combine with = combination(CombineKind::unite, {7.0, 1.0, 0.0});
  with.mesh = std::make_shared<const TriangleMesh>(odd_rod());
  script.steps.push_back(with);
  with = combination(CombineKind::subtract, {0.0, -8.0, 0.0});
  with.clay = std::make_shared<const Clay>(Clay::ball(3.5, {0.4, 0.2}).value());
  script.steps.push_back(with);
  with = combination(CombineKind::intersect, {});
  with.mesh = std::make_shared<const TriangleMesh>(test::box_mesh({14.0, 20.0, 20.0}));
  script.steps.push_back(with);
  script.steps.push_back(Cut{{0.0, 0.0, -5.0}, {0.1, 0.0, 1.0}, true});
  script.steps.push_back(HistoryStep::undo);
  script.steps.push_back(Resample{0.3});
  script.steps.push_back(Hollow{1.2, {{{0.0, 0.0, 7.0}, {0.0, 0.0, -1.0}, 0.8}}});
  return script;
}

std::vector<std::uint64_t> hashes_of(const StrokeScript& script) {
  Clay clay = ball();
  std::vector<std::uint64_t> hashes;
  for (const ScriptStep& step : script.steps) {
    const auto done = apply_step(clay, step);
    EXPECT_TRUE(done) << done.error().message;
    hashes.push_back(clay.hash());
  }
  return hashes;
}

class ScriptOperation : public testing::Test {
 protected:
  fs::path file(const std::string& name = "a.strokes.jsonl") const { return folder_ / name; }

  Result<StrokeScript> read(const std::string& line) const {
    fill(file(), kOperationsHeader + line + "\n");
    return read_stroke_script(file());
  }
  /// What is wrong with a line, without its place.
  std::string error_of(const std::string& line) const {
    const auto script = read(line);
    if (script) return "";
    EXPECT_EQ(script.error().kind, ErrorKind::bad_input) << script.error().message;
    const std::string place = file().string() + ":2: ";
    EXPECT_THAT(script.error().message, testing::StartsWith(place));
    return script.error().message.substr(place.size());
  }

  test::ScratchFolder folder_;
};

using ScriptTool = ScriptOperation;

TEST_F(ScriptOperation, DoesTheSameReadBackAfterWriting) {
  const StrokeScript script = one_of_each();
  const auto written = test::write_stroke_script(file(), script);
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_EQ(folder_.names().size(), 4U) << "the script, a rod, a clay and a box, each once";
  const auto read = read_stroke_script(file());
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read.value().steps.size(), script.steps.size());
  EXPECT_EQ(hashes_of(read.value()), hashes_of(script));
  ASSERT_TRUE(test::write_stroke_script(file("b.strokes.jsonl"), read.value()));
  std::string again = content_of(file("b.strokes.jsonl"));
  for (std::size_t at = 0; (at = again.find("b.solid-")) != std::string::npos;) again[at] = 'a';
  EXPECT_EQ(again, content_of(file()));
}

TEST_F(ScriptOperation, IsReadAsAPersonWritesIt) {
  ASSERT_TRUE(write_mesh(file("box.stl"), test::box_mesh({2.0, 3.0, 4.0})));
  ASSERT_TRUE(save_project(file("other.VDB"), Clay::ball(4.0, {0.4, 0.1}).value()));
  const auto script = read(R"({"operation":"offset","distance_mm":-0.5}
{"operation":"hollow","wall_mm":2,"drains":[{"point_mm":[0,0,9],"direction":[0,0,-1],"radius_mm":1}]}
{"operation":"cut","point_mm":[0,1,0],"normal":[0,1,0]}
{"operation":"resample","voxel_mm":0.2}
{"operation":"union","with":"box.stl","position_mm":[1,2,3],"orientation":[0,1,0,0]}
{"operation":"difference","with":")" +
                           file("other.VDB").string() + "\"}");
  ASSERT_TRUE(script) << script.error().message;
  const auto step = [&](std::size_t n) { return std::get<Operation>(script.value().steps.at(n)); };
  EXPECT_EQ(std::get<Offset>(step(0)).distance_mm, -0.5);
  EXPECT_EQ(std::get<Hollow>(step(1)).wall_mm, 2.0);
  EXPECT_EQ(std::get<Hollow>(step(1)).drains.at(0).direction, (Vec3{0.0, 0.0, -1.0}));
  EXPECT_EQ(std::get<Cut>(step(2)).point_mm, (Vec3{0.0, 1.0, 0.0}));
  EXPECT_FALSE(std::get<Cut>(step(2)).keeps_front);
  EXPECT_EQ(std::get<Resample>(step(3)).voxel_mm, 0.2);
  const auto with = std::get<Combine>(step(4));
  EXPECT_EQ(with.kind, CombineKind::unite);
  EXPECT_EQ(with.mesh->triangles.size(), 12U);
  EXPECT_EQ(with.placement.position_mm, (Vec3{1.0, 2.0, 3.0}));
  EXPECT_EQ(with.placement.orientation, (Quat{0.0, 1.0, 0.0, 0.0}));
  EXPECT_NE(std::get<Combine>(step(5)).clay, nullptr);
  EXPECT_EQ(std::get<Combine>(step(5)).kind, CombineKind::subtract);
}

TEST_F(ScriptOperation, ClosesTheOtherMeshUnlessItsHashIsNamed) {
  const TriangleMesh open = test::without(test::ball_mesh(3.0, 2), 5);
  ASSERT_TRUE(write_mesh(file("open.ply"), open));
  const auto closed = read(R"({"operation":"union","with":"open.ply"})");
  ASSERT_TRUE(closed) << closed.error().message;
  const auto& with = std::get<Combine>(std::get<Operation>(closed.value().steps[0]));
  EXPECT_GE(with.mesh->triangles.size(), open.triangles.size() + 1);
  EXPECT_THAT(
      error_of(R"({"operation":"union","with":"open.ply","with_xxh64":"0123456789abcdef"})"),
      AllOf(HasSubstr("key 'with' cannot be used: '"), HasSubstr("open.ply' holds "),
            HasSubstr(" and not 0123456789abcdef: it was changed")));
  const auto as_it_is = read_operand(file("open.ply"), Closing::none);
  ASSERT_TRUE(as_it_is);
  EXPECT_EQ(as_it_is.value().mesh->triangles.size(), open.triangles.size());
}

TEST_F(ScriptOperation, NamesLineKeyAndRemedyOfWhatIsWrong) {
  struct Case {
    const char* line;
    const char* message;
  };
  const Case cases[] = {
      {R"({"operation":"melt"})",
       "key 'operation' is \"melt\"; must be one of 'offset', 'hollow', 'cut', 'resample', "
       "'union', 'difference', 'intersection'"},
      {R"({"operation":3})",
       "key 'operation' is 3; must be one of 'offset', 'hollow', 'cut', 'resample', 'union', "
       "'difference', 'intersection'"},
      {R"({"operation":"offset"})",
       "key 'distance_mm' is missing; give the distance outward, negative for inward"},
      {R"({"operation":"offset","distance_mm":"1"})",
       "key 'distance_mm' is \"1\"; must be a number"},
      {R"({"operation":"offset","distance":1})",
       "key 'distance' is not known; did you mean 'distance_mm'?"},
      {R"({"operation":"offset","distance_mm":1e999})",
       "a number is too large to represent; must be finite"},
      {R"({"operation":"offset","distance_mm":1,"tool":"add"})",
       "key 'tool' is not known; did you mean 'operation'?"},
      {R"({"operation":"hollow"})", "key 'wall_mm' is missing; give the wall's thickness"},
      {R"({"operation":"hollow","wall_mm":0})", "key 'wall_mm' is 0; must be greater than 0"},
      {R"({"operation":"hollow","wall_mm":1,"drains":{}})",
       "key 'drains' is {}; must be a list of drains {...}"},
      {R"({"operation":"hollow","wall_mm":1,"drains":[3]})", "key 'drains[0]' is 3; must be {...}"},
      {R"({"operation":"hollow","wall_mm":1,"drains":[{"point_mm":[0,0,1],"radius_mm":1}]})",
       "key 'drains[0].direction' is missing; a drain has 'point_mm', 'direction' and 'radius_mm'"},
      {R"({"operation":"hollow","wall_mm":1,"drains":[{"point_mm":[0,0,1],"direction":[0,1],"radius_mm":1}]})",
       "key 'drains[0].direction' is [0,1]; must be three numbers [x, y, z]"},
      {R"({"operation":"cut","normal":[0,0,1]})",
       "key 'point_mm' is missing; give a point [x, y, z]"},
      {R"({"operation":"cut","point_mm":[0,0,null],"normal":[0,0,1]})",
       "key 'point_mm' is [0,0,null]; must be three numbers [x, y, z]"},
      {R"({"operation":"cut","point_mm":[0,0,0],"normal":[0,0,1],"keeps_front":1})",
       "key 'keeps_front' is 1; must be true or false"},
      {R"({"operation":"resample","voxel_mm":-1})", "key 'voxel_mm' is -1; must be greater than 0"},
      {R"({"operation":"union"})",
       "key 'with' is missing; name a file, seen from the script's folder"},
      {R"({"operation":"union","with":["a.stl"]})",
       "key 'with' is [\"a.stl\"]; must be the name of a file"},
      {R"({"operation":"union","with":""})", "key 'with' is \"\"; must be the name of a file"},
      {R"({"operation":"union","with":"a\u0000.stl"})",
       "key 'with' is \"a\\u0000.stl\"; must be the name of a file"},
      {R"({"operation":"union","with":"a.stl","with_xxh64":"12"})",
       "key 'with_xxh64' is \"12\"; must be a hash of 16 hexadecimal digits"},
      {R"({"operation":"union","with":"a.stl","orientation":[0,0,0,0]})",
       "key 'orientation' is [0,0,0,0]; must be a quaternion [w, x, y, z] of any length but zero"},
      {R"({"operation":"union","with":"a.stl","position_mm":5})",
       "key 'position_mm' is 5; must be three numbers [x, y, z]"},
  };
  for (const Case& c : cases) EXPECT_EQ(error_of(c.line), c.message) << c.line;
}

TEST_F(ScriptOperation, RefusesASolidThatIsNotThereOrCannotBeRead) {
  const auto with = [&](const std::string& name) {
    return error_of(R"({"operation":"union","with":")" + name + "\"}");
  };
  EXPECT_THAT(with("gone.stl"), HasSubstr("gone.stl' is not there; put it back, or name another"));
  fill(file("cut.stl"), "solid\nfacet");
  EXPECT_THAT(with("cut.stl"), HasSubstr("key 'with' cannot be used: "));
  EXPECT_THAT(with("a.strokes.jsonl"), HasSubstr("is not a mesh format")) << "the script itself";
  fill(file("torn.vdb"), std::string(100, 'x'));
  EXPECT_THAT(with("torn.vdb"), HasSubstr("is not a VDB file"));
  fs::create_symlink("loop.stl", file("loop.stl"));
  EXPECT_THAT(with("loop.stl"), HasSubstr("is not there"));
  fill(file("huge.stl"), std::string(80, 'h') + "\xff\xff\xff\xff" + std::string(50, '\0'));
  EXPECT_THAT(with("huge.stl"), HasSubstr("promises 4294967295 triangles"));
  EXPECT_THAT(with("../" + std::string(5000, 'n') + ".stl"), HasSubstr("is not there"));
}

TEST_F(ScriptOperation, RefusesAFolderOrPipeAsSolidAtOnce) {
  fs::create_directory(file("folder.stl"));
  ASSERT_EQ(::mkfifo(file("pipe.stl").c_str(), 0600), 0);
  for (const char* name : {"folder.stl", "pipe.stl"}) {
    const auto script = read(R"({"operation":"union","with":")" + std::string(name) + "\"}");
    ASSERT_FALSE(script) << name;
    EXPECT_THAT(script.error().message,
                AllOf(HasSubstr(":2: key 'with' cannot be used: "), HasSubstr(name)));
  }
}

TEST_F(ScriptOperation, IsNotWrittenWhenItCouldNotBeReadBack) {
  StrokeScript script;
  script.steps.push_back(combination(CombineKind::unite, {}));
  auto written = test::write_stroke_script(file(), script);
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("stroke 0: a combination takes another clay"));
  script.steps[0] = Offset{std::numeric_limits<double>::infinity()};
  written = test::write_stroke_script(file(), script);
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("not finite"));
  EXPECT_THAT(folder_.names(), testing::IsEmpty());
}

TEST_F(ScriptTool, TakesAMeshSeenFromTheScriptsFolder) {
  fs::create_directory(file("meshes"));
  ASSERT_TRUE(write_mesh(file("meshes/rod.obj"), odd_rod()));
  const auto script = read(
      R"({"tool":"carve","shape":"mesh","mesh":"meshes/rod.obj","radii_mm":[1,1,4],"poses":[[0,0,0,8]]})");
  ASSERT_TRUE(script) << script.error().message;
  const auto& stroke = std::get<Stroke>(script.value().steps[0]);
  ASSERT_NE(stroke.tool.mesh, nullptr);
  EXPECT_NEAR(stroke.tool.mesh->half_extents().z, 5.05, 1e-6);
  Clay clay = ball();
  const std::uint64_t before = clay.hash();
  ASSERT_TRUE(apply_step(clay, script.value().steps[0]));
  EXPECT_NE(clay.hash(), before);
}

TEST_F(ScriptTool, NamesWhatIsWrongWithItsMesh) {
  ASSERT_TRUE(write_mesh(file("open.stl"), test::without(odd_rod(), 3)));
  const auto with = [&](const std::string& more) {
    return error_of(R"({"tool":"add",)" + more + R"(,"radii_mm":[1,1,1],"poses":[[0,0,0,0]]})");
  };
  EXPECT_EQ(with(R"("shape":"mesh")"),
            "key 'mesh' is missing; name a file, seen from the script's folder");
  EXPECT_EQ(with(R"("shape":"mesh","mesh":4)"), "key 'mesh' is 4; must be the name of a file");
  EXPECT_THAT(with(R"("shape":"mesh","mesh":"gone.stl")"), HasSubstr("gone.stl' is not there"));
  EXPECT_THAT(with(R"("shape":"mesh","mesh":"open.stl")"),
              AllOf(HasSubstr("open.stl': the tool's mesh is open"), HasSubstr("close its holes")));
  EXPECT_THAT(with(R"("shape":"mesh","mesh":"piece.vdb")"), HasSubstr("is not there"));
  EXPECT_EQ(with(R"("shape":"box","mesh":"open.stl")"),
            "key 'mesh' is \"open.stl\"; must be absent unless 'shape' is \"mesh\"");
  EXPECT_THAT(error_of(R"({"tool":"smooth","shape":"mesh","mesh":"open.stl","radii_mm":[1,1,1],)"
                       R"("poses":[[0,0,0,0]]})"),
              HasSubstr("open"));
}

}  // namespace
}  // namespace argil::io
