// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_workspace.h"

#include "haptics/scene/scene_checks.h"

namespace argil::haptics {
namespace {

using namespace scenes;

TEST(Section3_1, HasNoForceInsideAndByDefaultNoneOutside) {
  const WorkspaceScene scene;
  EXPECT_EQ(force(scene, {49, -69, 79}, {100, 100, 100}), Vec3{});
  EXPECT_EQ(force(scene, {200, 0, 0}, {100, 100, 100}), Vec3{});
}

TEST(Section3_1, BoxIsWhatTheReportMeasured) {
  WorkspaceOptions options;
  options.wall_stiffness_n_per_m = 1000.0;
  const WorkspaceScene scene(options);
  EXPECT_EQ(force(scene, {-50, -70, -70}), Vec3{});
  EXPECT_EQ(force(scene, {50, 80, 80}), Vec3{});
  expect_near(force(scene, {-50.001, 0, 0}), {0.001, 0, 0}, 1e-9);
  expect_near(force(scene, {0, -70.001, 0}), {0, 0.001, 0}, 1e-9);
  expect_near(force(scene, {0, 0, 80.001}), {0, 0, -0.001}, 1e-9);
}

TEST(Section3_1, SoftWallPushesBackToTheBox) {
  WorkspaceOptions options;
  options.wall_stiffness_n_per_m = 200.0;
  options.wall_damping_n_s_per_m = 1.0;
  const WorkspaceScene scene(options);
  EXPECT_EQ(force(scene, {50, -70, 80}, {100, 100, 100}), Vec3{});
  expect_near(force(scene, {60, 0, 0}), {-2, 0, 0}, 1e-12);
  expect_near(force(scene, {53, -74, 0}), {-0.6, 0.8, 0}, 1e-12);
  expect_near(force(scene, {60, 0, 0}, {100, 300, 0}), {-2.1, 0, 0}, 1e-12);
  EXPECT_EQ(force(scene, {60, 0, 0}, {-5000, 0, 0}), Vec3{});
  expect_stiffness_is_the_slope(scene, {0, 0, -75}, {0, 0, 1}, 1e-6);
}

TEST(Section3_1, IsFiniteForAnyFinitePlace) {
  WorkspaceOptions options;
  options.wall_stiffness_n_per_m = 200.0;
  options.wall_damping_n_s_per_m = 1.0;
  WorkspaceScene scene(options);
  expect_finite_everywhere(scene);
}

}  // namespace
}  // namespace argil::haptics
