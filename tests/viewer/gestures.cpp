// SPDX-License-Identifier: GPL-3.0-or-later
#include "gestures.h"

#include <chrono>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "argil/haptics/scene_catalogue.h"

#include "deed.h"
#include "haptic_desk.h"
#include "support/scratch.h"

namespace argil::viewer {
namespace {

/// Gestures before a wall that fills the picture.
class GesturesTest : public testing::Test {
 protected:
  GesturesTest() {
    ui_.camera.resize(64, 64);
    ui_.clay.has_clay = true;
  }

  SurfaceProbe wall() const {
    DepthMap depth;
    depth.width = depth.height = 64;
    depth.depth_mm.assign(64 * 64, static_cast<float>(ui_.camera.distance_mm()));
    return {depth, ui_.camera};
  }

  void mouse(InputEvent::Kind kind, MouseButton button = MouseButton::left) {
    InputEvent event;
    event.kind = kind;
    event.button = button;
    event.x = event.y = 32.0;
    gestures_.on(event, false);
  }

  void key(int number, bool is_repeat = false, const Modifiers& modifiers = {}) {
    InputEvent event;
    event.kind = InputEvent::Kind::key_down;
    event.key = number;
    event.is_repeat = is_repeat;
    event.modifiers = modifiers;
    gestures_.on(event, false);
  }

