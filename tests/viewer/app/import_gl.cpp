// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh on its way through the dialog into clay, and outlines over it, in a real window.
#include <string>

#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"

#include "support/shapes.h"
#include "viewer/support/window_run.h"

namespace argil {
namespace {

using test::WindowRun;

class ViewImportGl : public test::WindowTest {
 protected:
  /// A box of 10 x 20 x 40 dropped on the window, and what the clay is saved as afterwards.
  WindowRun dropped(const std::string& script) {
    const auto file = folder_ / "box.stl";
    EXPECT_TRUE(io::write_mesh(file, test::box_mesh({10.0, 20.0, 40.0})).ok());
    return play("settle\ndrop " + file.string() + "\nframes 3\nsettle\nframes 4\n" + script);
  }
  std::string save() { return "key Ctrl+Shift+S\n" + test::name_file(folder_ / "s.vdb"); }
  Box3 saved_bounds() {
    const auto clay = io::load_project(folder_ / "s.vdb");
    EXPECT_TRUE(clay.ok());
    return clay ? clay.value().bounds_mm() : Box3();
  }
};

TEST_F(ViewImportGl, AMeshIsImportedAsTheDialogSays) {
  const WindowRun run = dropped(
      "click Height, mm##import\nkey Ctrl+A\ntype 20\nkey Enter\nframes 2\n"
      "click Finest voxel, mm##import\nkey Ctrl+A\ntype 0.5\nkey Enter\nframes 2\n"
      "click Up\nframes 3\nclick Up/y\nframes 2\nkey Enter\nframes 2\nsettle\n" +
      save());
  EXPECT_EQ(run.status, 0) << run.words;
  EXPECT_EQ(run.report.at("complaints").size(), 0U) << run.report.dump();
  const Vec3 size = saved_bounds().size();
  constexpr double kRoom = 2.3;  // that the bounds of a clay leave around it
  EXPECT_NEAR(size.x, 5.0, kRoom);
  EXPECT_NEAR(size.y, 20.0, kRoom);
  EXPECT_NEAR(size.z, 10.0, kRoom);
}

TEST_F(ViewImportGl, EscapeImportsNothing) {
  const WindowRun run = dropped("key Esc\nframes 3\nsettle\n" + save());
  EXPECT_EQ(run.status, 0) << run.words;
  EXPECT_NEAR(saved_bounds().size().x, 50.0, 2.0) << "the ball that was there";
}

TEST_F(ViewImportGl, ATrimIsDrawnOverThePicture) {
  const WindowRun run = play(
      "settle\nkey Num1\nsettle\nkey Q\nframes 3\nclick Drawn by\nframes 3\nclick Drawn by/Box\n"
      "frames 3\ndrag left 318 60 2 420\nsettle\n" +
      save());
  EXPECT_EQ(run.status, 0) << run.words;
  EXPECT_EQ(run.report.at("complaints").size(), 0U) << run.report.dump();
  const Box3 box = saved_bounds();
  EXPECT_NEAR(box.max.x, 25.0, 1.0);
  EXPECT_GT(box.min.x, -4.0) << "the left half is gone";
}

}  // namespace
}  // namespace argil
