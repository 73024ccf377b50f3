// SPDX-License-Identifier: GPL-3.0-or-later
// Every way to show clay, against pictures that somebody looked at (tests/viewer/reference).
#include <gtest/gtest.h>

#include "argil/io/project_file.h"

#include "viewer/support/picture_alike.h"
#include "viewer/support/window_run.h"

namespace argil {
namespace {

/// A stroke and its mirror image over the upper front of a ball of 25 mm.
Stroke across(Action action, double radius_mm, double strength, double height_mm) {
  Stroke stroke;
  stroke.tool.action = action;
  stroke.tool.radii_mm = {radius_mm, radius_mm, radius_mm};
  stroke.tool.strength = strength;
  stroke.mirror.x = true;
  for (int n = 0; n <= 10; ++n) {
    const Vec3 toward = normalized(Vec3{2.0 + 1.6 * n, -20.0, height_mm});
    stroke.samples.push_back({0.01 * n, 25.0 * toward, {}, 1.0});
  }
  return stroke;
}

/// A ball with a ridge, a fine groove, which makes finer levels, and a mask.
Clay shown_clay() {
  Clay clay = Clay::ball(25.0, {}).value();
  for (const Stroke& stroke :
       {across(Action::inflate, 5.0, 0.8, 12.0), across(Action::carve, 1.0, 1.0, 0.0),
        across(Action::mask, 4.0, 1.0, -10.0)}) {
    EXPECT_TRUE(clay.apply(stroke).ok());
  }
  return clay;
}

class ViewModesGl : public test::WindowTest {};

TEST_F(ViewModesGl, EveryModeLooksAsCommitted) {
  const auto project = folder_ / "modes.vdb";
  ASSERT_TRUE(io::save_project(project, shown_clay()).ok());
  // Without panels, which would hide the clay of so small a window; the help stands over them.
  const test::WindowRun run = play(
      "settle\nkey X\nkey Tab\nmove 20 460\nframes 3\n"
      "shot clay.png\n"
      "key Z\nframes 3\nshot plain.png\n"
      "key Z\nframes 3\nshot curvature.png\n"
      "key Z\nframes 3\nshot detail.png\n"
      "key Z\nkey W\nframes 3\nshot wireframe.png\nkey W\n"
      "key Shift+W\nsettle\nframes 3\nshot slice.png\nkey Shift+W\n"
      "key Shift+Z\nframes 3\nshot stereo.png\nkey Shift+Z\n"
      "key Tab\nkey F1\nframes 3\nshot help.png\n"
      "key Ctrl+Q\nframes 3\n",
      "modes.vdb", "--width 640 --height 480");
  ASSERT_EQ(run.status, 0) << run.words;
  EXPECT_EQ(run.report.at("gl_errors"), 0);
  EXPECT_EQ(run.report.at("complaints").size(), 0U) << run.report.dump();
  for (const char* const mode :
       {"clay", "plain", "curvature", "detail", "wireframe", "slice", "stereo", "help"}) {
    const std::string name = std::string(mode) + ".png";
    EXPECT_TRUE(test::is_as_committed(folder_ / name, "tests/viewer/reference/" + name));
  }
}

}  // namespace
}  // namespace argil