  test::ScratchFolder folder_;
  UiState ui_;
  Workshop shop_{WorkshopOptions{folder_.path()}};
  Gestures gestures_{ui_, shop_, [this] { return wall(); }};
};

TEST_F(GesturesTest, TheRedStopIsHeardDuringAStrokeAndWithAnyKeyHeld) {
  mouse(InputEvent::Kind::press);
  ASSERT_TRUE(gestures_.is_stroke_open());
  key(kKeySpace);
  EXPECT_TRUE(std::exchange(ui_.wants_red_stop, false));
  EXPECT_TRUE(gestures_.is_stroke_open());
  mouse(InputEvent::Kind::release);
  key(kKeySpace, false, {true, true, false});
  EXPECT_TRUE(std::exchange(ui_.wants_red_stop, false));
}

TEST_F(GesturesTest, TheRedStopOnlyStopsAndGoingOnIsAskedForByItself) {
  key(kKeySpace);
  EXPECT_TRUE(std::exchange(ui_.wants_red_stop, false));
  ui_.is_force_stopped = true;
  key(kKeySpace);
  EXPECT_TRUE(std::exchange(ui_.wants_red_stop, false));
  EXPECT_FALSE(ui_.wants_force);
  perform(Deed::give_force, ui_, shop_);
  EXPECT_TRUE(std::exchange(ui_.wants_force, false));
  ui_.is_force_stopped = false;
  perform(Deed::give_force, ui_, shop_);  // there is nothing to give again
  EXPECT_FALSE(ui_.wants_force);
}

TEST_F(GesturesTest, TheRedStopOfAMouseAloneStopsNothing) {
  HapticDesk desk(ui_, shop_);
  ui_.wants_red_stop = true;
  EXPECT_TRUE(desk.tick(0.0, {}, false).ok());
  EXPECT_FALSE(ui_.wants_red_stop);
  EXPECT_FALSE(ui_.is_force_stopped);
  ui_.clay.has_clay = false;  // the device waits for some
  ui_.haptics.device = DeviceChoice::sim;
  EXPECT_TRUE(desk.tick(1.0, {}, false).ok());
  EXPECT_FALSE(ui_.is_force_stopped) << "what was pressed before there was a device";
  ui_.wants_red_stop = true;
  EXPECT_TRUE(desk.tick(2.0, {}, false).ok());
  EXPECT_TRUE(ui_.is_force_stopped);
  ui_.haptics.device = DeviceChoice::mouse;
  EXPECT_TRUE(desk.tick(3.0, {}, false).ok());
  EXPECT_FALSE(ui_.is_force_stopped);
  ui_.haptics.device = DeviceChoice::sim;
  EXPECT_TRUE(desk.tick(4.0, {}, false).ok());
  EXPECT_TRUE(ui_.is_force_stopped) << "until it is wanted again";
}

TEST_F(GesturesTest, BehindADialogNothingReactsButTheRedStop) {
  ui_.panels.is_operations_open = true;
  ui_.camera.resize(64, 64);
  const double distance = ui_.camera.distance_mm();
  key('X');
  key('C');
  mouse(InputEvent::Kind::press);
  mouse(InputEvent::Kind::scroll);
  EXPECT_FALSE(ui_.brush.mirror.x);
  EXPECT_EQ(ui_.brush.action, Brush().action);
  EXPECT_FALSE(gestures_.is_stroke_open());
  EXPECT_EQ(ui_.camera.distance_mm(), distance);
  key(kKeySpace);
  EXPECT_TRUE(std::exchange(ui_.wants_red_stop, false));
  // A space in a file's name is none, unless there is a force to be stopped.
  InputEvent space;
  space.kind = InputEvent::Kind::key_down;
  space.key = kKeySpace;
  gestures_.on(space, true);
  EXPECT_FALSE(ui_.wants_red_stop);
  ui_.haptics.device = DeviceChoice::sim;
  gestures_.on(space, true);
  EXPECT_TRUE(ui_.wants_red_stop);
  ui_.haptics.device = DeviceChoice::mouse;
  // Also from a field that somebody types into.
  InputEvent escape;
  escape.kind = InputEvent::Kind::key_down;
  escape.key = kKeyEscape;
  gestures_.on(escape, true);
  EXPECT_EQ(open_dialog(ui_), Dialog::none);
  key('X');
  EXPECT_TRUE(ui_.brush.mirror.x);
}

TEST_F(GesturesTest, InStereoAPressSaysWhyNothingHappens) {
  ui_.show.is_stereo = true;
  mouse(InputEvent::Kind::press);
  EXPECT_FALSE(gestures_.is_stroke_open());
  ASSERT_EQ(ui_.notices.size(), 1U);
  EXPECT_NE(ui_.notices[0].text.find("Shift+Z"), std::string::npos);
  mouse(InputEvent::Kind::release);
  mouse(InputEvent::Kind::press, MouseButton::right);
  EXPECT_EQ(ui_.notices.size(), 1U) << "who turns it means that";
}

TEST_F(GesturesTest, EscapeEndsATurntableAndNothingElse) {
  perform(Deed::turntable, ui_, shop_);
  ASSERT_EQ(ui_.turntable_left, kTurntableFrames);
  ui_.panels.has_help = true;
  key(kKeyEscape);
  EXPECT_EQ(ui_.turntable_left, 0);
  EXPECT_TRUE(ui_.panels.has_help);
}

TEST_F(GesturesTest, RedoIsOfferedWhereSomethingWasTakenBack) {
  EXPECT_FALSE(is_possible(Deed::redo, ui_));
  ui_.clay.steps = std::make_shared<const StepNames>(StepNames{{"Draw, 5 mm"}, 1});
  EXPECT_FALSE(is_possible(Deed::redo, ui_));
  ui_.clay.steps = std::make_shared<const StepNames>(StepNames{{"Draw, 5 mm"}, 0});
  EXPECT_TRUE(is_possible(Deed::redo, ui_));
}

TEST_F(GesturesTest, OnlyAFolderIsRemembered) {
  ui_.folder = folder_.path();
  open_file(folder_ / "gone" / "p.vdb", ui_, shop_);
  EXPECT_EQ(ui_.folder, folder_.path());
  std::filesystem::create_directories(folder_ / "there");
  open_file(folder_ / "there" / "p.vdb", ui_, shop_);
  EXPECT_EQ(ui_.folder, folder_ / "there");
}

TEST_F(GesturesTest, WhoLeavesWithoutSavingDoesNotWaitForTheWork) {
  const auto settle = [&] {
    while (!shop_.is_idle()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // the work has the processors
      std::vector<double> inputs;
      shop_.take_blocks(inputs);
    }
  };
  shop_.send(NewClay{{io::StartShape::Kind::ball, {25.0, 0.0, 0.0}, {}}});
  shop_.send(DoStep{Resample{0.1}});
  settle();
  shop_.send(ExportMesh{folder_ / "m.3mf", {}});
  while (!shop_.task().is_running) std::this_thread::yield();
  ui_.after_saving = AfterSaving::quit;
  go_on_after_saving(false, ui_, shop_);
  settle();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "m.3mf"));
  EXPECT_FALSE(shop_.state().has_clay);
}

