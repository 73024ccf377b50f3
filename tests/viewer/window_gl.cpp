// SPDX-License-Identifier: GPL-3.0-or-later
// The program in a real window: what a person does there is found in the clay afterwards.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "argil/engine/pick.h"
#include "argil/io/mesh_check.h"
#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"
#include "argil/io/session.h"

#include "support/models.h"
#include "window_run.h"

namespace argil {
namespace {

using test::name_file;
using test::shell_word;
using test::WindowRun;

/// The clay that a window starts with.
Clay first_clay() { return Clay::ball(25.0, {}).value(); }

class ViewWindowGl : public test::WindowTest {
 protected:
  /// The sculpture after a script that ends with saving it.
  Clay sculpted(const std::string& script) {
    const auto file = folder_ / "sculpture.vdb";
    const WindowRun run = play("settle\n" + script + "settle\nkey Ctrl+S\n" + name_file(file) +
                               "key Ctrl+Q\nframes 3\n");
    EXPECT_EQ(run.status, 0) << run.words;
    EXPECT_EQ(run.report.value("complaints", nlohmann::json()).size(), 0U) << run.report.dump();
    auto clay = io::load_project(file);
    EXPECT_TRUE(clay.ok()) << run.words;
    return clay ? std::move(clay).value() : first_clay();
  }
};

std::optional<Pick> seen_at(const Clay& clay, const viewer::Camera& camera, double x, double y) {
  return pick(clay, camera.ray_at({x, y})).value();
}

TEST_F(ViewWindowGl, AStrokeOfTheMouseRaisesTheClayThereAndNowhereElse) {
  const Clay before = first_clay();
  const Clay after = sculpted("drag left 600 420 700 420 20\n");
  const auto camera = first_camera(before.bounds_mm());
  for (const double x : {620.0, 650.0, 680.0}) {
    const auto was = seen_at(before, camera, x, 420.0);
    const auto is = seen_at(after, camera, x, 420.0);
    ASSERT_TRUE(was && is);
    EXPECT_GT(was->distance_mm - is->distance_mm, 0.2) << x;
  }
  for (const double y : {300.0, 540.0}) {
    const auto was = seen_at(before, camera, 650.0, y);
    const auto is = seen_at(after, camera, 650.0, y);
    ASSERT_TRUE(was && is);
    EXPECT_LT(std::abs(was->distance_mm - is->distance_mm), 0.01) << y;
  }
}

TEST_F(ViewWindowGl, CtrlLowersTheClay) {
  const Clay before = first_clay();
  const Clay after = sculpted("drag left 600 420 700 420 20 ctrl\n");
  const auto camera = first_camera(before.bounds_mm());
  const auto was = seen_at(before, camera, 650.0, 420.0);
  const auto is = seen_at(after, camera, 650.0, 420.0);
  ASSERT_TRUE(was && is);
  EXPECT_LT(was->distance_mm - is->distance_mm, -0.2);
}

TEST_F(ViewWindowGl, SymmetryRepeatsTheStrokeOnTheOtherSide) {
  const Clay after = sculpted("key X\ndrag left 700 350 760 450 20\n");
  const Clay before = first_clay();
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
  const std::string stroke = "drag left 600 420 700 420 20\nsettle\n";
  const std::uint64_t once = sculpted(stroke).hash();
  EXPECT_NE(once, first_clay().hash());
  EXPECT_EQ(sculpted(stroke + "key Ctrl+Z\nsettle\n").hash(), first_clay().hash());
  const std::string again = "key Ctrl+Z\nsettle\nkey Ctrl+Shift+Z\nsettle\n";
  EXPECT_EQ(sculpted(stroke + again).hash(), once);
}

TEST_F(ViewWindowGl, AClickInTheHistoryGoesToThatStep) {
  const std::string stroke = "drag left 600 420 700 420 20\nsettle\n";
  const std::uint64_t once = sculpted(stroke).hash();
  const std::string thrice = stroke + "drag left 600 320 700 320 20\nsettle\n" +
                             "key Alt+F\nsettle\nkey Ctrl+H\nframes 2\n";
  EXPECT_EQ(sculpted(thrice + "click 1: Draw, 5 mm\nsettle\n").hash(), once);
  EXPECT_EQ(sculpted(thrice + "click Start\nsettle\n").hash(), first_clay().hash());
  EXPECT_EQ(sculpted(thrice + "click Start\nsettle\nclick 3: Mask filled\nsettle\n").hash(),
            sculpted(thrice).hash());
}

TEST_F(ViewWindowGl, TheClickThatEndsAChangeOfTheBrushIsNoneOnAPanel) {
  // At 1080, 190 is the head of the symmetry: closed by a click, it would have no X to click on.
  const Clay after = sculpted(
      "move 1000 190\nkey F\nmove 1080 190\npress left\nrelease left\nframes 2\n"
      "click X##mirror\ndrag left 700 350 760 450 20\n");
  const Clay before = first_clay();
  const auto was = seen_at(before, first_camera(before.bounds_mm()), 730.0, 400.0);
  ASSERT_TRUE(was);
  const Vec3 mirrored{-was->point_mm.x, was->point_mm.y, was->point_mm.z};
  EXPECT_LT(after.distance_at(mirrored), before.distance_at(mirrored) - 0.2);
}

TEST_F(ViewWindowGl, EscapeClosesADialogAndTheClayUnderItIsInReach) {
  const Clay after = sculpted(
      "key Ctrl+W\nframes 3\nkey Esc\nframes 3\n"
      "drag left 600 420 700 420 20\n");
  EXPECT_NE(after.hash(), first_clay().hash());
}

TEST_F(ViewWindowGl, AKilledWindowLosesNoStrokeAndAsks) {
  const auto project = folder_ / "p.vdb";
  ASSERT_TRUE(io::save_project(project, first_clay()).ok());
  const auto input = folder_ / "strokes.txt";
  std::ofstream(input) << "settle\ndrag left 600 420 700 420 20\nsettle\n"
                          "drag left 600 320 700 320 20\nsettle\nframes 10000\n";
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
  const std::uint64_t recovered = io::open_project(project).value().clay.hash();
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
  {
    auto session = io::Session::create(project, first_clay());
    ASSERT_TRUE(session.ok());
    Stroke stroke;
    stroke.samples = {{0.0, {25.0, 0.0, 0.0}, {}, 1.0}};
    ASSERT_TRUE(session.value().clay().apply(stroke).ok());
    session.value().record(stroke);
    ASSERT_TRUE(session.value().flush().ok());
  }
  const WindowRun run = play("settle\nclick Open as it was saved\nsettle\nkey Ctrl+Q\nframes 3\n",
                             shell_word(project));
  EXPECT_EQ(run.status, 0) << run.words;
  EXPECT_EQ(io::open_project(project).value().clay.hash(), first_clay().hash());
  EXPECT_TRUE(std::filesystem::exists(folder_ / "p.journal.jsonl.left-1"));
}

TEST_F(ViewWindowGl, AMeshIsImportedByArgumentAndExportedForPrinting) {
  ARGIL_MODEL_OR_SKIP(spot, "spot.obj");
  const auto out = folder_ / "spot.3mf";
  const WindowRun run = play("settle\nkey Ctrl+E\nframes 3\nclick Choose a file...\n" +
                                 name_file(out) + "key Ctrl+Q\nframes 2\n",
                             shell_word(spot));
  EXPECT_EQ(run.status, 0) << run.words;
  const auto mesh = io::read_mesh(out);
  ASSERT_TRUE(mesh.ok()) << run.words;
  EXPECT_TRUE(io::check_mesh(mesh.value()).printable);
  EXPECT_GT(mesh.value().triangles.size(), 20'000U);
}

TEST_F(ViewWindowGl, EveryPanelOpens) {
  const WindowRun run = play(
      "settle\nclick View\nclick Clay's figures\nclick View\nclick Print\nclick Check\nsettle\n"
      "click Stroke\nframes 2\nkey F1\nframes 2\nkey F1\nkey Ctrl+N\nframes 2\nclick Not now\n"
      "key Ctrl+W\nframes 2\nclick Hollow\nsettle\nkey Ctrl+E\nframes 2\nkey Ctrl+O\nframes 2\n"
      "click No file\nframes 2\nclick Mask\nframes 2\nclick Fill\nsettle\nkey W\nkey "
      "Shift+W\nsettle\nkey Shift+Z\n"
      "frames 2\nkey Z\nframes 2\nkey Z\nframes 2\nkey Z\nframes 2\nkey Tab\nframes 2\n");
  EXPECT_EQ(run.status, 0) << run.words;
  EXPECT_EQ(run.report.at("gl_errors"), 0);
  EXPECT_EQ(run.report.at("complaints").size(), 0U) << run.report.dump();
}

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
  const WindowRun many = play(script_of(100), file);
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
      "xdotool mousemove 600 420; sleep 0.5; xdotool mousedown 1; sleep 0.3\n"
      "for x in 610 620 630 640 650 660 670 680 690 700; do xdotool mousemove $x 420; sleep 0.1; "
      "done\n"
      "sleep 0.3; xdotool mouseup 1; sleep 0.5\n"
      "xdotool key ctrl+s; sleep 1; xdotool key ctrl+q; wait $view\n",
      shell_word(project));
  EXPECT_EQ(run.status, 0) << run.words;
  const Clay after = io::load_project(project).value();
  const Clay before = first_clay();
  const auto camera = first_camera(before.bounds_mm());
  const auto was = seen_at(before, camera, 650.0, 420.0);
  const auto is = seen_at(after, camera, 650.0, 420.0);
  ASSERT_TRUE(was && is);
  EXPECT_GT(was->distance_mm - is->distance_mm, 0.2);
}

TEST_F(ViewWindowGl, TheSimulatedFalconFeelsTheClayAndWorksIt) {
  const std::string over = "settle\nmove 640 420\nframes 60\n";
  const auto project = folder_ / "p.vdb";
  ASSERT_TRUE(io::save_project(project, first_clay()).ok());
  const WindowRun felt = play(over, "--device sim " + shell_word(project));
  EXPECT_EQ(felt.status, 0) << felt.words;
  EXPECT_GT(felt.report.at("most_force_n"), 0.1);
  EXPECT_LT(felt.report.at("most_force_n"), 9.0);
  EXPECT_EQ(io::open_project(project).value().clay.hash(), first_clay().hash());

  // Chosen in the panel instead, and pressed.
  const WindowRun worked = play(
      "settle\nclick Device\nclick Device panel\nclick Device\n"
      "click Device/Simulated Falcon\n" +
          over +
          "press left\nframes 5\nmove 680 420\nframes 30\nrelease left\n"
          "frames 5\nsettle\nkey Ctrl+S\nsettle\nkey Ctrl+Q\nframes 3\n",
      shell_word(project));
  EXPECT_EQ(worked.status, 0) << worked.words;
  EXPECT_GT(worked.report.at("dabs"), 1) << worked.report.dump();
  EXPECT_NE(io::load_project(project).value().hash(), first_clay().hash());
}

TEST(ViewWithoutADisplay, SaysSoAndEndsAsADeviceThatIsMissing) {
  const test::ProgramRun run =
      test::run_program({"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", ARGIL_BINARY, "view"});
  EXPECT_EQ(run.status, 4);
  EXPECT_NE(run.output.find("display"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("xvfb-run"), std::string::npos) << run.output;
}

}  // namespace
}  // namespace argil
