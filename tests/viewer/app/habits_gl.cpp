// SPDX-License-Identifier: GPL-3.0-or-later
// Keys, theme and brushes with names, as one window sets them and the next one has them.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/io/project_file.h"

#include "commands/brush_preset.h"
#include "commands/command.h"
#include "keys/key_file.h"
#include "settings/settings.h"
#include "support/scratch.h"
#include "viewer/support/picture_alike.h"
#include "viewer/support/window_run.h"

namespace argil {
namespace {

using test::shell_word;
using test::WindowRun;

class ViewHabitsGl : public test::WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) return;
    ASSERT_TRUE(io::save_project(folder_ / "s.vdb", Clay::ball(25.0, {}).value()).ok());
  }

  /// A window with a project, which no script of these tests changes.
  WindowRun played(const std::string& script) {
    WindowRun run = play("settle\n" + script + "key Ctrl+Q\nframes 3\n",
                         shell_word(folder_ / "s.vdb"), "--width 1000 --height 640");
    EXPECT_EQ(run.status, 0) << run.words;
    return run;
  }

  static std::string content(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  /// The middle of a picture, away from the figures of the status line.
  static std::vector<std::uint8_t> middle(const Image& image) {
    std::vector<std::uint8_t> rgb;
    for (int y = 160; y < 480; ++y) {
      const auto from = image.rgb.begin() + 3 * (y * image.width + 300);
      rgb.insert(rgb.end(), from, from + 3 * 400);
    }
    return rgb;
  }

  /// The mean of red, green and blue over a square of a picture, 0 to 255.
  static double brightness(const Image& image, int left, int top, int side) {
    double sum = 0.0;
    for (int y = top; y < top + side; ++y) {
      for (int x = 0; x < 3 * side; ++x) {
        sum += image.rgb[3 * static_cast<std::size_t>(y * image.width + left) +
                         static_cast<std::size_t>(x)];
      }
    }
    return sum / (3.0 * side * side);
  }
};

TEST_F(ViewHabitsGl, AKeyThatIsPressedForACommandIsItsKeyInTheNextWindow) {
  const WindowRun first = played(
      "key Shift+F1\nframes 3\nclick Keys and mouse of\nframes 2\nclick Keys and mouse of/Blender\n"
      "frames 3\nclick Find\nframes 2\ntype wirefr\nframes 3\n"
      "click key wires\nframes 2\nkey Ctrl+F7\nframes 3\nshot keys.png\n");
  EXPECT_EQ(first.report["complaints"].size(), 0U) << first.report.dump();
  const auto kept = viewer::read_keys(home());
  ASSERT_TRUE(kept.ok()) << kept.error().message;
  EXPECT_EQ(kept.value().set(), viewer::KeySet::blender);
  EXPECT_EQ(kept.value().text_of(viewer::Command::wires), "Ctrl+F7");
  EXPECT_EQ(kept.value().own_count(), 1U);
  // The next window draws the edges by that key, and no longer by the one of the first window.
  played(
      "move 20 620\nkey T\nframes 3\nshot plain.png\nkey W\nframes 3\nshot same.png\n"
      "key Ctrl+F7\nframes 3\nshot wires.png\n");
  const auto plain = middle(test::read_picture(folder_ / "plain.png"));
  EXPECT_EQ(middle(test::read_picture(folder_ / "same.png")), plain);
  EXPECT_NE(middle(test::read_picture(folder_ / "wires.png")), plain);
}

TEST_F(ViewHabitsGl, TwoFingersMoveTheViewUnlessThePointerIsOnAPanel) {
  const std::string fingers =
      "finger 1 400 300\nfinger 2 600 300\nfinger 1 380 300\nfinger 1 300 300\n"
      "finger 2 620 300\nfinger 2 700 300\nfinger 2 up\nfinger 1 up\nsettle\n";
  const std::string still = "move 20 620\nframes 3\nsettle\nshot ";  // on the status line
  played("frames 3\n" + still + "begun.png\n" + fingers + still + "same.png\n" +
         "move 400 300\nframes 3\n" + fingers + still + "near.png\n");
  const auto begun = middle(test::read_picture(folder_ / "begun.png"));
  EXPECT_EQ(middle(test::read_picture(folder_ / "same.png")), begun);
  EXPECT_NE(middle(test::read_picture(folder_ / "near.png")), begun);
}

TEST_F(ViewHabitsGl, ABadFileOfKeysChangesNothing) {
  const std::string bad = "{\n\"argil_keys\": 1,\n\"commands\": {\"wirez\": \"F7\"}}\n";
  test::fill(home() / "keys.json", bad);
  played(
      "key T\nmove 20 620\nframes 3\nshot plain.png\nkey F7\nframes 3\nshot same.png\n"
      "key W\nframes 3\nshot wires.png\nkey W\nkey Ctrl+M\nframes 3\nshot messages.png\n");
  const auto plain = middle(test::read_picture(folder_ / "plain.png"));
  EXPECT_EQ(middle(test::read_picture(folder_ / "same.png")), plain);
  EXPECT_NE(middle(test::read_picture(folder_ / "wires.png")), plain);
  EXPECT_EQ(content(home() / "keys.json"), bad);
  EXPECT_FALSE(std::filesystem::exists(home() / "keys.json.unread"));
}

TEST_F(ViewHabitsGl, TheLightThemeIsKeptAndLight) {
  played(
      "key Tab\nmove 20 620\nframes 3\nshot dark.png\nkey Tab\n"
      "click View\nframes 2\nclick Dark or light\nframes 3\n");
  EXPECT_EQ(viewer::read_settings(home()).theme, viewer::Theme::light);
  played("shot panels.png\nkey Tab\nmove 20 620\nframes 3\nshot light.png\n");
  const Image dark = test::read_picture(folder_ / "dark.png");
  const Image light = test::read_picture(folder_ / "light.png");
  // Beside the ball, where nothing but the ground is.
  EXPECT_LT(brightness(dark, 20, 80, 40), 100.0);
  EXPECT_GT(brightness(light, 20, 80, 40), 190.0);
}

TEST_F(ViewHabitsGl, ABrushIsSavedByNameAndOneThatIsDroppedIsTakenOver) {
  viewer::BrushPreset other;
  other.name = "Of a friend";
  other.brush.action = Action::pinch;
  ASSERT_TRUE(viewer::write_preset(folder_ / "friend", other).ok());
  const WindowRun run = played(
      "key Shift+B\nframes 3\nkey P\nclick ##preset name\nframes 2\ntype Mine\nframes 2\n"
      "click Save brush\nframes 3\nclick preset key\nframes 2\nkey Ctrl+1\nframes 2\ndrop " +
      viewer::preset_file(folder_ / "friend", other.name).string() +
      "\nframes 3\nshot presets.png\n");
  EXPECT_EQ(run.report["complaints"].size(), 0U) << run.report.dump();
  const auto mine = viewer::read_preset(viewer::preset_file(home(), "Mine"));
  ASSERT_TRUE(mine.ok()) << mine.error().message;
  EXPECT_EQ(mine.value().brush.action, Action::pinch);
  EXPECT_EQ(mine.value().key, viewer::chord_of("Ctrl+1"));
  EXPECT_TRUE(viewer::read_preset(viewer::preset_file(home(), other.name)).ok());
}

}  // namespace
}  // namespace argil
