// SPDX-License-Identifier: GPL-3.0-or-later
// Sculpting in stereo: what is done in the half of an eye is found where that eye saw it.
#include <cmath>

#include <gtest/gtest.h>

#include "argil/engine/pick.h"
#include "argil/io/project_file.h"

#include "picture/stereo.h"
#include "viewer/support/window_run.h"

namespace argil {
namespace {

/// How far the clay came towards the eye at a pixel of the window, mm.
double raised_at(const Clay& before, const Clay& after, const viewer::WindowPart& part, double x,
                 double y) {
  const Ray ray = part.ray_at({x, y});
  const auto was = pick(before, ray).value();
  const auto is = pick(after, ray).value();
  return was && is ? was->distance_mm - is->distance_mm : 0.0;
}

/// The mean column of what was raised in a row of the window, within 80 columns of a place.
double middle_of_raised(const Clay& before, const Clay& after, const viewer::WindowPart& part,
                        double near_x, double y) {
  double sum = 0.0;
  double moment = 0.0;
  for (double x = near_x - 80.0; x <= near_x + 80.0; x += 2.0) {
    const double raised = raised_at(before, after, part, x, y);
    sum += raised;
    moment += raised * x;
  }
  EXPECT_GT(sum, 1.0) << "nothing was raised";
  return moment / sum;
}

class ViewStereoGl : public test::WindowTest {};

TEST_F(ViewStereoGl, AStrokeInEitherHalfIsWhereThatEyeSawIt) {
  const Clay before = Clay::ball(25.0, {}).value();
  ASSERT_TRUE(io::save_project(folder_ / "s.vdb", before).ok());
  // Without panels; one stroke in the upper part of the left half, one in the lower of the right.
  const test::WindowRun run = play(
      "settle\nkey Tab\nkey Shift+Z\nframes 3\n"
      "drag left 130 200 190 200 8\nsettle\n"
      "drag left 450 300 510 300 8\nsettle\n"
      "key Ctrl+S\nsettle\nkey Ctrl+Q\nframes 3\n",
      test::shell_word(folder_ / "s.vdb"));
  ASSERT_EQ(run.status, 0) << run.words;
  EXPECT_EQ(run.report.at("complaints").size(), 0U) << run.report.dump();
  EXPECT_EQ(run.report.at("gl_errors"), 0);
  EXPECT_GT(run.report.at("dabs"), 2);
  const auto after = io::load_project(folder_ / "s.vdb");
  ASSERT_TRUE(after.ok()) << after.error().message;
  const auto eyes = viewer::parts_of(first_camera(before.bounds_mm()), true);
  const double left = middle_of_raised(before, after.value(), eyes[0], 160.0, 200.0);
  const double right = middle_of_raised(before, after.value(), eyes[1], 480.0, 300.0);
  RecordProperty("left", std::to_string(left));
  RecordProperty("right", std::to_string(right));
  // The middle of what a stroke leaves is a little before that of its way. As the camera between
  // the eyes sees it, it would be 7 columns to the right in the left half, and to the left in the
  // right.
  EXPECT_NEAR(left, 160.0, 5.0);
  EXPECT_NEAR(left - 160.0, right - 480.0, 1.0);
  // The other eye sees it elsewhere, as far as it lies before the target.
  EXPECT_GT(middle_of_raised(before, after.value(), eyes[0], 160.0, 300.0) - 160.0, 4.0);
  EXPECT_EQ(raised_at(before, after.value(), eyes[0], 160.0, 400.0), 0.0);
}

}  // namespace
}  // namespace argil