TEST_F(GesturesTest, OneDialogIsOpenAtATime) {
  EXPECT_EQ(open_dialog(ui_), Dialog::none);
  ui_.panels.is_new_open = true;
  EXPECT_EQ(open_dialog(ui_), Dialog::new_clay);
  ui_.file_wish = FileWish::save_as;
  EXPECT_EQ(open_dialog(ui_), Dialog::file);
  ui_.clay.left.emplace();
  EXPECT_EQ(open_dialog(ui_), Dialog::recover);
}

TEST_F(GesturesTest, AKeyThatIsHeldSwitchesOnce) {
  key(kKeySpace, true);
  EXPECT_FALSE(ui_.wants_red_stop);
  key('X');
  key('X', true);
  EXPECT_TRUE(ui_.brush.mirror.x);
  const double radius = ui_.brush.radius_mm;
  key(kKeyRightBracket);
  key(kKeyRightBracket, true);
  EXPECT_NEAR(ui_.brush.radius_mm, 1.21 * radius, 1e-9);
}

TEST_F(GesturesTest, AnotherButtonNeitherEndsAStrokeNorBeginsASecondDrag) {
  mouse(InputEvent::Kind::press);
  mouse(InputEvent::Kind::press, MouseButton::right);
  mouse(InputEvent::Kind::release, MouseButton::right);
  EXPECT_TRUE(gestures_.is_stroke_open());
  mouse(InputEvent::Kind::release);
  EXPECT_FALSE(gestures_.is_stroke_open());
  mouse(InputEvent::Kind::release);
  EXPECT_FALSE(gestures_.is_stroke_open());
}

TEST_F(GesturesTest, AWindowWithoutSizeHasNothingToWorkOn) {
  DepthMap depth;
  depth.width = depth.height = 1;
  depth.depth_mm = {10.0F};
  EXPECT_FALSE((SurfaceProbe{depth, ui_.camera}.at({0.0, 0.0}, 1.0)));
  EXPECT_FALSE((SurfaceProbe{DepthMap{}, ui_.camera}.at({0.0, 0.0}, 1.0)));
}

TEST_F(GesturesTest, WhatIsOnItsWayIsAskedAboutAndSaved) {
  EXPECT_TRUE(is_possible(Deed::save, ui_));
  ui_.task.is_running = true;
  leave_clay(AfterSaving::quit, ui_, shop_);
  EXPECT_TRUE(ui_.asks_to_save);
  EXPECT_FALSE(ui_.wants_to_quit);
  go_on_after_saving(false, ui_, shop_);
  EXPECT_FALSE(ui_.asks_to_save);
  EXPECT_TRUE(ui_.wants_to_quit);
}

TEST_F(GesturesTest, NoMaterialThatCanBeChosenIsRefused) {
  ui_.clay.bounds_mm = {{-25.0, -25.0, -25.0}, {25.0, 25.0, 25.0}};
  HapticDesk desk(ui_, shop_);
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
    material.surface_force_n = desk.most_surface_force_n();
    EXPECT_GT(material.surface_force_n, 0.0);
    const auto started = desk.tick(now_s += 1.0, {}, false);
    EXPECT_TRUE(started.ok()) << (started ? "" : started.error().message);
  }
  ui_.haptics.device = DeviceChoice::mouse;
  EXPECT_TRUE(desk.tick(now_s += 1.0, {}, false).ok());
  while (!shop_.is_idle()) {
    std::vector<double> inputs;
    shop_.take_blocks(inputs);
  }
}

