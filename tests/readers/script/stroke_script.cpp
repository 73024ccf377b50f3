// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/stroke_script.h"

#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/effort.h"
#include "support/stroke_script_file.h"

namespace argil::io {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kHeader = R"({"argil_strokes":1,"units":"mm"})";
constexpr const char* kStroke =
    R"({"tool":"add","shape":"ball","radius_mm":4,"poses":[[0,1,2,3],[0.5,2,2,3,1,0,0,0,0.5]]})";

/// A script file that is removed again.
class ScriptFile {
 public:
  explicit ScriptFile(const std::string& text) : path_(unique_path()) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~ScriptFile() { fs::remove(path_); }
  ScriptFile(const ScriptFile&) = delete;
  ScriptFile& operator=(const ScriptFile&) = delete;
  const fs::path& path() const { return path_; }

 private:
  static fs::path unique_path() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    return fs::path(testing::TempDir()) /
           (std::string(test->test_suite_name()) + "." + test->name() + ".strokes.jsonl");
  }
  fs::path path_;
};

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// The message for a script, without the folder; "" when it is read.
std::string error_of(const std::string& text) {
  const ScriptFile file(text);
  const auto script = read_stroke_script(file.path());
  if (script) return "";
  EXPECT_EQ(script.error().kind, ErrorKind::bad_input);
  const std::string& message = script.error().message;
  const std::size_t cut = message.find(".strokes.jsonl:");
  EXPECT_NE(cut, std::string::npos) << "the message does not name the file: " << message;
  return message.substr(cut + std::string(".strokes.jsonl:").size());
}

std::string error_of_stroke(const std::string& line) {
  return error_of(std::string(kHeader) + "\n" + kStroke + "\n" + line + "\n");
}

Stroke awkward_stroke() {
  Stroke stroke;
  stroke.tool = {Action::inflate, Shape::ellipsoid, {0.1, 1.0 / 3.0, 1.7}, -0.3};
  stroke.spacing = 0.123456789012345678;
  stroke.mirror = {true, false, true};
  stroke.tool.pressure_to_strength = 0.3;
  stroke.tool.pressure_to_size = 1.0 / 7.0;
  stroke.tool.sharpness = 1.0 / 3.0;
  stroke.tool.width = 0.7;
  stroke.tool.falloff = Falloff::inverse_square;
  stroke.tool.plane_offset = -1.0 / 3.0;
  stroke.tool.tip_roundness = 0.7;
  stroke.tool.volume_preservation = 1.0 / 9.0;
  stroke.tool.crease_pinch_factor = 0.1;
  stroke.tool.wavelength_mm = 1.0 / 11.0;
  stroke.tool.seed = 4294967295U;
  stroke.radial = {5, 1};
  stroke.steady_mm = 1.0 / 3.0;
  stroke.hold_s = 0.1;
  stroke.samples.push_back({0.0, {-0.0, 1e-300, 1.0 / 7.0}, {1.0, -0.0, 0.0, 0.0}, 1.0});
  stroke.samples.push_back({0.1, {5e-324, -1e6, 0.3}, {0.3, 0.4, -0.5, 0.7}, 1.0 / 3.0});
  stroke.samples.push_back({0.1, {1.0, 2.0, 3.0}, {}, 1.0});
  return stroke;
}

StrokeScript sample_script() {
  StrokeScript script;
  script.start = StartShape{StartShape::Kind::block, {10.0, 1.0 / 3.0, 7.5}, {0.1, 0.2, 0.7}};
  script.steps.push_back(awkward_stroke());
  Stroke ball;
  ball.tool = {Action::carve, Shape::ball, {0.7, 0.7, 0.7}, 1.0};
  ball.samples.push_back({0.0, {1.0, 2.0, 3.0}, {}, 1.0});
  script.steps.push_back(ball);
  for (const ActionInfo& info : kActionInfos) {
    ball.tool.action = info.action;
    script.steps.push_back(ball);
  }
  ball.tool = {Action::add, Shape::capsule, {0.7, 0.7, 1.7}, 1.0};
  script.steps.push_back(ball);
  ball.tool.shape = Shape::box;
  script.steps.push_back(ball);
  return script;
}

void expect_same_bits(double a, double b) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << a << " " << b;
}

void expect_same_bits(const StrokeSample& a, const StrokeSample& b) {
  expect_same_bits(a.time_s, b.time_s);
  for (std::size_t i = 0; i < 3; ++i) expect_same_bits(a.position_mm[i], b.position_mm[i]);
  expect_same_bits(a.orientation.w, b.orientation.w);
  expect_same_bits(a.orientation.x, b.orientation.x);
  expect_same_bits(a.orientation.y, b.orientation.y);
  expect_same_bits(a.orientation.z, b.orientation.z);
  expect_same_bits(a.pressure, b.pressure);
}

