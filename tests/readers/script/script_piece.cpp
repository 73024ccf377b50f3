// SPDX-License-Identifier: GPL-3.0-or-later
// Edits of the list of pieces, as lines of a script.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"
#include "argil/io/stroke_script.h"

#include "script/script_line.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ScriptPiece : public testing::Test {
 protected:
  Result<ScriptLine> read(const std::string& line) {
    return read_script_line({"s.strokes.jsonl", 7}, line, solids_);
  }

  test::ScratchFolder folder_;
  SolidReader solids_{folder_.path()};
};

TEST_F(ScriptPiece, LinesAreReadAsTheyWereWritten) {
  ASSERT_TRUE(save_project(folder_ / "ball.vdb", Clay::ball(4.0, {0.5, 0.1}).value()));
  ASSERT_TRUE(write_mesh(folder_ / "box.stl", test::box_mesh({3.0, 4.0, 5.0})));
  const std::vector<std::string> lines{
      R"({"piece":"select","name":"Näse"})",
      R"({"piece":"add","name":"Ball","of":"ball.vdb"})",
      R"({"piece":"add","name":"Box","of":"box.stl","voxel_mm":0.25,"position_mm":[1.0,2.5,-3.0],)"
      R"("orientation":[1.0,0.0,0.0,0.0],"visible":false,"locked":true,"color":"#0a1bff"})",
      R"({"piece":"copy","name":"Box","copy":"Box 2"})",
      R"({"piece":"remove","name":"Box"})",
      R"({"piece":"change","name":"Box","new_name":"Crate","position_mm":[0.1,0.0,0.0],)"
      R"("orientation":[0.0,1.0,0.0,0.0],"visible":true,"locked":false,"color":null})",
      R"({"piece":"change","name":"Box","color":"#ffffff"})",
      R"({"piece":"place","places":[{"name":"Box","position_mm":[0.1,0.0,0.0],)"
      R"("orientation":[0.0,1.0,0.0,0.0]},{"name":"Ball","position_mm":[1.0,2.0,3.0],)"
      R"("orientation":[1.0,0.0,0.0,0.0]}]})",
      R"({"piece":"scale","name":"Box","factor":1.5})",
      R"({"piece":"scale","name":"Box","factor":0.1,"about_mm":[1.0,-2.0,0.5]})",
      R"({"piece":"split","name":"Box"})",
      R"({"piece":"split","name":"Box","crumb_share":0.0})",
      R"({"piece":"union","name":"Box","other":"Ball"})",
      R"({"piece":"difference","name":"Box","other":"Ball","keeps_other":true})",
      R"({"piece":"intersection","name":"Box","other":"Ball"})"};
  for (const std::string& line : lines) {
    const auto read_back = read(line);
    ASSERT_TRUE(read_back) << read_back.error().message;
    const auto& step = std::get<ScriptStep>(read_back.value());
    ASSERT_TRUE(std::holds_alternative<PieceEdit>(step));
    const bool is_box = line.find("box.stl") != std::string::npos;
    EXPECT_EQ(step_line(step, {is_box ? "box.stl" : "ball.vdb", ""}), line);
    EXPECT_TRUE(validate_step(step));
    EXPECT_EQ(solid_of(step).has_value(), line.find("\"add\"") != std::string::npos);
  }
}

