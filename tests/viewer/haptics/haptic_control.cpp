// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptics/haptic_control.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/haptics/scene/scene_catalogue.h"

#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

TEST_F(GesturesTest, TheRedStopOfAMouseAloneStopsNothing) {
  HapticControl control(ui_, document_);
  ui_.wants_emergency_stop = true;
  EXPECT_TRUE(control.tick(0.0, {}, false).ok());
  EXPECT_FALSE(ui_.wants_emergency_stop);
  EXPECT_FALSE(ui_.is_force_stopped);
  ui_.clay.has_clay = false;  // the device waits for some
  ui_.haptics.device = DeviceChoice::sim;
  EXPECT_TRUE(control.tick(1.0, {}, false).ok());
  EXPECT_FALSE(ui_.is_force_stopped) << "what was pressed before there was a device";
  ui_.wants_emergency_stop = true;
  EXPECT_TRUE(control.tick(2.0, {}, false).ok());
  EXPECT_TRUE(ui_.is_force_stopped);
  ui_.haptics.device = DeviceChoice::mouse;
  EXPECT_TRUE(control.tick(3.0, {}, false).ok());
  EXPECT_FALSE(ui_.is_force_stopped);
  ui_.haptics.device = DeviceChoice::sim;
  EXPECT_TRUE(control.tick(4.0, {}, false).ok());
  EXPECT_TRUE(ui_.is_force_stopped) << "until it is wanted again";
}

TEST_F(GesturesTest, NoMaterialThatCanBeChosenIsRefused) {
  ui_.clay.bounds_mm = {{-25.0, -25.0, -25.0}, {25.0, 25.0, 25.0}};
  HapticControl control(ui_, document_);
  ui_.haptics.device = DeviceChoice::sim;
  double now_s = 0.0;
  // Every choice between the ends of its range.
  for (unsigned ends = 0; ends < 16; ++ends) {
    const auto is_high = [&](unsigned choice) { return ((ends >> choice) & 1U) != 0; };
    haptics::ForceMaterial& material = ui_.haptics.material;
    ui_.haptics.is_direct = is_high(0);
    material.exponent = is_high(1) ? 8.0 : 1.0;
    material.skin_mm = is_high(2) ? 50.0 : 0.5;
    material.clamp_ratio = is_high(3) ? 20.0 : 1.01;
    material.viscosity_s_per_mm = is_high(3) ? 1.0 : 0.0;
    material.surface_force_n = control.most_surface_force_n();
    EXPECT_GT(material.surface_force_n, 0.0);
    const auto started = control.tick(now_s += 1.0, {}, false);
    EXPECT_TRUE(started.ok()) << (started ? "" : started.error().message);
  }
  ui_.haptics.device = DeviceChoice::mouse;
  EXPECT_TRUE(control.tick(now_s += 1.0, {}, false).ok());
  while (!document_.is_idle()) {
    std::vector<double> inputs;
    document_.take_blocks(inputs);
  }
}

