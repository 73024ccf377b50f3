// SPDX-License-Identifier: GPL-3.0-or-later
// The program in a real window: what a person does there is found in the clay afterwards.
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/pick.h"
#include "argil/io/clay_check.h"
#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"
#include "argil/io/session.h"
#include "argil/mesh/check.h"

#include "commands/brush.h"
#include "support/built.h"
#include "support/effort.h"
#include "support/models.h"
#include "viewer/support/picture_alike.h"
#include "viewer/support/window_run.h"

namespace argil {
namespace {

using test::name_file;
using test::shell_word;
using test::WindowRun;

/// The clay that a window starts with, made once.
const Clay& first_clay() {
  static const Clay clay = Clay::ball(25.0, {}).value();
  return clay;
}

class ViewWindowGl : public test::WindowTest {
 protected:
  /// The sculpture after a script that ends with saving it, by a key that asks for its name.
  Clay sculpted_and_named(const std::string& script, const std::string& save_key = "Ctrl+S") {
    return played(script + "settle\nkey " + save_key + "\n" + name_file("s.vdb"), "");
  }
  /// The same from a project of the first clay, which is saved without a question: half the frames.
  Clay sculpted(const std::string& script, const Clay& from = first_clay()) {
    EXPECT_TRUE(io::save_project(folder_ / "s.vdb", from).ok());
    return played(script + "settle\nkey Ctrl+S\nsettle\n", shell_word(folder_ / "s.vdb"));
  }

  /// In a script: saves under a name in the folder of the test.
  static std::string save_as(const std::string& name) {
    return "key Ctrl+Shift+S\n" + name_file(name);
  }
  Clay saved(const std::string& name) const {
    auto clay = io::load_project(folder_ / name);
    EXPECT_TRUE(clay.ok()) << name;
    return clay ? std::move(clay).value() : Clay::ball(25.0, {}).value();
  }

  /// What the last window said of itself, for the message of a test that fails.
  const std::string& report() const { return report_; }

 private:
  std::string report_;

