// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures where files are chosen: recent ones, those of a folder, and what a killed window left.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/io/project_file.h"
#include "argil/io/session.h"

#include "settings/settings.h"
#include "settings/thumbnail.h"
#include "support/scratch.h"
#include "viewer/support/picture_alike.h"
#include "viewer/support/window_run.h"

namespace argil {
namespace {

namespace fs = std::filesystem;
using test::shell_word;
using test::WindowRun;

class ViewRecentGl : public test::WindowTest {
 protected:
  viewer::PicturePlaces places() const { return viewer::picture_places(home(), true); }

  WindowRun played(const std::string& script, const std::string& arguments) {
    WindowRun run = play("settle\n" + script, arguments);
    EXPECT_EQ(run.status, 0) << run.words;
    if (run.status != 0) return run;
    EXPECT_EQ(run.report["gl_errors"], 0);
    EXPECT_EQ(run.report["complaints"].size(), 0U) << run.report.dump();
    return run;
  }

  /// A project that was open in a window, and closed.
  fs::path opened_project(const std::string& name, double radius_mm) {
    fs::path file = folder_ / name;
    EXPECT_TRUE(io::save_project(file, Clay::ball(radius_mm, {}).value()).ok());
    played("key Ctrl+Q\nframes 3\n", shell_word(file));
    EXPECT_TRUE(viewer::has_picture(places().saved, file)) << name;
    return file;
  }

  /// What a dialog of the window with this project shows, where its pictures are.
  std::vector<std::uint8_t> pictures_in_dialog(const std::string& opens, const fs::path& project) {
    // What is behind a dialog grows dark within a sixth of a second: 50 frames take longer.
    played(opens + "move 5 470\nframes 3\nsettle\nframes 50\nshot dialog.png\nkey Esc\nsettle\n",
           shell_word(project));
    const Image image = test::read_picture(folder_ / "dialog.png");
    std::vector<std::uint8_t> column;
    for (int y = 30; y < 450; ++y) {
      const auto from = image.rgb.begin() + 3 * (y * image.width + 30);
      column.insert(column.end(), from, from + 3 * 90);
    }
    return column;
  }
};

TEST_F(ViewRecentGl, AProjectIsOpenedByItsRowWhateverItIsCalled) {
  const fs::path odd = opened_project("50% t\xC3\xB6n & co.vdb", 10.0);
  const fs::path plain = opened_project("plain.vdb", 12.0);
  using Files = std::vector<fs::path>;
  ASSERT_EQ(viewer::read_recent(home()), (Files{plain, odd}));
  played("key Ctrl+Shift+O\nframes 3\nsettle\nclick " + odd.string() +
             "\nsettle\nkey Ctrl+Q\nframes 3\n",
         "");
  EXPECT_EQ(viewer::read_recent(home()), (Files{odd, plain}));
  // One that is gone is not opened, and may leave the list; the others stay.
  fs::remove(plain);
  played("click File\nframes 3\nclick Recent files...\nframes 3\nsettle\nclick " + plain.string() +
             "\nsettle\nclick x##forget " + plain.string() + "\nframes 3\nclick Close\nframes 3\n",
         "");
  EXPECT_EQ(viewer::read_recent(home()), Files{odd});
}

TEST_F(ViewRecentGl, ThePictureOfARowIsThatOfTheFileAsItIs) {
  const fs::path file = opened_project("p.vdb", 10.0);
  const fs::path other = opened_project("other.vdb", 10.0);
  const fs::path picture = viewer::picture_file(places().saved, file);
  const std::string kept = test::content_of(picture);
  const std::string opens = "key Ctrl+Shift+O\n";
  const auto with = pictures_in_dialog(opens, other);
  const auto without = [&](const std::string& content) {
    test::fill(picture, content);
    return pictures_in_dialog(opens, other);
  };
  const auto broken = without(kept.substr(0, kept.size() / 2));
  EXPECT_NE(broken, with);
  EXPECT_EQ(without("no picture"), broken);
  EXPECT_EQ(without(kept), with) << "the same picture again";
  // Written since, and the picture is not: another program did it.
  fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(2));
  EXPECT_EQ(pictures_in_dialog(opens, other), broken);
}

TEST_F(ViewRecentGl, TheListOfAFolderShowsTheMarkedProject) {
  const fs::path file = opened_project("p.vdb", 10.0);
  const auto right_of_list = [&] {
    played(
        "key Ctrl+O\nframes 3\nclick p.vdb\nmove 5 470\nframes 3\nsettle\nframes 3\n"
        "shot list.png\nkey Esc\nframes 3\n",
        "");
    const Image image = test::read_picture(folder_ / "list.png");
    std::vector<std::uint8_t> column;
    for (int y = 60; y < 300; ++y) {
      const auto from = image.rgb.begin() + 3 * (y * image.width + 440);
      column.insert(column.end(), from, from + 3 * 180);
    }
    return column;
  };
  const auto with = right_of_list();
  fs::remove(viewer::picture_file(places().saved, file));
  EXPECT_NE(right_of_list(), with);
}

TEST_F(ViewRecentGl, TheQuestionAboutLeftWorkShowsIt) {
  const fs::path file = opened_project("p.vdb", 10.0);
  // The window ends without saving, as if it were killed.
  played("drag left 280 252 330 252 5\nsettle\nframes 20\nsettle\n", shell_word(file));
  ASSERT_TRUE(io::left_steps(file).value());
  const viewer::FileLook look = viewer::look_at_file(places(), file);
  ASSERT_TRUE(look.work && look.picture);
  EXPECT_EQ(look.work->steps, 1U);
  const auto of_work = pictures_in_dialog("", file);
  fs::remove(viewer::picture_file(places().work, file));
  const auto of_saved = pictures_in_dialog("", file);
  EXPECT_NE(of_saved, of_work);
  fs::remove(viewer::picture_file(places().saved, file));
  const auto of_none = pictures_in_dialog("", file);
  EXPECT_NE(of_none, of_saved);
  EXPECT_NE(of_none, of_work);
  ASSERT_TRUE(io::left_steps(file).value()) << "looking at the question answers nothing";
}

/// A double click on "Throw it away..." does not throw anything away.
TEST_F(ViewRecentGl, TheSecondQuestionHasItsWayBackUnderThePointer) {
  const fs::path unsaved = home() / "unsaved";
  test::leave_a_stroke(unsaved / "Untitled-1.vdb", 10.0);
  played(
      "frames 3\nsettle\nclick Throw it away...\nframes 3\npress left\nrelease left\nframes 3\n"
      "click Throw it away...\nframes 3\nkey Esc\nframes 3\nclick Not now\nsettle\n"
      "key Ctrl+Q\nframes 3\n",
      "");
  EXPECT_TRUE(fs::exists(unsaved / "Untitled-1.vdb"));
}

}  // namespace
}  // namespace argil