void expect_same_bits(const Stroke& a, const Stroke& b) {
  EXPECT_EQ(a.tool.action, b.tool.action);
  EXPECT_EQ(a.tool.shape, b.tool.shape);
  for (std::size_t i = 0; i < 3; ++i) expect_same_bits(a.tool.radii_mm[i], b.tool.radii_mm[i]);
  expect_same_bits(a.tool.strength, b.tool.strength);
  expect_same_bits(a.spacing, b.spacing);
  EXPECT_EQ(a.mirror.x, b.mirror.x);
  EXPECT_EQ(a.mirror.y, b.mirror.y);
  EXPECT_EQ(a.mirror.z, b.mirror.z);
  expect_same_bits(a.tool.pressure_to_strength, b.tool.pressure_to_strength);
  expect_same_bits(a.tool.pressure_to_size, b.tool.pressure_to_size);
  expect_same_bits(a.tool.sharpness, b.tool.sharpness);
  expect_same_bits(a.tool.width, b.tool.width);
  expect_same_bits(a.tool.plane_offset, b.tool.plane_offset);
  EXPECT_EQ(a.tool.falloff, b.tool.falloff);
  expect_same_bits(a.tool.tip_roundness, b.tool.tip_roundness);
  expect_same_bits(a.tool.volume_preservation, b.tool.volume_preservation);
  expect_same_bits(a.tool.crease_pinch_factor, b.tool.crease_pinch_factor);
  expect_same_bits(a.tool.wavelength_mm, b.tool.wavelength_mm);
  EXPECT_EQ(a.tool.seed, b.tool.seed);
  EXPECT_EQ(a.radial.count, b.radial.count);
  EXPECT_EQ(a.radial.axis, b.radial.axis);
  expect_same_bits(a.steady_mm, b.steady_mm);
  expect_same_bits(a.hold_s, b.hold_s);
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) expect_same_bits(a.samples[i], b.samples[i]);
}

TEST(StrokeScript, ReadsBackTheBitsItWrote) {
  const ScriptFile file("");
  const StrokeScript script = sample_script();
  const auto written = test::write_stroke_script(file.path(), script);
  ASSERT_TRUE(written) << written.error().message;
  const auto read = read_stroke_script(file.path());
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_TRUE(read.value().start);
  EXPECT_EQ(read.value().start->kind, StartShape::Kind::block);
  EXPECT_EQ(read.value().start->size_mm, script.start->size_mm);
  expect_same_bits(read.value().start->options.voxel_mm, 0.1);
  expect_same_bits(read.value().start->options.tolerance_voxels, 0.2);
  EXPECT_EQ(read.value().start->options.edge_radius_mm, 0.7);
  ASSERT_EQ(read.value().steps.size(), script.steps.size());
  for (std::size_t i = 0; i < script.steps.size(); ++i) {
    expect_same_bits(std::get<Stroke>(read.value().steps[i]), std::get<Stroke>(script.steps[i]));
  }
}

TEST(StrokeScript, ReadsAStartBallAndFillsInDefaults) {
  const ScriptFile file(
      "{\"argil_strokes\":1,\"units\":\"mm\",\"start\":{\"shape\":\"ball\",\"radius_mm\":30,"
      "\"voxel_mm\":0.2}}\r\n\n" +
      std::string(kStroke));
  const auto read = read_stroke_script(file.path());
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_TRUE(read.value().start);
  EXPECT_EQ(read.value().start->kind, StartShape::Kind::ball);
  EXPECT_EQ(read.value().start->size_mm.x, 30.0);
  EXPECT_EQ(read.value().start->options.voxel_mm, 0.2);
  EXPECT_EQ(read.value().start->options.tolerance_voxels, 0.1);
  EXPECT_EQ(read.value().start->options.edge_radius_mm, std::nullopt);
  ASSERT_EQ(read.value().steps.size(), 1U);
  const Stroke& stroke = std::get<Stroke>(read.value().steps[0]);
  EXPECT_EQ(stroke.tool.radii_mm, (Vec3{4.0, 4.0, 4.0}));
  EXPECT_EQ(stroke.tool.strength, 1.0);
  EXPECT_EQ(stroke.spacing, 0.25);
  EXPECT_EQ(stroke.samples[0].orientation, Quat{});
  EXPECT_EQ(stroke.samples[0].pressure, 1.0);
  EXPECT_EQ(stroke.samples[1].pressure, 0.5);
}