TEST_F(ScriptPiece, RefusesWhatIsNoEditByLineAndKey) {
  ASSERT_TRUE(save_project(folder_ / "ball.vdb", Clay::ball(4.0, {0.5, 0.1}).value()));
  const auto refuses = [&](const std::string& line, const std::string& message) {
    const auto read_back = read(line);
    ASSERT_FALSE(read_back) << line;
    EXPECT_EQ(read_back.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(read_back.error().message,
                AllOf(HasSubstr("s.strokes.jsonl:7"), HasSubstr(message)));
  };
  refuses(R"({"piece":"melt","name":"A"})", "'piece'");
  refuses(R"({"piece":"place"})", "'places'");
  refuses(R"({"piece":"place","places":[]})", "'places'");
  refuses(R"({"piece":"place","places":[3]})", "'places'");
  refuses(R"({"piece":"place","places":[{"name":"A","position_mm":[1,2,3]}]})",
          "'places[0].orientation'");
  refuses(R"({"piece":"place","places":[{"name":"A","position_mm":[1,2,3e9],)"
          R"("orientation":[1,0,0,0]}]})",
          "1 km");
  refuses(R"({"piece":"scale","name":"A"})", "'factor'");
  refuses(R"({"piece":"scale","name":"A","factor":0})", "'factor'");
  refuses(R"({"piece":"scale","name":"A","factor":-2})", "'factor'");
  refuses(R"({"piece":"scale","name":"A","factor":2,"about_mm":[1,2]})", "'about_mm'");
  refuses(R"({"piece":"scale","name":"A","factor":2,"about_mm":[1,2,3e9]})", "1 km");
  refuses(R"({"piece":"split"})", "'name'");
  refuses(R"({"piece":"split","name":"A","crumb_share":1.5})", "from 0 to 1");
  refuses(R"({"piece":"select"})", "'name'");
  refuses(R"({"piece":"select","name":3})", "'name'");
  refuses(R"({"piece":"select","name":"A","visible":true})", "'visible'");
  refuses(R"({"piece":"add","name":"A"})", "'of'");
  refuses(R"({"piece":"add","name":"A","of":"gone.stl"})", "gone.stl");
  refuses(R"({"piece":"add","name":"A\n","of":"ball.vdb"})", "plain text");
  refuses(R"({"piece":"add","name":"A","of":"ball.vdb","voxel_mm":0.3})", "'voxel_mm'");
  refuses(R"({"piece":"add","name":"A","of":"ball.vdb","of_xxh64":"0123456789abcdef"})",
          "it was changed");
  refuses(R"({"piece":"change","name":"A","position_mm":[1,2,3]})", "'orientation'");
  refuses(R"({"piece":"change","name":"A","orientation":[1,0,0,0]})", "'position_mm'");
  refuses(R"({"piece":"change","name":"A","position_mm":[1,2,3e9],"orientation":[1,0,0,0]})",
          "1 km");
  refuses(R"({"piece":"change","name":"A","color":"red"})", "'color'");
  refuses(R"({"piece":"change","name":"A","color":"#12345g"})", "'color'");
  refuses(R"({"piece":"change","name":"A","color":"#-12345"})", "'color'");
  refuses(R"({"piece":"union","name":"A"})", "'other'");
}

TEST_F(ScriptPiece, ScriptMakesAndSculptsPieces) {
  ASSERT_TRUE(write_mesh(folder_ / "box.stl", test::box_mesh({3.0, 4.0, 5.0})));
  test::fill(folder_ / "s.strokes.jsonl",
             "{\"argil_strokes\":1,\"units\":\"mm\"}\n"
             R"({"piece":"add","name":"Box","of":"box.stl","position_mm":[0,0,-6]})"
             "\n"
             R"({"tool":"carve","shape":"ball","radius_mm":1,"strength":1,"poses":[[0,0,0,2.5]]})"
             "\n"
             R"({"piece":"union","name":"Clay","other":"Box"})"
             "\n{\"history\":\"undo\"}\n");
  const auto script = read_stroke_script(folder_ / "s.strokes.jsonl");
  ASSERT_TRUE(script) << script.error().message;
  Sculpture sculpture(Clay::ball(4.0, {0.5, 0.1}).value());
  const std::uint64_t ball = sculpture.clay().hash();
  for (const ScriptStep& step : script.value().steps) {
    const auto done = apply_step(sculpture, step);
    ASSERT_TRUE(done) << done.error().message;
  }
  ASSERT_EQ(sculpture.piece_count(), 2U);
  EXPECT_EQ(sculpture.clay(0).hash(), ball);
  EXPECT_LT(sculpture.clay(1).distance_at({}), 0.0);
  EXPECT_GT(sculpture.clay(1).distance_at({0.0, 0.0, 2.2}), 0.0) << "carved in its own frame";
  // A clay alone has no pieces.
  Clay alone = Clay::ball(4.0, {0.5, 0.1}).value();
  EXPECT_FALSE(apply_step(alone, script.value().steps[0]));
}

TEST_F(ScriptPiece, LockedPiecesAreNotSculpted) {
  Sculpture sculpture(Clay::ball(4.0, {0.5, 0.1}).value());
  ASSERT_TRUE(sculpture.apply(ChangePiece{.name = "Clay", .is_locked = true}));
  Stroke stroke;
  stroke.samples.push_back({0.0, {4.0, 0.0, 0.0}, {}, 1.0});
  for (const ScriptStep& step :
       {ScriptStep(stroke), ScriptStep(Operation(Offset{0.5})), ScriptStep(MaskEdit::fill)}) {
    const auto done = apply_step(sculpture, step);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr("locked"));
  }
  EXPECT_TRUE(apply_step(sculpture, HistoryStep::undo)) << "the lock itself";
  EXPECT_TRUE(apply_step(sculpture, ScriptStep(stroke)));
}

}  // namespace
}  // namespace argil::io