TEST_F(GesturesTest, WeightsRampAndFilterOfThePanelAreTheRigs) {
  ui_.clay.bounds_mm = {{-25.0, -25.0, -25.0}, {25.0, 25.0, 25.0}};
  HapticControl control(ui_, document_);
  ui_.haptics.device = DeviceChoice::sim;
  ASSERT_TRUE(control.tick(1.0, {}, false).ok());
  EXPECT_FALSE(control.rig().options().position_filter);
  ui_.haptics.is_filtered = true;
  ui_.haptics.filter = {0.4, 0.7};
  ASSERT_TRUE(control.tick(2.0, {}, false).ok());
  ASSERT_TRUE(control.rig().options().position_filter);
  EXPECT_EQ(*control.rig().options().position_filter, ui_.haptics.filter);
  ui_.haptics.mix = {0.8, 0.1, 0.2, 1.4};
  ui_.haptics.mix_ramp_s = 0.5;
  ASSERT_TRUE(control.tick(3.0, {}, false).ok());
  EXPECT_EQ(control.rig().options().mix, ui_.haptics.mix);
  EXPECT_EQ(control.rig().options().mix_ramp_s, 0.5);
  // A direct coupling has less of the surface force where the filter is late or the weight large.
  ui_.haptics.is_direct = true;
  const double filtered_n = control.most_surface_force_n();
  ui_.haptics.is_filtered = false;
  EXPECT_GT(control.most_surface_force_n(), filtered_n + 1.0);
  // Its recording says what was felt.
  ui_.folder = folder_.path();
  ui_.haptics.is_direct = false;
  ui_.haptics.is_filtered = true;
  ASSERT_TRUE(control.tick(4.0, {}, false).ok());
  ASSERT_TRUE(control.toggle_recording().ok());
  const auto file = control.toggle_recording();
  ASSERT_TRUE(file.ok());
  const auto recording = haptics::read_recording(file.value());
  ASSERT_TRUE(recording.ok());
  for (const char* part : {"mix-passive=0.8,0.1", "mix-active=0.2,1.4", "mix-ramp=0.5",
                           "filter=0.4", "filter-lambda=0.7"}) {
    EXPECT_NE(recording.value().note.find(part), std::string::npos) << recording.value().note;
  }
  ui_.haptics.device = DeviceChoice::mouse;
  EXPECT_TRUE(control.tick(5.0, {}, false).ok());
  while (!document_.is_idle()) {
    std::vector<double> inputs;
    document_.take_blocks(inputs);
  }
}

TEST_F(GesturesTest, AdaptiveDampingOfThePanelIsTheRigs) {
  ui_.clay.bounds_mm = {{-25.0, -25.0, -25.0}, {25.0, 25.0, 25.0}};
  HapticControl control(ui_, document_);
  ui_.haptics.device = DeviceChoice::sim;
  ASSERT_TRUE(control.tick(1.0, {}, false).ok());
  EXPECT_EQ(control.rig().options().damping, haptics::DampingKind::fixed);
  ui_.haptics.damping = haptics::DampingKind::adaptive;
  ASSERT_TRUE(control.tick(2.0, {}, false).ok()) << "it is a change, for which it starts again";
  EXPECT_EQ(control.rig().options().damping, haptics::DampingKind::adaptive);
  ui_.haptics.device = DeviceChoice::mouse;
  EXPECT_TRUE(control.tick(3.0, {}, false).ok());
  while (!document_.is_idle()) {
    std::vector<double> inputs;
    document_.take_blocks(inputs);
  }
}

TEST_F(GesturesTest, EverySceneOfTheReportCanBeFelt) {
  ui_.clay.bounds_mm = {{-25.0, -25.0, -25.0}, {25.0, 25.0, 25.0}};
  HapticControl control(ui_, document_);
  ui_.haptics.device = DeviceChoice::sim;
  double now_s = 0.0;
  for (const haptics::SceneEntry& scene : haptics::scene_catalogue()) {
    ui_.haptics.scene = scene.name;
    const auto started = control.tick(now_s += 1.0, {}, false);
    EXPECT_TRUE(started.ok()) << scene.name << ": " << (started ? "" : started.error().message);
    EXPECT_TRUE(control.is_running()) << scene.name;
  }
  // A scale between 0, which fits, and the least is the least.
  ui_.haptics.scene = "clay";
  ui_.haptics.scale = 0.01;
  EXPECT_TRUE(control.tick(now_s += 1.0, {}, false).ok());
  ui_.haptics.device = DeviceChoice::mouse;
  EXPECT_TRUE(control.tick(now_s += 1.0, {}, false).ok());
  while (!document_.is_idle()) {
    std::vector<double> inputs;
    document_.take_blocks(inputs);
  }
}

}  // namespace
}  // namespace argil::viewer