TEST(StrokeScript, HoldsEditsOfTheMask) {
  const ScriptFile file("");
  StrokeScript script;
  for (const MaskEdit edit :
       {MaskEdit::clear, MaskEdit::invert, MaskEdit::blur, MaskEdit::fill, MaskEdit::sharpen}) {
    script.steps.emplace_back(edit);
  }
  ASSERT_TRUE(test::write_stroke_script(file.path(), script));
  const auto read = read_stroke_script(file.path());
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read.value().steps.size(), script.steps.size());
  for (std::size_t i = 0; i < script.steps.size(); ++i) {
    EXPECT_EQ(std::get<MaskEdit>(read.value().steps[i]), std::get<MaskEdit>(script.steps[i]));
  }
  EXPECT_EQ(
      error_of_stroke(R"({"mask":"fade"})"),
      "3: key 'mask' is \"fade\"; must be one of 'clear', 'invert', 'blur', 'fill', 'sharpen'");
}

TEST(StrokeScript, ReadsAStepByItselfAndNamesWhereItComesFrom) {
  const auto step = read_script_step("step", kStroke, {});
  ASSERT_TRUE(step.ok()) << step.error().message;
  EXPECT_EQ(std::get<Stroke>(step.value()).samples.size(), 2U);
  const auto cut =
      read_script_step("step", R"({"operation":"cut","point_mm":[0,0,1],"normal":[0,0,1]})", {});
  ASSERT_TRUE(cut.ok()) << cut.error().message;
  EXPECT_TRUE(std::holds_alternative<Operation>(cut.value()));

  const auto message = [](const std::string& line) {
    const auto read = read_script_step("step", line, {});
    return read.ok() ? "read" : read.error().message;
  };
  EXPECT_THAT(message(R"({"operation":"offset","distance":1})"),
              testing::StartsWith("step: key 'distance'"));
  EXPECT_THAT(message(R"({"after":1,"hash":"0123456789abcdef"})"), HasSubstr("mark of a journal"));
  EXPECT_THAT(message(std::string(kStroke) + "\n" + kStroke), HasSubstr("several lines"));
  EXPECT_THAT(message("nothing"), testing::StartsWith("step"));
  EXPECT_THAT(message(""), testing::StartsWith("step"));
}

