// SPDX-License-Identifier: GPL-3.0-or-later
// The ring of favourites in a real window, over its panels, and what one window keeps of it.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/io/project_file.h"

#include "commands/brush_preset.h"
#include "commands/favourites.h"
#include "support/scratch.h"
#include "viewer/support/picture_alike.h"
#include "viewer/support/window_run.h"

namespace argil {
namespace {

using test::shell_word;
using test::WindowRun;

class ViewFavouritesGl : public test::WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) return;
    ASSERT_TRUE(io::save_project(folder_ / "s.vdb", Clay::ball(25.0, {}).value()).ok());
  }
  WindowRun played(const std::string& script, const std::string& size = test::kWindowSize) {
    WindowRun run =
        play("settle\n" + script + "key Ctrl+Q\nframes 3\n", shell_word(folder_ / "s.vdb"), size);
    EXPECT_EQ(run.status, 0) << run.words;
    EXPECT_EQ(run.report["gl_errors"], 0);
    return run;
  }
  /// How many pixels of a part of two pictures differ clearly.
  int difference(const std::string& one, const std::string& other, int left, int top, int right,
                 int bottom) const {
    const Image a = test::read_picture(folder_ / one);
    const Image b = test::read_picture(folder_ / other);
    int differ = 0;
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        const std::size_t at = 3 * static_cast<std::size_t>(y * a.width + x);
        differ += std::abs(a.rgb.at(at) - b.rgb.at(at)) > 12 ? 1 : 0;
      }
    }
    return differ;
  }
  viewer::Favourites kept() const {
    const auto read = viewer::read_favourites(home());
    EXPECT_TRUE(read) << read.error().message;
    return read ? read.value() : viewer::Favourites{};
  }
};

TEST_F(ViewFavouritesGl, AFlickChoosesAndTheWindowsAfterKeepWhatIsChosenForTheRing) {
  viewer::BrushPreset mine;
  mine.name = "Mine";
  mine.brush.action = Action::pinch;
  ASSERT_TRUE(viewer::write_preset(home(), mine));
  // Takes Symmetry X out, adds the wireframe by Ctrl+Enter, and a brush by its star when there is
  // room again.
  played(
      "click Brush\nframes 2\nclick Change favourites\nframes 3\nclick x##gone8\nframes 2\n"
      "key Ctrl+K\ntype wirefr\nkey Ctrl+Enter\nframes 2\nkey Esc\nframes 2\n"
      "click x##gone3\nframes 2\nclick >##on2\nframes 2\nkey Shift+B\nframes 3\nclick Mine\n"
      "frames 2\nclick star of the brush\nframes 3\n",
      "--width 1000 --height 640");
  const viewer::Favourites now = kept();
  EXPECT_EQ(now[7], viewer::Favourite(viewer::Command::wires));
  EXPECT_EQ(now[1], viewer::Favourite(std::string("Mine")));
  EXPECT_EQ(now[2], viewer::usual_favourites()[1]) << "moved on";
  // The next window: a flick up and to the left, and none of the ring is left on the screen.
  const WindowRun run = played(
      "key Tab\nmove 20 430\nframes 3\nshot plain.png\nmove 300 200\nhold `\nmove 220 120\nlet `\n"
      "move 20 430\nframes 5\nshot wires.png\nkey W\nframes 5\nshot same.png\n");
  EXPECT_EQ(run.report["complaints"].size(), 0U) << run.report.dump();
  EXPECT_GT(difference("plain.png", "wires.png", 200, 100, 400, 380), 500);
  EXPECT_EQ(difference("plain.png", "same.png", 0, 40, 640, 420), 0);
}

/// Beside the right edge of the window all of the ring is there, over the brush's panel, and a
/// click on it presses nothing of that.
TEST_F(ViewFavouritesGl, StandsWhollyInTheWindowOverPanelsWhichAClickDoesNotReach) {
  viewer::Favourites favourites{};
  favourites[6] = viewer::Favourite(viewer::Command::wires);
  ASSERT_TRUE(viewer::write_favourites(home(), favourites));
  played(
      "move 636 150\nframes 3\nshot plain.png\nkey `\nframes 3\nshot ring.png\n"
      "click Invert\nframes 3\nmove 636 150\nframes 3\nshot after.png\n");
  // Its middle is at 506: it leaves four pixels at the edge.
  EXPECT_GT(difference("plain.png", "ring.png", 376, 30, 636, 280), 3000);
  EXPECT_EQ(difference("plain.png", "ring.png", 0, 40, 370, 440), 0);
  EXPECT_EQ(difference("plain.png", "ring.png", 638, 40, 640, 440), 0);
  EXPECT_GT(difference("plain.png", "after.png", 220, 100, 340, 380), 300) << "the wireframe";
  EXPECT_EQ(difference("plain.png", "after.png", 350, 40, 634, 260), 0) << "not inverted";
}

TEST_F(ViewFavouritesGl, AnOddFileAndABrushThatIsGoneAreSaidAndNothingIsWrittenOver) {
  const std::string odd = "{\n\"argil_favourites\": 1,\n\"north\": \"tool smooth\"}\n";
  test::fill(home() / "favourites.json", odd);
  played("key `\nframes 3\nmove 320 100\npress left\nrelease left\nframes 3\n");
  EXPECT_EQ(test::content_of(home() / "favourites.json"), odd);
  test::fill(home() / "favourites.json", "{\"argil_favourites\": 1, \"up\": \"brush Gone\"}");
  const WindowRun run = played(
      "move 300 240\nhold `\nmove 300 100\nlet `\nframes 3\nkey Ctrl+M\nframes 3\nshot said.png\n");
  EXPECT_EQ(run.report["complaints"].size(), 0U) << run.report.dump();
  viewer::Favourites with_gone{};
  with_gone[0] = viewer::Favourite(std::string("Gone"));
  EXPECT_EQ(kept(), with_gone);
}

}  // namespace
}  // namespace argil