  Clay played(const std::string& script, const std::string& arguments) {
    const WindowRun run = play("settle\n" + script + "key Ctrl+Q\nframes 3\n", arguments);
    EXPECT_EQ(run.status, 0) << run.words;
    EXPECT_EQ(run.report.value("complaints", nlohmann::json()).size(), 0U) << run.report.dump();
    report_ = run.report.dump();
    return saved("s.vdb");
  }
};

/// In a script: hides the panels, which else lie over two thirds of so small a window, or shows
/// them again.
constexpr const char* kPanelsOnOff = "key Tab\n";

/// In a script: closes the device panel of a window that opened with it, by the cross in its head.
/// It would lie over the clay, and its curves are drawn again in each frame.
constexpr const char* kCloseDevicePanel =
    "move 450 43\nframes 2\npress left\nrelease left\nframes 2\n";

/// A line of a script: the left button drawn along X Y X Y.
std::string drag(const std::string& way, const std::string& modifiers = "") {
  return "drag left " + way + " " + std::to_string(test::effort(5, 20)) + " " + modifiers + "\n";
}
/// A stroke over the middle of a window without panels.
std::string stroke_in_front() { return drag("296 252 356 252"); }
/// One that the panels leave in sight.
std::string stroke_between_panels() { return drag("280 252 330 252"); }

std::optional<Pick> seen_at(const Clay& clay, const viewer::Camera& camera, double x, double y) {
  return pick(clay, camera.ray_at({x, y})).value();
}

TEST_F(ViewWindowGl, AFalconThatIsNotThereIsSaidWithTheRemedyAndTheMouseGoesOn) {
  const WindowRun run = play("settle\nframes 40\n", "--device falcon --firmware no-such-file.bin");
  EXPECT_EQ(run.status, 0) << run.words;
  ASSERT_EQ(run.report["complaints"].size(), 1U) << run.report.dump();
  EXPECT_NE(run.report["complaints"][0].get<std::string>().find("no-such-file.bin"),
            std::string::npos)
      << run.report.dump();
  EXPECT_EQ(run.report["most_force_n"], 0.0);
}

TEST_F(ViewWindowGl, APenThatIsPressedLessRaisesTheClayLess) {
  const auto camera = first_camera(first_clay().bounds_mm());
  const auto distance = [&](const std::string& pen) {
    const Clay clay = sculpted(kPanelsOnOff + pen + stroke_in_front() + "pen 1\n");
    return seen_at(clay, camera, 326.0, 252.0).value().distance_mm;
  };
  const double untouched = seen_at(first_clay(), camera, 326.0, 252.0).value().distance_mm;
  const double light = untouched - distance("pen 0.25\n");
  EXPECT_GT(light, 0.02) << report();
  const double full = untouched - distance("");
  EXPECT_LT(light, 0.5 * full) << report();
}

TEST_F(ViewWindowGl, AStrokeOfTheMouseRaisesTheClayThereAndNowhereElse) {
  const Clay& before = first_clay();
  const Clay after = sculpted_and_named(kPanelsOnOff + stroke_in_front());
  const auto camera = first_camera(before.bounds_mm());
  for (const double x : {308.0, 326.0, 344.0}) {
    const auto was = seen_at(before, camera, x, 252.0);
    const auto is = seen_at(after, camera, x, 252.0);
    ASSERT_TRUE(was && is);
    EXPECT_GT(was->distance_mm - is->distance_mm, 0.2) << x;
  }
  for (const double y : {180.0, 324.0}) {
    const auto was = seen_at(before, camera, 326.0, y);
    const auto is = seen_at(after, camera, 326.0, y);
    ASSERT_TRUE(was && is);
    EXPECT_LT(std::abs(was->distance_mm - is->distance_mm), 0.01) << y;
  }
}

TEST_F(ViewWindowGl, CtrlLowersTheClay) {
  const Clay& before = first_clay();
  const Clay after = sculpted(kPanelsOnOff + drag("296 252 356 252", "ctrl"));
  const auto camera = first_camera(before.bounds_mm());
  const auto was = seen_at(before, camera, 326.0, 252.0);
  const auto is = seen_at(after, camera, 326.0, 252.0);
  ASSERT_TRUE(was && is);
  EXPECT_LT(was->distance_mm - is->distance_mm, -0.2);
}

TEST_F(ViewWindowGl, SymmetryRepeatsTheStrokeOnTheOtherSide) {
  const Clay after = sculpted(std::string("key X\n") + kPanelsOnOff + drag("356 210 392 270"));
  const Clay& before = first_clay();
  int changed = 0;
  for (int n = 0; n < 20'000; ++n) {
    const double a = 0.37 * n;
    const double z = -1.0 + 2.0 * (n + 0.5) / 20'000;
    const double r = std::sqrt(1.0 - z * z);
    const Vec3 p = 25.3 * Vec3{r * std::cos(a), r * std::sin(a), z};
    const double here = after.distance_at(p);
    // The field is the same to the bit (engine/symmetry); what lies between its nodes is rounded.
    EXPECT_NEAR(here, after.distance_at({-p.x, p.y, p.z}), 1e-6);
    if (std::abs(here - before.distance_at(p)) > 0.1) ++changed;
  }
  EXPECT_GT(changed, 100);
}

TEST_F(ViewWindowGl, UndoGivesTheBitsBackAndRedoTakesThemAgain) {
  const std::string stroke = kPanelsOnOff + stroke_in_front() + "settle\n";
  const std::string undone = "key Ctrl+Z\nsettle\n" + save_as("u.vdb");
  const std::uint64_t redone =
      sculpted_and_named(stroke + save_as("o.vdb") + undone + "key Ctrl+Shift+Z\nsettle\n",
                         "Ctrl+Shift+S")
          .hash();
  const std::uint64_t once = saved("o.vdb").hash();
  EXPECT_NE(once, first_clay().hash());
  EXPECT_EQ(saved("u.vdb").hash(), first_clay().hash());
  EXPECT_EQ(redone, once);
}

TEST_F(ViewWindowGl, AClickInTheHistoryGoesToThatStep) {
  const std::string stroke = kPanelsOnOff + stroke_in_front() + "settle\n";
  const std::string thrice = stroke + save_as("o.vdb") + drag("296 192 356 192") + "settle\n" +
                             "key Alt+F\nsettle\nkey Ctrl+H\nframes 2\n" + save_as("t.vdb");
  const std::string back = "click 1: Draw, 5 mm\nsettle\n" + save_as("b.vdb") +
                           "click Start\nsettle\n" + save_as("f.vdb");
  const std::uint64_t last =
      sculpted_and_named(thrice + back + "click 3: Mask filled\nsettle\n", "Ctrl+Shift+S").hash();
  EXPECT_EQ(saved("b.vdb").hash(), saved("o.vdb").hash());
  EXPECT_EQ(saved("f.vdb").hash(), first_clay().hash());
  EXPECT_EQ(last, saved("t.vdb").hash());
  EXPECT_NE(last, saved("o.vdb").hash());
}

TEST_F(ViewWindowGl, EveryToolOfThePanelWorksTheClay) {
  const auto project = folder_ / "p.vdb";
  // Coarse: which tool it was is asked, not what it did.
  const ClayOptions voxels{test::effort(1.0, ClayOptions().voxel_mm)};
  ASSERT_TRUE(io::save_project(project, Clay::ball(25.0, voxels).value()).ok());
  const std::string drawn = "drag left 280 240 310 264 " + std::to_string(test::effort(2, 20));
  std::string script = "settle\n";
  for (const viewer::ToolInfo& tool : viewer::tool_infos()) {
    script += std::string("click ") + tool.title + "\n" + drawn + "\nsettle\n";
  }
  const WindowRun run = play(script, shell_word(project));
  ASSERT_EQ(run.status, 0) << run.words;
  EXPECT_EQ(run.report.at("complaints").size(), 0U) << run.report.dump();
  // Nobody saved, so the journal has every stroke.
  const auto journal = io::read_stroke_script(folder_ / "p.journal.jsonl");
  ASSERT_TRUE(journal.ok());
  const auto& steps = journal.value().steps;
  ASSERT_EQ(steps.size(), viewer::tool_infos().size());
  for (std::size_t n = 0; n < steps.size(); ++n) {
    const auto* stroke = std::get_if<Stroke>(&steps[n]);
    ASSERT_NE(stroke, nullptr);
    EXPECT_EQ(stroke->tool.action, viewer::tool_infos()[n].action);
  }
}

TEST_F(ViewWindowGl, AStampIsPutOnOnceWithTheMeshThatWasChosen) {
  std::ofstream(folder_ / "block.obj")
      << "v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\n"
         "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  // Raised below, imprinted above.
  const Clay after =
      sculpted("click Stamp\nclick Shape\nclick Shape/Mesh\n" + name_file(folder_ / "block.obj") +
               kPanelsOnOff + drag("320 270 372 270") + drag("320 190 372 190", "ctrl"));
  const auto camera = first_camera(first_clay().bounds_mm());
  const auto depth = [&](const Clay& clay, double x, double y) {
    const auto seen = seen_at(clay, camera, x, y);
    return seen ? seen->distance_mm : 0.0;
  };
  EXPECT_LT(depth(after, 320.0, 270.0), depth(first_clay(), 320.0, 270.0) - 0.5);
  EXPECT_GT(depth(after, 320.0, 190.0), depth(first_clay(), 320.0, 190.0) + 0.5);
  // Where a drag ended nothing was put.
  EXPECT_NEAR(depth(after, 372.0, 270.0), depth(first_clay(), 372.0, 270.0), 0.05);
}

TEST_F(ViewWindowGl, TheClickThatEndsAChangeOfTheBrushIsNoneOnAPanel) {
  // At 440, 190 is the head of the symmetry: closed by a click, it would have no X to click on.
  const Clay after =
      sculpted(std::string("move 360 190\nkey F\nmove 440 190\npress left\nrelease left\nframes 2\n"
                           "click X##mirror\n") +
               kPanelsOnOff + drag("356 210 392 270"));
  const Clay& before = first_clay();
  const auto was = seen_at(before, first_camera(before.bounds_mm()), 374.0, 240.0);
  ASSERT_TRUE(was);
  const Vec3 mirrored{-was->point_mm.x, was->point_mm.y, was->point_mm.z};
  EXPECT_LT(after.distance_at(mirrored), before.distance_at(mirrored) - 0.2);
}

TEST_F(ViewWindowGl, EscapeClosesADialogAndTheClayUnderItIsInReach) {
  const std::string stroke = drag("356 252 392 252");
  const Clay after =
      sculpted(kPanelsOnOff + ("key Ctrl+W\nframes 3\nkey Esc\nframes 3\n" + stroke));
  EXPECT_NE(after.hash(), first_clay().hash());
}

TEST_F(ViewWindowGl, EscapeClosesAListAndNoKeyGoesToTheClayBehindIt) {
  const std::string stroke = drag("356 252 392 252");
  const std::uint64_t plain = sculpted(kPanelsOnOff + stroke).hash();
  // The next press is the clay's again.
  const std::string list = "click File\nframes 2\nkey X\nkey Esc\nframes 2\n";
  EXPECT_EQ(sculpted(kPanelsOnOff + list + stroke).hash(), plain);
  const WindowRun closed =
      play("settle\nclick Shading\nframes 2\nkey Esc\nframes 2\nclick Shading/Plain\n");
  EXPECT_NE(closed.status, 0);
  EXPECT_NE(closed.words.find("Shading/Plain"), std::string::npos) << closed.words;
}

TEST_F(ViewWindowGl, BehindADialogNothingReacts) {
  const std::string away = "move 320 240\nscroll 3\nkey Ctrl+Z\nkey A\n";
  const std::string stroke = stroke_between_panels();
  const std::uint64_t plain = sculpted(stroke).hash();
  // Neither the mouse nor a key gets through to clay, camera or tools; then the same stroke does.
  std::string script;
  for (const std::string open : {"key Ctrl+W", "key Ctrl+N", "key Ctrl+E", "key Ctrl+O"}) {
    script.append(open).append("\nframes 3\n").append(stroke).append(away);
    script.append("click Carve\nkey Esc\nframes 3\n");
  }
  EXPECT_EQ(sculpted(script + stroke).hash(), plain);
}

/// What lies left of the panels.
Image without_side(const Image& image) {
  Image left = image;
  left.width = image.width - 300;
  left.rgb.clear();
  for (int row = 0; row < image.height; ++row) {
    const auto start = image.rgb.begin() + static_cast<std::ptrdiff_t>(3) * row * image.width;
    left.rgb.insert(left.rgb.end(), start, start + static_cast<std::ptrdiff_t>(3) * left.width);
  }
  return left;
}

TEST_F(ViewWindowGl, TheDialogOfOperationsLeavesTheClayInSight) {
  // With its plane far away, all that the clay shows is as it was.
  std::vector<const char*> sizes = {"--width 960 --height 640"};
  if (test::effort(false, true)) sizes.push_back("--width 1280 --height 800");
  for (const char* const size : sizes) {
    const WindowRun run = play(
        "settle\nkey Ctrl+W\nframes 4\nclick at, mm\nkey Ctrl+A\ntype -1000\nkey Enter\n"
        "frames 3\nshot asked.png\nclick Close\nframes 3\nshot closed.png\n",
        "", size);
    ASSERT_EQ(run.status, 0) << run.words;
    EXPECT_TRUE(test::are_alike(without_side(test::read_picture(folder_ / "asked.png")),
                                without_side(test::read_picture(folder_ / "closed.png"))))
        << size;
  }
}

/// In a script: the pointer onto the clay and half a second there; the hand is on the clay after a
/// third of that. On a busy machine each frame takes longer, and so does all of it.
std::string hand_over_clay() {
  return "move 320 252\nframes " + std::to_string(test::effort(60, 120)) + "\n";
}

TEST_F(ViewWindowGl, TheSpaceBarStopsTheForceAndOnlyItsOwnButtonGivesItAgain) {
  const auto project = folder_ / "p.vdb";
  ASSERT_TRUE(io::save_project(project, first_clay()).ok());
  const std::string over = kPanelsOnOff + hand_over_clay();
  const auto most_force = [&](const std::string& gives) {
    const WindowRun run =
        play("key Space\nframes 2\nkey Space\nsettle\n" + gives + kCloseDevicePanel + over,
             "--device sim " + shell_word(project));
    EXPECT_EQ(run.status, 0) << run.words;
    return run.report.value("most_force_n", -1.0);
  };
  EXPECT_EQ(most_force(""), 0.0);
  // How much of it there is a busy machine decides.
  EXPECT_GT(most_force("click Give the force again\n"), 0.0);
}

TEST_F(ViewWindowGl, NoPanelThatOpensCoversTheButtonThatStopsTheForce) {
  const WindowRun run = play(
      "settle\nkey Ctrl+H\nclick View\nclick Print\nframes 3\nclick STOP the force (Space)\n"
      "frames 3\nclick Give the force again\nframes 3\nclick STOP\nframes 3\n"
      "click Give the force again\nframes 3\n",
      "--device sim", "--width 1280 --height 800");
  EXPECT_EQ(run.status, 0) << run.words;
}

TEST_F(ViewWindowGl, AnErrorStaysUntilItIsDismissedAndIsKeptInTheList) {
  // Other messages go after 6 s; a frame that shows nothing new takes 5 ms.
  const WindowRun run = play(
      "settle\ndrop none.vdb\nsettle\nframes 1300\nclick Dismiss\nframes 3\n"
      "key Ctrl+M\nframes 3\nclick Forget them\n");
  EXPECT_EQ(run.status, 0) << run.words;
  EXPECT_EQ(run.report.at("complaints").size(), 1U) << run.report.dump();
  const WindowRun twice =
      play("settle\ndrop none.vdb\nsettle\nframes 3\nclick Dismiss\nframes 3\nclick Dismiss\n");
  EXPECT_EQ(twice.status, 3);  // it was gone
}

TEST_F(ViewWindowGl, WhatAKilledWindowLeftCanBeLeftForLater) {
  const auto project = folder_ / "p.vdb";
  test::leave_a_stroke(project);
  for (const char* const word : {"click Not now\n", "key Esc\n"}) {
    // A new ball, and the project as it was.
    const WindowRun run =
        play(std::string("settle\n") + word + "settle\n" + stroke_between_panels() + "settle\n",
             shell_word(project));
    EXPECT_EQ(run.status, 0) << run.words;
    EXPECT_GT(run.report.at("dabs"), 1) << word;
    ASSERT_TRUE(io::left_steps(project).value());
    EXPECT_EQ(io::left_steps(project).value()->steps, 1U);
  }
}

TEST_F(ViewWindowGl, AKilledWindowLosesNoStrokeAndAsks) {
  const auto project = folder_ / "p.vdb";
  ASSERT_TRUE(io::save_project(project, first_clay()).ok());
  const auto input = folder_ / "strokes.txt";
  std::ofstream(input) << "settle\n" + stroke_between_panels() + "settle\n" +
                              drag("280 192 330 192") + "settle\nframes 10000\n";
  const WindowRun killed = run_beside(
      "n=0\nwhile [ $n -lt 600 ] && "
      "[ \"$(grep -c radius " +
          shell_word(folder_ / "p.journal.jsonl") +
          " 2>/dev/null)\" != 2 ]\n"
          "do sleep 0.1; n=$((n+1)); done\nkill -9 $view; wait $view; exit 0\n",
      "--input " + shell_word(input) + " " + shell_word(project));
  ASSERT_EQ(killed.status, 0) << killed.words;
  const auto left = io::left_steps(project);
  ASSERT_TRUE(left.ok() && left.value());
  EXPECT_EQ(left.value()->steps, 2U);
  const std::uint64_t recovered = io::open_project(project).value().sculpture.hash();
  EXPECT_NE(recovered, first_clay().hash());

  const WindowRun again = play(
      "settle\nclick Recover\nsettle\nkey Ctrl+S\nsettle\nkey Ctrl+Q\n"
      "frames 3\n",
      shell_word(project));
  EXPECT_EQ(again.status, 0) << again.words;
  EXPECT_EQ(io::load_project(project).value().hash(), recovered);
  EXPECT_FALSE(io::left_steps(project).value());
}

TEST_F(ViewWindowGl, WhatIsNotRecoveredIsKeptBesideTheProject) {
  const auto project = folder_ / "p.vdb";
  test::leave_a_stroke(project);
  const WindowRun run = play("settle\nclick Open as it was saved\nsettle\nkey Ctrl+Q\nframes 3\n",
                             shell_word(project));
  EXPECT_EQ(run.status, 0) << run.words;
  EXPECT_EQ(io::open_project(project).value().sculpture.hash(), first_clay().hash());
  EXPECT_TRUE(std::filesystem::exists(folder_ / "p.journal.jsonl.left-1"));
}

TEST_F(ViewWindowGl, ANameIsTypedAtOnceAndNothingWithoutANameStaysBehind) {
  const WindowRun saved =
      play("settle\n" + stroke_between_panels() +
               "settle\nkey Ctrl+S\nframes 3\ntype typed.vdb\nkey Enter\nsettle\n",
           "--latency");
  EXPECT_EQ(saved.status, 0) << saved.words;
  EXPECT_GT(saved.report.at("latency_ms").at("p50"), 0.0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "typed.vdb"));
  EXPECT_TRUE(std::filesystem::is_empty(home() / "unsaved"));
  // Nor does a new clay that nobody touched, however the window ends.
  const WindowRun untouched = play("settle\n");
  EXPECT_EQ(untouched.status, 0) << untouched.words;
  EXPECT_TRUE(std::filesystem::is_empty(home() / "unsaved"));
}

TEST_F(ViewWindowGl, EveryProjectThatWasLeftWithoutANameIsOffered) {
  const auto unsaved = home() / "unsaved";
  test::leave_a_stroke(unsaved / "Untitled-1.vdb", 10.0);
  const std::uint64_t second = test::leave_a_stroke(unsaved / "Untitled-2.vdb", 12.0);
  // Both of the same minute, by the name in the list; the first is the newer one.
  const auto journal = unsaved / "Untitled-2.journal.jsonl";
  const auto minute = std::filesystem::last_write_time(journal);
  std::filesystem::last_write_time(unsaved / "Untitled-1.vdb", minute + std::chrono::hours(1));
  const std::time_t seconds = std::chrono::system_clock::to_time_t(
      std::chrono::time_point_cast<std::chrono::system_clock::duration>(
          std::chrono::file_clock::to_sys(minute)));
  std::array<char, 64> clock{};
  std::tm local{};
  localtime_r(&seconds, &local);
  std::strftime(clock.data(), clock.size(), "%d %B %Y, %H:%M", &local);
  const std::string label = std::string("Untitled-2, ") + clock.data();

  const auto named = folder_ / "second.vdb";
  for (const std::string& way :
       {"click " + label + "\nsettle\n",  // in the question about the first one
        "click Not now\nsettle\nclick File\nclick Never saved\nclick " + label + "\nsettle\n"}) {
    const WindowRun run = play("settle\n" + way + "click Recover\nsettle\nkey Ctrl+Shift+S\n" +
                               name_file(named) + "key Ctrl+Q\nframes 3\n");
    EXPECT_EQ(run.status, 0) << run.words;
    EXPECT_EQ(io::load_project(named).value().hash(), second);
    EXPECT_FALSE(std::filesystem::exists(unsaved / "Untitled-2.vdb"));
    EXPECT_TRUE(std::filesystem::exists(unsaved / "Untitled-1.vdb"));
    test::leave_a_stroke(unsaved / "Untitled-2.vdb", 12.0);
    std::filesystem::last_write_time(journal, minute);
  }
}

TEST_F(ViewWindowGl, WhatWasLeftWithoutANameIsThrownAwayAfterASecondQuestion) {
  const auto file = home() / "unsaved/Untitled-1.vdb";
  test::leave_a_stroke(file, 10.0);
  const WindowRun kept = play(
      "settle\nclick Throw it away...\nframes 3\nkey Esc\nframes 3\n"
      "click Throw it away...\nframes 3\nclick Keep it\nframes 3\nclick Not now\nsettle\n"
      "key Ctrl+Q\nframes 3\n");
  EXPECT_EQ(kept.status, 0) << kept.words;
  ASSERT_TRUE(io::left_steps(file).value());
  const WindowRun gone = play(
      "settle\nclick Throw it away...\nframes 3\nclick Throw it away for good\nsettle\n"
      "key Ctrl+Q\nframes 3\n");
  EXPECT_EQ(gone.status, 0) << gone.words;
  EXPECT_TRUE(std::filesystem::is_empty(home() / "unsaved"));
}

TEST_F(ViewWindowGl, WhatIsAskedAboutNoMoreIsAskedAboutWhenItWasWorkedOnSince) {
  const auto file = home() / "unsaved/Untitled-1.vdb";
  test::leave_a_stroke(file, 10.0);
  const std::string ends = "key Ctrl+Q\nframes 3\n";
  const WindowRun first = play("settle\nclick Ask no more\nsettle\n" + ends);
  EXPECT_EQ(first.status, 0) << first.words;
  const WindowRun next = play("settle\n" + stroke_between_panels() + "settle\n" + ends +
                              "click Do not save\nframes 3\n");
  EXPECT_EQ(next.status, 0) << next.words;
  EXPECT_GT(next.report.at("dabs"), 1) << "no question stood before the clay";
  EXPECT_TRUE(io::left_steps(file).value());
  const auto journal = home() / "unsaved/Untitled-1.journal.jsonl";
  std::filesystem::last_write_time(
      journal, std::filesystem::last_write_time(journal) + std::chrono::seconds(2));
  const WindowRun later = play("settle\nclick Not now\nsettle\n" + ends);
  EXPECT_EQ(later.status, 0) << later.words;
}

TEST_F(ViewWindowGl, AMeshIsImportedByArgumentAndExportedForPrinting) {
  ARGIL_MODEL_OR_SKIP(spot, "spot.obj");
  // Narrow, for as many voxels go along it and fewer around: less than a quarter of the surface.
  const double across = test::effort(0.15, 1.0);
  auto mesh_in = io::read_mesh(spot);
  ASSERT_TRUE(mesh_in.ok());
  for (Vec3& p : mesh_in.value().positions) p = {across * p.x, across * p.y, p.z};
  const auto in = folder_ / "narrow.obj";
  ASSERT_TRUE(io::write_mesh(in, mesh_in.value()).ok());
  const auto out = folder_ / "spot.3mf";
  const WindowRun run = play("settle\nkey Ctrl+E\nframes 3\nclick Choose a file...\n" +
                                 name_file(out) + "key Ctrl+Q\nframes 2\n",
                             shell_word(in));
  EXPECT_EQ(run.status, 0) << run.words;
  const auto mesh = io::read_mesh(out);
  ASSERT_TRUE(mesh.ok()) << run.words;
  EXPECT_TRUE(mesh::check_mesh(mesh.value()).printable);
  EXPECT_GT(mesh.value().triangles.size(), 20'000U);
}

TEST_F(ViewWindowGl, EveryPanelOpens) {
  const auto project = folder_ / "p.vdb";
  const double radius_mm = test::effort(10.0, 25.0);
  const ClayOptions voxels{test::effort(0.5, ClayOptions().voxel_mm)};
  ASSERT_TRUE(io::save_project(project, Clay::ball(radius_mm, voxels).value()).ok());
  const WindowRun run = play(
      "settle\nclick View\nclick Clay's figures\nclick View\nclick Print\nclick Check\nsettle\n"
      "click Hollow with drains\nframes 2\nclick Stroke\nframes 2\nkey Ctrl+H\nkey Ctrl+M\n"
      "frames 2\nkey F1\nframes 2\nkey F1\nkey Ctrl+N\nframes 3\nclick Not now\n"
      "key Ctrl+W\nframes 3\nclick Hollow\nsettle\nkey Ctrl+E\nframes 3\nclick Close\n"
      "key Ctrl+O\nframes 3\nclick Cancel\nframes 2\nclick Mask\nframes 2\n"
      "click Fill##mask\nsettle\nclick Device\nclick Device panel\nclick Feel\nframes 2\n"
      "key W\nkey Shift+W\nsettle\nkey Shift+Z\n"
      "frames 2\nkey Z\nframes 2\nkey Z\nframes 2\nkey Z\nframes 2\nkey Tab\nframes 2\n",
      shell_word(project), "--width 960 --height 640");
  EXPECT_EQ(run.status, 0) << run.words;
  EXPECT_EQ(run.report.at("gl_errors"), 0);
  EXPECT_EQ(run.report.at("complaints").size(), 0U) << run.report.dump();
}

TEST_F(ViewWindowGl, APrinterIsChosenFromThoseOfTheCheckAndKept) {
  const auto project = folder_ / "p.vdb";
  const ClayOptions voxels{test::effort(1.0, 0.5)};
  ASSERT_TRUE(io::save_project(project, Clay::block({100.0, 100.0, 10.0}, voxels).value()).ok());
  // 100 mm are too wide for the bed of resin.json; the next window still asks for it.
  const std::string check = "click View\nclick Print\nclick Check\nsettle\nframes 3\n";
  const std::string places = "click too_large at 0.0, 0.0, 0.0##1\n";
  const WindowRun any = play("settle\n" + check + places, shell_word(project));
  EXPECT_NE(any.status, 0);
  const WindowRun chosen = play(
      "settle\nclick View\nclick Print\nclick Printer\nclick Printer/resin\nclick Check\n"
      "settle\nframes 3\n" +
          places,
      shell_word(project));
  EXPECT_EQ(chosen.status, 0) << chosen.words;
  const WindowRun later = play("settle\n" + check + places, shell_word(project));
  EXPECT_EQ(later.status, 0) << later.words;
}

TEST_F(ViewWindowGl, AHollowHasTheDrainsThatWereClicked) {
  const Clay hollow = sculpted(
      "click View\nclick Print\nclick Hollow with drains\nframes 2\nclick Add a drain\n"
      "move 310 352\nframes 2\npress left\nrelease left\nframes 2\nclick Hollow it\n",
      Clay::ball(25.0, ClayOptions{test::effort(0.5, 0.25)}).value());
  EXPECT_GT(hollow.distance_at({0.0, 0.0, 0.0}), 0.5);
  mesh::Printer printer;
  printer.needs_drains = true;
  const auto judged = io::check_clay(hollow, printer);
  ASSERT_TRUE(judged.ok());
  for (const mesh::MeshProblem& problem : judged.value().verdict.problems) {
    EXPECT_NE(problem.kind, "trapped_volume");
  }
  const auto was = seen_at(first_clay(), first_camera(first_clay().bounds_mm()), 310.0, 352.0);
  ASSERT_TRUE(was);
  EXPECT_GT(hollow.distance_at(0.98 * was->point_mm), 0.5);
}

TEST_F(ViewWindowGl, TheNumberRowLooksAsTheNumpadDoesAndThatIsKept) {
  const std::string stroke = drag("290 240 330 240");
  const std::uint64_t front = sculpted("key Num1\n" + stroke).hash();
  EXPECT_NE(sculpted("key 1\n" + stroke).hash(), front);
  EXPECT_EQ(sculpted("click Number row as numpad\nkey 1\n" + stroke).hash(), front);
  EXPECT_EQ(sculpted("key 1\n" + stroke).hash(), front);
}

/// Usually eight times.
TEST_F(ViewWindowGl, OpeningAndClosingAHundredTimesLeavesNoObject) {
  const auto one = folder_ / "one.vdb";
  const auto two = folder_ / "two.vdb";
  ASSERT_TRUE(io::save_project(one, Clay::ball(10.0, {}).value()).ok());
  ASSERT_TRUE(io::save_project(two, Clay::block({12.0, 10.0, 8.0}, {}).value()).ok());
  const auto script_of = [&](int times) {
    std::string script = "settle\n";
    for (int n = 0; n < times; ++n) {
      script += "drop " + (n % 2 == 0 ? two : one).string() + "\nsettle\n";
    }
    return script;
  };
  const std::string file = shell_word(one);
  const WindowRun few = play(script_of(2), file);
  const WindowRun many = play(script_of(test::effort(8, 100)), file);
  ASSERT_EQ(few.status, 0) << few.words;
  ASSERT_EQ(many.status, 0) << many.words;
  EXPECT_EQ(many.report.at("gl_objects"), few.report.at("gl_objects"));
  EXPECT_EQ(many.report.at("complaints").size(), 0U) << many.report.dump();
}

TEST_F(ViewWindowGl, AMouseOfTheSystemSculpts) {
  ARGIL_CLIENT_OR_SKIP("xdotool");
  const auto project = folder_ / "p.vdb";
  ASSERT_TRUE(io::save_project(project, first_clay()).ok());
  const WindowRun run = run_beside(
      "n=0\nwhile [ $n -lt 300 ] && ! xdotool search --name 'p.vdb - Argil' >/dev/null 2>&1\n"
      "do sleep 0.1; n=$((n+1)); done\nsleep 1\n"
      "xdotool key Tab; xdotool mousemove 296 252; sleep 0.5; xdotool mousedown 1; sleep 0.3\n"
      "for x in 308 320 332 344 356; do xdotool mousemove $x 252; sleep 0.1; done\n"
      "xdotool mouseup 1; sleep 0.5; touch begun\n"
      // Again and again: a busy machine may not have done the stroke yet, and saving waits for
      // that.
      "n=0\nwhile [ $n -lt 40 ] && ! [ p.vdb -nt begun ]\n"
      "do xdotool key ctrl+s; sleep 0.5; n=$((n+1)); done\n"
      "xdotool key ctrl+q; wait $view\n",
      shell_word(project));
  EXPECT_EQ(run.status, 0) << run.words;
  const Clay after = io::load_project(project).value();
  const Clay& before = first_clay();
  const auto camera = first_camera(before.bounds_mm());
  const auto was = seen_at(before, camera, 326.0, 252.0);
  const auto is = seen_at(after, camera, 326.0, 252.0);
  ASSERT_TRUE(was && is);
  EXPECT_GT(was->distance_mm - is->distance_mm, 0.2);
}

TEST_F(ViewWindowGl, TheSimulatedFalconFeelsTheClayAndWorksIt) {
  const std::string over = kCloseDevicePanel + (kPanelsOnOff + hand_over_clay());
  const auto project = folder_ / "p.vdb";
  ASSERT_TRUE(io::save_project(project, first_clay()).ok());
  const WindowRun felt = play("settle\n" + over, "--device sim " + shell_word(project));
  EXPECT_EQ(felt.status, 0) << felt.words;
  EXPECT_GT(felt.report.at("most_force_n"), 0.1);
  EXPECT_LT(felt.report.at("most_force_n"), 9.0);
  EXPECT_EQ(io::open_project(project).value().sculpture.hash(), first_clay().hash());

  // Chosen in the panel instead, and pressed.
  const WindowRun worked = play(
      "settle\nclick Device\nclick Device panel\nclick Device\n"
      "click Device/Simulated Falcon\nsettle\n" +
          over +
          "press left\nframes 5\nmove 344 252\nframes 30\nrelease left\n"
          "frames 5\nsettle\nkey Ctrl+S\nsettle\nkey Ctrl+Q\nframes 3\n",
      shell_word(project));
  EXPECT_EQ(worked.status, 0) << worked.words;
  EXPECT_GT(worked.report.at("dabs"), 1) << worked.report.dump();
  EXPECT_NE(io::load_project(project).value().hash(), first_clay().hash());
}

TEST_F(ViewWindowGl, WithTheMouseAloneTheForceIsShownWhereItIsWanted) {
  const auto most_force = [&](const std::string& wish) {
    const WindowRun run = play("settle\nclick Device\nclick Device panel\nframes 3\n" + wish +
                                   "move 640 420\nframes 3\nsettle\n",
                               "", "--width 1280 --height 800");
    EXPECT_EQ(run.status, 0) << run.words;
    return run.report.value("most_force_n", -1.0);
  };
  EXPECT_EQ(most_force(""), 0.0);
  EXPECT_GT(most_force("click Show the force\n"), 0.5);
}

TEST(ViewWithoutADisplay, SaysSoAndEndsAsADeviceThatIsMissing) {
  const test::ProgramRun run = test::run_program(
      {"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", test::argil_program(), "view"});
  EXPECT_EQ(run.status, 4);
  EXPECT_NE(run.output.find("display"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("xvfb-run"), std::string::npos) << run.output;
}

}  // namespace
}  // namespace argil