TEST(StrokeScript, NamesLineKeyAndRemedyOfWhatIsWrong) {
  struct Case {
    const char* line;
    std::string message;
  };
  std::string tools;
  for (const ActionInfo& info : kActionInfos) {
    tools += (tools.empty() ? "'" : ", '") + std::string(info.name) + "'";
  }
  const Case cases[] = {
      {R"({"tool":"carve","shape":"ball","radius_mm":-4,"poses":[[0,0,0,0]]})",
       "3: key 'radius_mm' is -4; must be greater than 0"},
      {R"({"tool":"carve","shape":"ball","radius_mm":"4","poses":[[0,0,0,0]]})",
       "3: key 'radius_mm' is \"4\"; must be a number"},
      {R"({"tool":"karve","shape":"ball","radius_mm":4,"poses":[[0,0,0,0]]})",
       "3: key 'tool' is \"karve\"; must be one of " + tools},
      {R"({"shape":"ball","radius_mm":4,"poses":[[0,0,0,0]]})",
       "3: key 'tool' is missing; give one of " + tools},
      {R"({"tool":7,"shape":"ball","radius_mm":4,"poses":[[0,0,0,0]]})",
       "3: key 'tool' is 7; must be one of " + tools},
      {R"({"tool":"add","shape":"cube","radius_mm":4,"poses":[[0,0,0,0]]})",
       "3: key 'shape' is \"cube\"; must be one of 'ball', 'ellipsoid', 'box', 'capsule', "
       "'mesh'"},
      {R"({"tool":"add","shape":"ball","poses":[[0,0,0,0]]})",
       "3: key 'radius_mm' is missing; give the ball's radius in mm"},
      {R"({"tool":"add","shape":"ellipsoid","radii_mm":[1,2],"poses":[[0,0,0,0]]})",
       "3: key 'radii_mm' is [1,2]; must be three numbers [x, y, z]"},
      {R"({"tool":"add","shape":"ellipsoid","radii_mm":[1,-2,3],"poses":[[0,0,0,0]]})",
       "3: key 'radii_mm' is [1,-2,3]; must be three numbers greater than 0"},
      {R"({"tool":"add","shape":"ball","radius":4,"poses":[[0,0,0,0]]})",
       "3: key 'radius' is not known; did you mean 'radius_mm'?"},
      {R"({"tool":"add","shape":"ball","radius_mm":4,"symmetry":"xx","poses":[[0,0,0,0]]})",
       "3: key 'symmetry' is \"xx\"; must be a string of x, y and z, each at most once"},
      {R"({"tool":"add","shape":"ball","radius_mm":4,"radial_symmetry":4294967297,"poses":[[0,0,0,0]]})",
       "3: key 'radial_symmetry' is 4294967297; must be a whole number from 1 to 64"},
      {R"({"tool":"noise","shape":"ball","radius_mm":4,"seed":-1,"poses":[[0,0,0,0]]})",
       "3: key 'seed' is -1; must be a whole number from 0 to 4294967295"},
      {R"({"tool":"noise","shape":"ball","radius_mm":4,"seed":4294967296,"poses":[[0,0,0,0]]})",
       "3: key 'seed' is 4294967296; must be a whole number from 0 to 4294967295"},
      {R"({"tool":"add","shape":"ball","radius_mm":4,"radial_symmetry":2.5,"poses":[[0,0,0,0]]})",
       "3: key 'radial_symmetry' is 2.5; must be a whole number from 1 to 64"},
      {R"({"tool":"add","shape":"ball","radius_mm":4,"radial_axis":"w","poses":[[0,0,0,0]]})",
       "3: key 'radial_axis' is \"w\"; must be one of 'x', 'y', 'z'"},
      {R"({"tool":"add","shape":"box","radius_mm":4,"poses":[[0,0,0,0]]})",
       "3: key 'radii_mm' is missing; give three half extents in mm"},
      {R"({"tool":"add","shape":"ball","radius_mm":4})",
       "3: key 'poses' is missing; give at least one [t,x,y,z]"},
      {R"({"tool":"add","shape":"ball","radius_mm":4,"poses":[]})",
       "3: key 'poses' is []; must be a list of at least one pose"},
      {R"({"tool":"add","shape":"ball","radius_mm":4,"poses":[[0,0,0]]})",
       "3: key 'poses[0]' is [0,0,0]; must be 4 or 9 numbers [t,x,y,z(,qw,qx,qy,qz,pressure)]"},
      {R"({"tool":"add","shape":"ball","radius_mm":4,"poses":[[0,0,0,0],[0,0,"a",0]]})",
       "3: key 'poses[1]' is [0,0,\"a\",0]; must be 4 or 9 numbers "
       "[t,x,y,z(,qw,qx,qy,qz,pressure)]"},
      {R"({"tool":"add","shape":"ball","radius_mm":4,"poses":[[0,0,0,0,0,0,0,0,1]]})",
       "3: key 'poses[0]' has the quaternion 0,0,0,0; must be 1,0,0,0 for no rotation"},
      {R"({"tool":"add","shape":"ball","radius_mm":4,"poses":[[0,0,0,0,1,0,0,0,1.5]]})",
       "3: key 'poses[0]' has the pressure 1.5; must be 0 to 1"},
      {R"({"tool":"add","shape":"ball","radius_mm":4,"poses":[[1,0,0,0],[0.5,0,0,0]]})",
       "3: key 'poses[1]' has the time 0.5 before the pose ahead of it; times must not decrease"},
      {R"({"tool":"add","tool":"carve","shape":"ball","radius_mm":4,"poses":[[0,0,0,0]]})",
       "3: key 'tool' appears twice; keep one of them"},
      {R"({"tool":"add","shape":"ball","radius_mm":1e999,"poses":[[0,0,0,0]]})",
       "3: a number is too large to represent; must be finite"},
      {R"([1,2,3])", "3: is [1,2,3]; must be a JSON object {...}"},
      {R"({"tool":"add",,})", "3: column 15: not JSON; must be one complete object {...}"},
  };
  for (const Case& c : cases) EXPECT_EQ(error_of_stroke(c.line), c.message) << c.line;
}

TEST(StrokeScript, RefusesStrengthAndSpacingOutOfRange) {
  const auto with = [](const std::string& more) {
    return error_of_stroke(R"({"tool":"add","shape":"ball","radius_mm":4,)" + more +
                           R"(,"poses":[[0,0,0,0]]})");
  };
  EXPECT_THAT(with(R"("strength":0)"), testing::StartsWith("3: strength is 0; must be"));
  EXPECT_THAT(with(R"("strength":1.5)"), testing::StartsWith("3: strength is 1.5; must be"));
  EXPECT_THAT(with(R"("spacing":-1)"), testing::StartsWith("3: spacing is -1; must be"));
}

