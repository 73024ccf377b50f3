// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/brush_preset.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/scratch.h"

namespace argil::viewer {
namespace {

using testing::HasSubstr;

BrushPreset unusual_preset() {
  BrushPreset preset;
  preset.name = "My own, 2";
  preset.key = chord_of("Ctrl+1");
  Brush& brush = preset.brush;
  brush.action = Action::emboss;
  brush.shape = Shape::capsule;
  brush.radius_mm = 1.0 / 3.0;
  brush.radius_pixels = 77.5;
  brush.is_screen_size = brush.is_inverted = brush.use_rake = true;
  brush.strength = 0.123;
  brush.height = 2.5;
  brush.turn_deg = -30.0;
  brush.falloff = Falloff::sharper;
  brush.stroke_mode = StrokeMode::drag_dot;
  brush.emboss_mode = StrokeMode::anchored;
  brush.alpha_mode = AlphaMode::tiled;
  brush.seed = 17;
  brush.spacing = 0.5;
  return preset;
}

TEST(BrushPresets, AreReadAsTheyWereWritten) {
  const test::ScratchFolder folder;
  const BrushPreset preset = unusual_preset();
  ASSERT_TRUE(write_preset(folder.path(), preset).ok());
  const auto read = read_preset(preset_file(folder.path(), preset.name));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value().name, preset.name);
  EXPECT_EQ(read.value().key, preset.key);
  EXPECT_TRUE(is_applied(read.value(), preset.brush));
  EXPECT_EQ(read.value().brush.action, Action::emboss);
  EXPECT_EQ(read.value().brush.radius_mm, preset.brush.radius_mm);
  EXPECT_EQ(read.value().brush.alpha_mode, AlphaMode::tiled);
  EXPECT_FALSE(is_applied(read.value(), Brush()));
}

TEST(BrushPresets, LeaveSymmetryImageAndMeshAsTheyAre) {
  Brush brush;
  brush.mirror.x = true;
  brush.radial.count = 5;
  BrushPreset preset = unusual_preset();
  preset.brush.mirror.y = true;
  apply(preset, brush);
  EXPECT_TRUE(brush.mirror.x);
  EXPECT_FALSE(brush.mirror.y);
  EXPECT_EQ(brush.radial.count, 5);
  EXPECT_EQ(brush.strength, preset.brush.strength);
  EXPECT_TRUE(is_applied(preset, brush));
  brush.strength = 0.124;
  EXPECT_FALSE(is_applied(preset, brush));
}

TEST(BrushPresets, OfTheProgramAreThereUntilAFileTakesTheirPlace) {
  const test::ScratchFolder folder;
  const auto built_in = built_in_presets();
  EXPECT_GE(built_in.size(), 6U);
  const auto fresh = read_presets(folder.path());
  EXPECT_EQ(fresh.presets.size(), built_in.size());
  EXPECT_FALSE(std::filesystem::exists(folder / "brushes")) << "nothing is written to read them";
  std::set<std::string> names;
  for (const BrushPreset& one : built_in) {
    EXPECT_EQ(why_no_preset_name(one.name), "");
    EXPECT_TRUE(names.insert(one.name).second);
    // In range: read as it was written.
    ASSERT_TRUE(write_preset(folder / "all", one).ok());
    EXPECT_TRUE(is_applied(read_preset(preset_file(folder / "all", one.name)).value(), one.brush))
        << one.name;
  }
  BrushPreset changed = built_in[2];
  changed.brush.strength = 0.05;
  ASSERT_TRUE(write_preset(folder.path(), changed).ok());
  const auto list = read_presets(folder.path());
  EXPECT_EQ(list.presets.size(), built_in.size());
  const auto found = std::find_if(list.presets.begin(), list.presets.end(),
                                  [&](const BrushPreset& one) { return one.name == changed.name; });
  ASSERT_NE(found, list.presets.end());
  EXPECT_EQ(found->brush.strength, 0.05);
  EXPECT_FALSE(found->is_built_in);
}

TEST(BrushPresets, AreRefusedWithLineAndRange) {
  const test::ScratchFolder folder;
  const std::string start = "{\"argil_brush\": 1,\n";
  std::filesystem::create_directories(folder / "brushes");
  for (const auto& [text, words] :
       {std::pair{start + "\"strength\": 1.5}", ":2: \"strength\" must be a number from 0.01 to 1"},
        {start + "\"size_mm\": \"5\"}", "\"size_mm\" must be a number from 0.01 to 1000"},
        {start + "\"tool\": \"hammer\"}", "\"tool\" must be one of "},
        {start + "\"shape\": \"mesh\"}", "one of \"ball\", \"ellipsoid\", \"box\", \"capsule\""},
        {start + "\"key\": \"Ctrl+Foo\"}", "\"key\" must name a key"},
        {start + "\"seed\": 1.5}", "whole number from 0 to 99"},
        {start + "\"use_rake\": 1}", "must be true or false"},
        {start + "\"colour\": 1}", ":2: \"colour\" is unknown"},
        {start + "\"a\": {\"b\": 1}}", "no sections"},
        {std::string("{\"argil_brush\": 2}"), "a newer one wrote the file"},
        {std::string("{\"strength\": 0.5}"), "begins with \"argil_brush\": 1"}}) {
    test::fill(folder / "brushes" / "b.json", text);
    const auto list = read_presets(folder.path());
    ASSERT_EQ(list.problems.size(), 1U) << text;
    EXPECT_THAT(list.problems[0].message, HasSubstr(words)) << text;
    EXPECT_EQ(list.presets.size(), built_in_presets().size());
  }
}

TEST(BrushPresets, AreImportedUnderAFreeName) {
  const test::ScratchFolder folder;
  const BrushPreset preset = unusual_preset();
  ASSERT_TRUE(write_preset(folder / "other", preset).ok());
  const auto file = preset_file(folder / "other", preset.name);
  EXPECT_TRUE(looks_like_preset(file));
  const auto first = import_preset(folder.path(), file);
  const auto second = import_preset(folder.path(), file);
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(first.value().name, preset.name);
  EXPECT_NE(second.value().name, preset.name);
  EXPECT_EQ(read_presets(folder.path()).presets.size(), built_in_presets().size() + 2);
  test::fill(folder / "keys.json", "{\"argil_keys\": 1}");
  EXPECT_FALSE(looks_like_preset(folder / "keys.json"));
  EXPECT_FALSE(import_preset(folder.path(), folder / "keys.json").ok());
}

TEST(BrushPresets, ANameIsAFilesNameToo) {
  EXPECT_EQ(why_no_preset_name("Fine line, ü"), "");
  for (const char* name : {"", "../up", "a\\b", ".hidden", "two\nlines", "a##b"}) {
    EXPECT_NE(why_no_preset_name(name), "") << name;
  }
  EXPECT_NE(why_no_preset_name(std::string(61, 'x')), "");
}

TEST(BrushPresets, AFileWithAMistakeIsKeptBesideTheNewOne) {
  const test::ScratchFolder folder;
  BrushPreset preset = unusual_preset();
  preset.name = "Mine";
  ASSERT_TRUE(write_preset(folder.path(), preset).ok());
  const auto file = preset_file(folder.path(), "Mine");
  test::fill(file, "{\"argil_brush\": 1,}");
  EXPECT_EQ(read_presets(folder.path()).problems.size(), 1U);
  ASSERT_TRUE(write_preset(folder.path(), preset).ok());
  EXPECT_TRUE(read_preset(file).ok());
  EXPECT_TRUE(std::filesystem::exists(file.string() + ".unread"));
}

TEST(BrushPresets, AFileWhoseNameIsNoneIsRefused) {
  const test::ScratchFolder folder;
  BrushPreset preset = unusual_preset();
  preset.name = "Mine";
  ASSERT_TRUE(write_preset(folder.path(), preset).ok());
  const auto file = preset_file(folder.path(), "Mine");
  for (const std::string& name :
       {std::string("Fine ##2"), std::string(61, 'x'), std::string(".x")}) {
    std::filesystem::copy(file, preset_file(folder.path(), name));
  }
  const PresetList list = read_presets(folder.path());
  EXPECT_EQ(list.problems.size(), 3U);
  EXPECT_EQ(list.presets.size(), built_in_presets().size() + 1);
}

}  // namespace
}  // namespace argil::viewer
