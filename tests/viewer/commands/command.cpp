// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/command.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "viewer/support/gestures_test.h"

namespace argil::viewer {
namespace {

TEST_F(GesturesTest, ResamplingBeginsWithTheVoxelThatTheClayHas) {
  ui_.clay.voxel_mm = 0.07;
  perform(Command::operations, ui_, document_);
  EXPECT_EQ(ui_.operation.voxel_mm, 0.07);
}

TEST_F(GesturesTest, RedoIsOfferedWhereSomethingWasTakenBack) {
  EXPECT_FALSE(is_possible(Command::redo, ui_));
  ui_.clay.steps = std::make_shared<const StepNames>(StepNames{{"Draw, 5 mm"}, 1});
  EXPECT_FALSE(is_possible(Command::redo, ui_));
  ui_.clay.steps = std::make_shared<const StepNames>(StepNames{{"Draw, 5 mm"}, 0});
  EXPECT_TRUE(is_possible(Command::redo, ui_));
}

TEST_F(GesturesTest, OnlyAFolderIsRemembered) {
  ui_.folder = folder_.path();
  open_file(folder_ / "gone" / "p.vdb", ui_, document_);
  EXPECT_EQ(ui_.folder, folder_.path());
  std::filesystem::create_directories(folder_ / "there");
  open_file(folder_ / "there" / "p.vdb", ui_, document_);
  EXPECT_EQ(ui_.folder, folder_ / "there");
}

TEST_F(GesturesTest, WhoLeavesWithoutSavingDoesNotWaitForTheWork) {
  const auto settle = [&] {
    while (!document_.is_idle()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // the work has the processors
      std::vector<double> inputs;
      document_.take_blocks(inputs);
    }
  };
  document_.send(NewClay{{io::StartShape::Kind::ball, {25.0, 0.0, 0.0}, {}}});
  document_.send(DoStep{Resample{0.1}});
  settle();
  document_.send(ExportMesh{folder_ / "m.3mf", {}});
  while (!document_.task().is_running) std::this_thread::yield();
  ui_.after_saving = AfterSaving::quit;
  go_on_after_saving(false, ui_, document_);
  settle();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "m.3mf"));
  EXPECT_FALSE(document_.state().has_clay);
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

TEST_F(GesturesTest, WhatIsOnItsWayIsAskedAboutAndSaved) {
  EXPECT_TRUE(is_possible(Command::save, ui_));
  ui_.task.is_running = true;
  leave_clay(AfterSaving::quit, ui_, document_);
  EXPECT_TRUE(ui_.asks_to_save);
  EXPECT_FALSE(ui_.wants_to_quit);
  go_on_after_saving(false, ui_, document_);
  EXPECT_FALSE(ui_.asks_to_save);
  EXPECT_TRUE(ui_.wants_to_quit);
}

}  // namespace
}  // namespace argil::viewer
