// SPDX-License-Identifier: GPL-3.0-or-later
// Strokes that emboss an image, as lines of a script.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/io/alpha_file.h"
#include "argil/io/stroke_script.h"

#include "support/alpha_maker.h"
#include "support/scratch.h"
#include "support/stroke_script_file.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::fill;
using testing::AllOf;
using testing::HasSubstr;

class ScriptAlpha : public testing::Test {
 protected:
  fs::path file(const std::string& name = "a.strokes.jsonl") const { return folder_ / name; }

  /// A stroke of emboss with these keys.
  Result<StrokeScript> read(const std::string& keys, const std::string& tool = "emboss") const {
    fill(file(), "{\"argil_strokes\":1}\n{\"tool\":\"" + tool +
                     "\",\"shape\":\"ball\",\"radius_mm\":4," + keys +
                     ",\"poses\":[[0,0,0,8],[1,2,0,8]]}\n");
    return read_stroke_script(file());
  }
  std::string error_of(const std::string& keys, const std::string& tool = "emboss") const {
    const auto script = read(keys, tool);
    if (script) return "";
    const std::string place = file().string() + ":2: ";
    EXPECT_THAT(script.error().message, testing::StartsWith(place));
    return script.error().message.substr(place.size());
  }

  test::ScratchFolder folder_;
};

std::uint64_t hash_after(const StrokeScript& script) {
  Clay clay = Clay::ball(8.0, {0.4, 0.1}).value();
  for (const ScriptStep& step : script.steps) {
    const auto done = apply_step(clay, step);
    EXPECT_TRUE(done) << done.error().message;
  }
  return clay.hash();
}

TEST_F(ScriptAlpha, DoesTheSameReadBackAfterWriting) {
  StrokeScript script;
  for (const AlphaMode mode : {AlphaMode::space, AlphaMode::anchored, AlphaMode::tiled}) {
    Stroke stroke;
    stroke.tool.action = Action::emboss;
    stroke.tool.radii_mm = {3.0, 3.0, 3.0};
    stroke.tool.alpha = mode == AlphaMode::tiled ? test::ramp_image(5) : test::letter_image();
    stroke.tool.alpha_mode = mode;
    stroke.tool.amplitude_mm = 1.0 / 3.0;
    stroke.tool.mid_level = 0.1;
    stroke.tool.angle_deg = 12.5;
    stroke.tool.use_rake = true;
    stroke.tool.tile_mm = 1.7;
    stroke.samples = {{0.0, {0.0, 0.0, 8.0}, {}, 1.0}, {1.0, {4.0, 0.0, 7.0}, {}, 0.7}};
    script.steps.emplace_back(stroke);
  }
  Stroke plain = std::get<Stroke>(script.steps[0]);
  plain.tool.alpha = nullptr;
  script.steps.emplace_back(plain);
  const auto written = test::write_stroke_script(file(), script);
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_EQ(folder_.names().size(), 3U) << "the script and two images, each once";
  const auto read = read_stroke_script(file());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(hash_after(read.value()), hash_after(script));
  ASSERT_TRUE(test::write_stroke_script(file("b.strokes.jsonl"), read.value()));
  std::string again = content_of(file("b.strokes.jsonl"));
  for (std::size_t at = 0; (at = again.find("b.solid-")) != std::string::npos;) again[at] = 'a';
  EXPECT_EQ(again, content_of(file()));
}

TEST_F(ScriptAlpha, IsReadAsAPersonWritesItAndOnce) {
  ASSERT_TRUE(write_alpha(file("letter.png"), *test::letter_image()));
  const auto script = read(
      R"("alpha":"letter.png","alpha_mode":"tiled","amplitude_mm":0.5,"mid_level":0.25,"angle_deg":-45,"use_rake":true,"tile_mm":3)");
  ASSERT_TRUE(script) << script.error().message;
  const Tool tool = std::get<Stroke>(script.value().steps[0]).tool;
  EXPECT_EQ(tool.action, Action::emboss);
  ASSERT_NE(tool.alpha, nullptr);
  EXPECT_EQ(tool.alpha->pixels(), test::letter_image()->pixels());
  EXPECT_EQ(tool.alpha_mode, AlphaMode::tiled);
  EXPECT_EQ(tool.amplitude_mm, 0.5);
  EXPECT_EQ(tool.mid_level, 0.25);
  EXPECT_EQ(tool.angle_deg, -45.0);
  EXPECT_TRUE(tool.use_rake);
  EXPECT_EQ(tool.tile_mm, 3.0);
}

TEST_F(ScriptAlpha, TakesAFileWithItsHashAndRefusesAnother) {
  ASSERT_TRUE(write_alpha(file("letter.png"), *test::letter_image()));
  const std::string hash = alpha_hash(*test::letter_image());
  EXPECT_EQ(error_of(R"("alpha":"letter.png","alpha_xxh64":")" + hash + "\""), "");
  EXPECT_THAT(error_of(R"("alpha":"letter.png","alpha_xxh64":"0123456789abcdef")"),
              AllOf(HasSubstr("key 'alpha' cannot be used: '"),
                    HasSubstr("letter.png' holds " + hash + " and not 0123456789abcdef")));
}

TEST_F(ScriptAlpha, NamesKeyAndRemedyOfWhatIsWrong) {
  EXPECT_THAT(error_of(R"("alpha":"none.png")"), AllOf(HasSubstr("key 'alpha' cannot be used: '"),
                                                       HasSubstr("none.png' is not there")));
  fill(file("text.png"), "no image");
  EXPECT_THAT(error_of(R"("alpha":"text.png")"), HasSubstr("text.png' is neither PNG nor JPEG"));
  EXPECT_EQ(error_of(R"("alpha":3)"), "key 'alpha' is 3; must be the name of a file");
  EXPECT_EQ(error_of(R"("alpha_xxh64":"0123456789abcdef")"),
            "key 'alpha' is missing; name a file, seen from the script's folder");
  EXPECT_EQ(error_of(R"("alpha":"a.png")", "noise"),
            "key 'alpha' is \"a.png\"; must be absent unless 'tool' is \"emboss\"");
  EXPECT_EQ(error_of(R"("alpha_mode":"stencil")"),
            "key 'alpha_mode' is \"stencil\"; must be one of 'space', 'anchored', 'tiled'");
  EXPECT_EQ(error_of(R"("use_rake":1)"), "key 'use_rake' is 1; must be true or false");
  EXPECT_EQ(error_of(R"("mid_level":2)"), "mid_level is 2; must be from 0 to 1");
}

}  // namespace
}  // namespace argil::io