TEST(StrokeScript, RefusesAHeaderThatIsNotItsOwn) {
  EXPECT_THAT(error_of(""), HasSubstr("the stroke script is empty"));
  EXPECT_THAT(error_of("\n \n"), HasSubstr("the stroke script is empty"));
  EXPECT_EQ(error_of("{}"),
            "1: key 'argil_strokes' is missing; the first line must be a header "
            "{\"argil_strokes\":1,...}");
  EXPECT_EQ(error_of("{\"argil_strokes\":2}"),
            "1: key 'argil_strokes' is 2; must be 1, the only version this program reads");
  EXPECT_EQ(error_of("{\"argil_strokes\":1,\"units\":\"inch\"}"),
            "1: key 'units' is \"inch\"; must be \"mm\"");
  EXPECT_EQ(error_of("{\"argil_strokes\":1,\"strat\":{}}"),
            "1: key 'strat' is not known; did you mean 'start'?");
  EXPECT_EQ(error_of(R"({"argil_strokes":1,"start":{"shape":"ball","radius_mm":-1}})"),
            "1: key 'start.radius_mm' is -1; must be greater than 0");
  EXPECT_EQ(error_of(R"({"argil_strokes":1,"start":{"shape":"block","radius_mm":1}})"),
            "1: key 'start.radius_mm' is not known; did you mean 'size_mm'?");
  EXPECT_EQ(error_of(R"({"argil_strokes":1,"start":{"shape":"ball","radius_mm":1,"voxel_mm":0}})"),
            "1: key 'start.voxel_mm' is 0; must be greater than 0");
}

TEST(StrokeScript, ReportsAMissingFileAsDiskError) {
  const auto read = read_stroke_script("no such folder/no such.strokes.jsonl");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::disk);
  EXPECT_THAT(read.error().message, HasSubstr("no such.strokes.jsonl"));
}

TEST(StrokeScript, RefusesEveryCutLine) {
  const ScriptFile whole("");
  ASSERT_TRUE(test::write_stroke_script(whole.path(), sample_script()));
  const std::string text = text_of(whole.path());
  for (std::size_t length = 0; length < text.size(); length += 7) {
    const std::string cut = text.substr(0, length);
    const bool between_lines = length > 0 && (text[length] == '\n' || text[length - 1] == '\n');
    EXPECT_EQ(error_of(cut).empty(), between_lines) << "cut after " << length << " bytes";
  }
}

TEST(StrokeScript, SurvivesDamagedBytes) {
  const ScriptFile whole("");
  ASSERT_TRUE(test::write_stroke_script(whole.path(), sample_script()));
  const std::string text = text_of(whole.path());
  for (std::size_t at = 0; at < text.size(); at += test::effort(9U, 3U)) {
    for (const char damage : {'\0', '"', '[', '}', '\xff', '-'}) {
      std::string damaged = text;
      damaged[at] = damage;
      const ScriptFile file(damaged);
      const auto read = read_stroke_script(file.path());  // must return, whatever it says
      EXPECT_TRUE(read || !read.error().message.empty());
    }
  }
}

TEST(StrokeScript, SurvivesDeepNesting) {
  constexpr std::size_t kDeep = 200'000;
  const std::string lists = std::string(kDeep, '[') + std::string(kDeep, ']');
  EXPECT_THAT(error_of(lists), HasSubstr("1: nests more than 64 deep"));
  for (const std::string& line :
       {std::string(kDeep, '['), lists, "{\"tool\":" + lists + "}", "{\"history\":" + lists + "}",
        R"({"tool":"add","shape":"ball","radius_mm":4,"poses":[)" + lists + "]}"}) {
    EXPECT_THAT(error_of_stroke(line), HasSubstr("3: nests more than 64 deep"));
  }
}

TEST(StrokeScript, NamesAKeyLikeAnEndlessOne) {
  EXPECT_THAT(error_of_stroke("{\"radius_m" + std::string(1 << 20, 'm') + "\":1}"),
              EndsWith("is not known; did you mean 'radius_mm'?"));
}

TEST(StrokeScript, IsNotWrittenWhenItCouldNotBeReadBack) {
  const ScriptFile file("old");
  StrokeScript script = sample_script();
  std::get<Stroke>(script.steps[1]).samples[0].position_mm.y =
      std::numeric_limits<double>::quiet_NaN();
  const auto written = test::write_stroke_script(file.path(), script);
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("stroke 1: "));
  EXPECT_EQ(text_of(file.path()), "old");
}

}  // namespace
}  // namespace argil::io