TEST_F(GesturesTest, TheNumberRowIsTheNumpadWhereItWasChosen) {
  ui_.camera.look_from({1.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  key('1');
  EXPECT_NEAR(ui_.camera.lens({}).back.x, 1.0, 1e-9);
  ui_.settings.has_number_views = true;
  key('1');
  EXPECT_NEAR(ui_.camera.lens({}).back.y, -1.0, 1e-9);
  key('1', false, {false, true, false});
  EXPECT_NEAR(ui_.camera.lens({}).back.y, 1.0, 1e-9);
}

TEST_F(GesturesTest, EverySceneOfTheReportCanBeFelt) {
  ui_.clay.bounds_mm = {{-25.0, -25.0, -25.0}, {25.0, 25.0, 25.0}};
  HapticDesk desk(ui_, shop_);
  ui_.haptics.device = DeviceChoice::sim;
  double now_s = 0.0;
  for (const haptics::SceneEntry& scene : haptics::scene_catalogue()) {
    ui_.haptics.scene = scene.name;
    const auto started = desk.tick(now_s += 1.0, {}, false);
    EXPECT_TRUE(started.ok()) << scene.name << ": " << (started ? "" : started.error().message);
    EXPECT_TRUE(desk.is_running()) << scene.name;
  }
  // A scale between 0, which fits, and the least is the least.
  ui_.haptics.scene = "clay";
  ui_.haptics.scale = 0.01;
  EXPECT_TRUE(desk.tick(now_s += 1.0, {}, false).ok());
  ui_.haptics.device = DeviceChoice::mouse;
  EXPECT_TRUE(desk.tick(now_s += 1.0, {}, false).ok());
  while (!shop_.is_idle()) {
    std::vector<double> inputs;
    shop_.take_blocks(inputs);
  }
}

InputEvent pushed(const Vec3& shift, const Vec3& turn) {
  InputEvent event;
  event.kind = InputEvent::Kind::puck;
  event.puck_shift = shift;
  event.puck_turn = turn;
  event.puck_s = 0.1;
  return event;
}

TEST_F(GesturesTest, ThePieceFollowsThePuckOfA3DMouse) {
  const Vec3 front = ui_.camera.target_mm() + Vec3{0.0, -10.0, 0.0};  // towards the camera
  const auto moved = [&](const Vec3& shift, const Vec3& turn) {
    UiState ui;
    ui.camera = ui_.camera;
    Gestures gestures{ui, shop_, [this] { return wall(); }};
    gestures.on(pushed(shift, turn), false);
    return ui.camera.seen_at(front) - ui_.camera.seen_at(front);
  };
  EXPECT_GT(moved({1.0, 0.0, 0.0}, {}).x, 1.0);
  EXPECT_LT(moved({0.0, 1.0, 0.0}, {}).y, -1.0) << "pixels go down";
  EXPECT_GT(moved({0.0, 0.0, 1.0}, {}).z, 1.0) << "pushed away";
  EXPECT_GT(moved({}, {0.0, 1.0, 0.0}).x, 0.1) << "its front goes to the right";
  EXPECT_GT(moved({}, {1.0, 0.0, 0.0}).y, 0.1) << "its front goes down";
}

TEST_F(GesturesTest, AStrokeStaysInThePictureThatItBeganIn) {
  mouse(InputEvent::Kind::press);
  ASSERT_TRUE(gestures_.is_stroke_open());
  const Vec3 before = ui_.camera.seen_at({});
  gestures_.on(pushed({1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}), false);
  EXPECT_EQ(ui_.camera.seen_at({}), before);
}

}  // namespace
}  // namespace argil::viewer
