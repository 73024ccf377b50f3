// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/document_thread.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "argil/io/project_file.h"
#include "argil/io/session.h"

#include "document/document_worker.h"
#include "support/bumpy_clay.h"
#include "viewer/document/document_fixture.h"

namespace argil::viewer {
namespace {

using std::chrono::milliseconds;

TEST_F(DocumentThreadTest, SendsTheBlocksOfANewClayAndThenOnlyThoseThatAStrokeChanged) {
  thread_.send(NewClay{ball(60.0)});
  const BlockNews first = settle();
  EXPECT_TRUE(first.is_fresh);
  ASSERT_GT(first.changed.size(), 200U);
  stroke({59.0, -3.0, 0.0}, {59.0, 3.0, 0.0});
  const BlockNews news = settle();
  EXPECT_FALSE(news.is_fresh);
  ASSERT_FALSE(news.changed.empty());
  EXPECT_LT(news.changed.size(), first.changed.size() / 3);
  // All near the stroke: within what the coarsest leaves that it touches span.
  for (const auto& [id, block] : news.changed) EXPECT_GT(block.bounds_mm.max.x, 20.0);
  EXPECT_TRUE(errors().empty());
}

TEST_F(DocumentThreadTest, BlocksThatWereFollowedAreThoseOfTheClay) {
  thread_.send(NewClay{ball(20.0)});
  std::map<BlockId, BlockMesh> held;
  const auto follow = [&](BlockNews&& news) {
    if (news.is_fresh) held.clear();
    for (const BlockId& id : news.gone) held.erase(id);
    for (auto& [id, block] : news.changed) held.insert_or_assign(id, std::move(block));
  };
  follow(settle());
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  follow(settle());
  stroke({0.0, 19.0, 0.0}, {5.0, 18.0, 3.0});
  follow(settle());
  thread_.send(DoStep{io::HistoryStep::undo});
  follow(settle());
  stroke({0.0, 0.0, 20.0}, {5.0, 0.0, 18.0});
  thread_.send(SaveProjectAs{folder_ / "p.vdb"});
  follow(settle());

  DisplaySurface surface;
  ASSERT_TRUE(surface.update(io::load_project(folder_ / "p.vdb").value()));
  const std::vector<BlockId> wanted = surface.blocks();
  ASSERT_EQ(held.size(), wanted.size());
  for (const BlockId& id : wanted) {
    ASSERT_TRUE(held.contains(id));
    const DisplayBlock block = surface.block(id);
    EXPECT_TRUE(std::equal(block.vertices.begin(), block.vertices.end(),
                           held.at(id).vertices.begin(), held.at(id).vertices.end()));
    EXPECT_TRUE(std::equal(block.triangles.begin(), block.triangles.end(),
                           held.at(id).triangles.begin(), held.at(id).triangles.end()));
  }
}

/// Without the thread, which goes on by itself.
TEST(DocumentWorker, ShowsALargeClayByItsCoarseLevelsAtOnceAndThenAsItIs) {
  const test::ScratchFolder folder;
  const Clay clay = test::bumpy_ball(30.0, 0.25).value();
  ASSERT_TRUE(io::save_project(folder / "p.vdb", clay));
  Outbox outbox;
  DocumentWorker worker(outbox, folder.path());
  std::vector<double> inputs;
  worker.perform(OpenFile{folder / "p.vdb"});
  worker.show();
  const BlockNews coarse = only_piece(outbox.take_blocks(inputs));
  ASSERT_TRUE(coarse.is_fresh);
  EXPECT_TRUE(outbox.state().has_clay);
  EXPECT_TRUE(worker.has_backlog());
  EXPECT_TRUE(worker.work_backlog());
  worker.show();
  EXPECT_FALSE(worker.has_backlog());
  std::map<BlockId, BlockMesh> held = coarse.changed;
  BlockNews news = only_piece(outbox.take_blocks(inputs));
  EXPECT_FALSE(news.is_fresh);
  for (const BlockId& id : news.gone) held.erase(id);
  for (auto& [id, block] : news.changed) held.insert_or_assign(id, std::move(block));

  DisplaySurface surface;
  ASSERT_TRUE(surface.update(clay));
  const std::vector<BlockId> wanted = surface.blocks();
  ASSERT_EQ(held.size(), wanted.size());
  EXPECT_LT(4 * coarse.changed.size(), wanted.size());
  Box3 drawn;
  for (const auto& [id, block] : coarse.changed) {
    drawn.include(block.bounds_mm.min);
    drawn.include(block.bounds_mm.max);
  }
  EXPECT_GT(drawn.size().x, 59.0) << "all of the clay, coarsely";
  for (const BlockId& id : wanted) {
    const DisplayBlock block = surface.block(id);
    ASSERT_TRUE(held.contains(id));
    ASSERT_TRUE(std::equal(block.vertices.begin(), block.vertices.end(),
                           held.at(id).vertices.begin(), held.at(id).vertices.end()));
  }
}

TEST_F(DocumentThreadTest, AStrokeInPiecesIsTheStrokeOfTheScript) {
  thread_.send(NewClay{ball(20.0)});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  thread_.send(SaveProjectAs{folder_ / "p.vdb"});
  settle();
  Stroke whole;
  whole.tool = small_tool();
  const Vec3 from{19.0, -3.0, 0.0};
  const Vec3 to{19.0, 3.0, 0.0};
  for (int n = 0; n <= 10; ++n) {
    whole.samples.push_back(at(0.01 * n, from + (0.1 * n) * (to - from)));
  }
  Clay clay = Clay::ball(20.0, {}).value();
  ASSERT_TRUE(clay.apply(whole).ok());
  EXPECT_EQ(io::load_project(folder_ / "p.vdb").value().hash(), clay.hash());
}

TEST_F(DocumentThreadTest, ALargeToolIsPreviewedAndEndsAsItsStroke) {
  thread_.send(NewClay{ball(40.0)});
  std::map<BlockId, BlockMesh> held;
  bool was_previewed = false;
  const auto follow = [&](BlockNews&& news) {
    if (news.is_fresh) held.clear();
    for (const BlockId& id : news.gone) held.erase(id);
    for (auto& [id, block] : news.changed) held.insert_or_assign(id, std::move(block));
  };
  follow(settle());
  Tool large = small_tool();
  large.radii_mm = {26.0, 26.0, 26.0};
  Stroke whole;
  whole.tool = large;
  thread_.send(BeginStroke{large, {}});
  for (int n = 0; n <= 10; ++n) {
    const StrokeSample sample = at(0.01 * n, {36.0, -20.0 + 4.0 * n, 0.0});
    whole.samples.push_back(sample);
    thread_.send(ExtendStroke{{sample}, 0.0});
    std::vector<double> inputs;
    follow(only_piece(thread_.take_blocks(inputs)));
  }
  // Shown before the clay is there.
  for (int n = 0; n < 2000 && !was_previewed; ++n) {
    std::vector<double> inputs;
    BlockNews news = only_piece(thread_.take_blocks(inputs));
    for (const auto& [id, block] : news.changed) {
      was_previewed = was_previewed || block.bounds_mm.max.x > 48.0;
    }
    follow(std::move(news));
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_TRUE(was_previewed);
  // Held still, it lets the thread sleep once the clay has followed.
  follow(settle());
  EXPECT_TRUE(thread_.state().is_stroke_open);
  EXPECT_EQ(thread_.state().strokes, 0);
  thread_.send(EndStroke{});
  follow(settle());
  EXPECT_EQ(thread_.state().strokes, 1);
  thread_.send(SaveProjectAs{folder_ / "p.vdb"});
  follow(settle());

  Clay clay = Clay::ball(40.0, {}).value();
  ASSERT_TRUE(clay.apply(whole).ok());
  const Clay saved = io::load_project(folder_ / "p.vdb").value();
  EXPECT_EQ(saved.hash(), clay.hash());
  DisplaySurface surface;
  ASSERT_TRUE(surface.update(saved));
  std::size_t triangles = 0;
  for (const auto& [id, block] : held) triangles += block.triangles.size();
  EXPECT_EQ(static_cast<std::int64_t>(triangles), surface.stats().triangles);
  EXPECT_EQ(held.size(), surface.blocks().size());
}

TEST_F(DocumentThreadTest, APaintedMaskIsSentWithItsBlocks) {
  thread_.send(NewClay{ball(20.0)});
  settle();
  Tool mask = small_tool();
  mask.action = Action::mask;
  stroke({20.0, -3.0, 0.0}, {20.0, 3.0, 0.0}, mask);
  const BlockNews news = settle();
  int masked = 0;
  for (const auto& [id, block] : news.changed) {
    ASSERT_EQ(block.mask.size(), block.vertices.size());
    for (std::size_t n = 0; n < block.mask.size(); ++n) {
      if (block.mask[n] < 200) continue;
      ++masked;
      EXPECT_GT(block.vertices[n].position_mm[0], 17.0F);
    }
  }
  EXPECT_GT(masked, 20);
  EXPECT_TRUE(thread_.state().has_mask);
  thread_.send(DoStep{MaskEdit::clear});
  for (const auto& [id, block] : settle().changed) EXPECT_TRUE(block.mask.empty());
}

TEST_F(DocumentThreadTest, APathThatIsNotOnTheClayIsWarnedOf) {
  thread_.send(NewClay{ball(20.0)});
  thread_.send(CheckPath{{{20.0, 0.0, 0.0}, {0.0, 20.5, 0.0}}});
  settle();
  EXPECT_TRUE(thread_.take_notices().empty());
  thread_.send(CheckPath{{{20.0, 0.0, 0.0}, {0.0, 30.0, 0.0}}});
  settle();
  const std::vector<Notice> notices = thread_.take_notices();
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_EQ(notices[0].kind, Notice::Kind::warning);
  EXPECT_NE(notices[0].text.find("point 2 of the path, (0, 30, 0) mm"), std::string::npos)
      << notices[0].text;
}

TEST_F(DocumentThreadTest, AStrokeThatCrossedTheAirIsTakenBackWithAllItsParts) {
  thread_.send(NewClay{ball(20.0)});
  stroke({0.0, 19.0, -3.0}, {0.0, 19.0, 3.0});
  settle();
  thread_.send(SaveProjectAs{folder_ / "before.vdb"});
  const auto part = [&](double y, bool goes_on) {
    thread_.send(BeginStroke{small_tool(), {}, false, goes_on});
    thread_.send(ExtendStroke{{at(0.0, {19.0, y, 0.0})}, 0.0});
  };
  part(-4.0, false);
  thread_.send(EndStroke{});
  part(0.0, true);
  thread_.send(EndStroke{});
  part(4.0, true);
  thread_.send(CancelStroke{});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_EQ(thread_.state().undo_depth, 1);
  thread_.send(SaveProjectAs{folder_ / "after.vdb"});
  settle();
  EXPECT_EQ(io::load_project(folder_ / "after.vdb").value().hash(),
            io::load_project(folder_ / "before.vdb").value().hash());
}

TEST_F(DocumentThreadTest, AStampIsCalledSoAndNothingToRedoIsSaidInWords) {
  thread_.send(NewClay{ball(20.0)});
  thread_.send(BeginStroke{small_tool(), {}, true});
  thread_.send(ExtendStroke{{at(0.0, {19.0, 0.0, 0.0})}, 0.0});
  thread_.send(EndStroke{});
  stroke({0.0, 19.0, -3.0}, {0.0, 19.0, 3.0});
  thread_.send(DoStep{io::HistoryStep::redo});
  settle();
  EXPECT_EQ(thread_.state().steps->names, (std::vector<std::string>{"Stamp, 2 mm", "Add, 2 mm"}));
  const std::vector<Notice> told = thread_.take_notices();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].text, "there is nothing to redo");
}

TEST_F(DocumentThreadTest, AnEndingMayBeOfCapitals) {
  ASSERT_TRUE(io::save_project(folder_ / "OWL.VDB", Clay::ball(20.0, {}).value()).ok());
  thread_.send(OpenFile{folder_ / "OWL.VDB"});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_EQ(thread_.state().file, folder_ / "OWL.VDB");
  EXPECT_FALSE(thread_.state().is_untitled);
}

TEST_F(DocumentThreadTest, WithoutSavingAProjectIsWhatItWas) {
  thread_.send(NewClay{ball(20.0)});
  thread_.send(SaveProjectAs{folder_ / "p.vdb"});
  settle();
  const std::uint64_t hash = io::load_project(folder_ / "p.vdb").value().hash();
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  thread_.send(EndProject{false});
  settle();
  EXPECT_FALSE(thread_.state().has_clay);
  EXPECT_EQ(io::open_project(folder_ / "p.vdb").value().sculpture.hash(), hash);
}

TEST_F(DocumentThreadTest, AChangedClayWithoutANameIsNotLeftToBeSaved) {
  thread_.send(NewClay{ball(20.0)});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  settle();
  const int depth = thread_.state().undo_depth;
  thread_.send(NewClay{ball(10.0), true});
  thread_.send(EndProject{true});
  settle();
  EXPECT_EQ(errors().size(), 2U);
  EXPECT_EQ(thread_.state().undo_depth, depth);
}

TEST_F(DocumentThreadTest, WithoutSavingWhatCameAfterASaveIsNotLeftToBeRecovered) {
  thread_.send(NewClay{ball(20.0)});
  thread_.send(SaveProjectAs{folder_ / "p.vdb"});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  thread_.send(SaveProject{});
  settle();
  const std::uint64_t hash = io::load_project(folder_ / "p.vdb").value().hash();
  stroke({-19.0, -3.0, 0.0}, {-19.0, 3.0, 0.0});
  thread_.send(EndProject{false});
  settle();
  EXPECT_EQ(io::open_project(folder_ / "p.vdb").value().sculpture.hash(), hash);
  EXPECT_FALSE(io::left_steps(folder_ / "p.vdb").value());
}

TEST_F(DocumentThreadTest, OpeningWhatIsOpenHereOrInAnotherWindowIsRefusedWithoutAQuestion) {
  thread_.send(NewClay{ball(20.0)});
  thread_.send(SaveProjectAs{folder_ / "p.vdb"});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  thread_.send(OpenFile{folder_ / "p.vdb"});
  settle();
  EXPECT_FALSE(thread_.state().left);
  EXPECT_EQ(thread_.state().undo_depth, 1);
  auto told = errors();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("in this window already"), std::string::npos) << told[0];

  DocumentThread other{DocumentThreadOptions{folder_ / "other"}};
  other.send(OpenFile{folder_ / "p.vdb"});
  while (!other.is_idle()) {
    std::this_thread::sleep_for(milliseconds(2));
    std::vector<double> inputs;
    other.take_blocks(inputs);
  }
  EXPECT_FALSE(other.state().has_clay);
  EXPECT_FALSE(other.state().left);
  EXPECT_EQ(other.take_notices().size(), 1U);
}

TEST_F(DocumentThreadTest, AProjectThatCannotBeSavedIsNotLeftForAnother) {
  thread_.send(NewClay{ball(20.0)});
  thread_.send(SaveProjectAs{folder_ / "p.vdb"});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  settle();
  std::filesystem::remove(folder_ / "p.vdb");
  std::filesystem::create_directories(folder_ / "p.vdb" / "in the way");
  thread_.send(NewClay{ball(10.0), true});
  thread_.send(EndProject{true});
  settle();
  EXPECT_EQ(errors().size(), 2U);
  EXPECT_EQ(thread_.state().file, folder_ / "p.vdb");
  EXPECT_EQ(thread_.state().undo_depth, 1);
  EXPECT_TRUE(left_untitled(folder_.path()).empty());
  // And saved once it can be.
  std::filesystem::remove_all(folder_ / "p.vdb");
  thread_.send(SaveProjectAs{folder_ / "q.vdb"});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_TRUE(io::load_project(folder_ / "q.vdb").ok());
}

TEST_F(DocumentThreadTest, AnUntitledFileThatCannotBeRemovedEndsNoWindow) {
  thread_.send(NewClay{ball(20.0)});
  settle();
  const std::filesystem::path file = thread_.state().file;
  std::filesystem::remove(file);
  std::filesystem::create_directories(file / "in the way");
  thread_.send(EndProject{true});
  settle();
  EXPECT_FALSE(thread_.state().has_clay);
  EXPECT_EQ(errors().size(), 1U);
  thread_.send(NewClay{ball(10.0)});
  settle();
  EXPECT_TRUE(thread_.state().has_clay);
}

TEST_F(DocumentThreadTest, OnlyWhatTheWindowItselfNamedIsThrownAwayUnsaved) {
  const std::filesystem::path unsaved = folder_ / "unsaved";
  std::filesystem::create_directories(unsaved);
  ASSERT_TRUE(io::save_project(unsaved / "mine.vdb", Clay::ball(5.0, {}).value()).ok());
  thread_.send(OpenFile{unsaved / "mine.vdb"});
  settle();
  EXPECT_FALSE(thread_.state().is_untitled);
  thread_.send(EndProject{true});
  thread_.send(NewClay{ball(20.0)});
  settle();
  EXPECT_TRUE(std::filesystem::exists(unsaved / "mine.vdb"));
  // What would be taken for untitled later is not a place to save.
  thread_.send(SaveProjectAs{thread_.state().file});
  thread_.send(SaveProjectAs{unsaved / "Untitled-of-mine.vdb"});
  settle();
  EXPECT_EQ(errors().size(), 2U);
  EXPECT_TRUE(thread_.state().is_untitled);
}

TEST_F(DocumentThreadTest, AnExportDoesNotReplaceTheProjectItself) {
  thread_.send(NewClay{ball(20.0)});
  thread_.send(SaveProjectAs{folder_ / "p.vdb"});
  settle();
  const std::uint64_t hash = io::load_project(folder_ / "p.vdb").value().hash();
  thread_.send(ExportMesh{folder_ / "p.vdb", {}});
  settle();
  EXPECT_EQ(errors().size(), 1U);
  EXPECT_EQ(io::load_project(folder_ / "p.vdb").value().hash(), hash);
}

TEST_F(DocumentThreadTest, AHandThatIsLinkedDoesNotEndTheStrokeOfTheMouse) {
  thread_.send(NewClay{ball(20.0)});
  thread_.send(SaveProjectAs{folder_ / "p.vdb"});
  ToolSampleRing ring(64);
  WindowChannel channel;
  ClayHeartbeat heartbeat;
  thread_.send(LinkHaptics{&ring, &channel, &heartbeat, small_tool(), {}});
  thread_.send(BeginStroke{small_tool(), {}});
  thread_.send(ExtendStroke{{at(0.0, {19.0, -3.0, 0.0})}, 0.0});
  settle();
  ToolSample resting;  // as a device that is not pressed tells it
  resting.index = 1;
  resting.position_mm = {0.0, -60.0, 0.0};
  resting.voxel_mm = 1.0;
  resting.reach_mm = 5.0;
  resting.depth_mm = 5.0;
  ring.push(resting);
  std::this_thread::sleep_for(milliseconds(50));
  thread_.send(ExtendStroke{{at(0.1, {19.0, 3.0, 0.0})}, 0.0});
  thread_.send(EndStroke{});
  settle();
  EXPECT_EQ(thread_.state().strokes, 1);
  EXPECT_EQ(thread_.state().undo_depth, 1);
  thread_.send(UnlinkHaptics{});
  thread_.send(SaveProject{});
  settle();
  EXPECT_TRUE(errors().empty());
  Stroke whole;
  whole.tool = small_tool();
  whole.samples = {at(0.0, {19.0, -3.0, 0.0}), at(0.1, {19.0, 3.0, 0.0})};
  Clay clay = Clay::ball(20.0, {}).value();
  ASSERT_TRUE(clay.apply(whole).ok());
  EXPECT_EQ(io::load_project(folder_ / "p.vdb").value().hash(), clay.hash());
}

TEST_F(DocumentThreadTest, AnEndedThreadLeavesItsStrokesInTheJournal) {
  {
    DocumentThread thread{DocumentThreadOptions{folder_.path()}};
    thread.send(NewClay{ball(20.0)});
    thread.send(BeginStroke{small_tool(), {}});
    thread.send(ExtendStroke{{at(0.0, {20.0, 0.0, 0.0})}, 0.0});
    thread.send(EndStroke{});
    while (!thread.is_idle() || thread.state().strokes == 0) {
      std::this_thread::sleep_for(milliseconds(2));
      std::vector<double> inputs;
      thread.take_blocks(inputs);
    }
  }
  const auto files = left_untitled(folder_.path());
  ASSERT_EQ(files.size(), 1U);
  const auto left = io::left_steps(files.front());
  ASSERT_TRUE(left.ok() && left.value());
  EXPECT_EQ(left.value()->steps, 1U);
}

TEST_F(DocumentThreadTest, WhatTakesLongIsToldEvenWhereNobodyKnowsHowLong) {
  thread_.send(NewClay{{io::StartShape::Kind::ball, {60.0, 0.0, 0.0}, {0.2}}});
  Task task;
  for (int n = 0; n < 5000 && !task.is_running; ++n) {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    task = thread_.task();
  }
  EXPECT_EQ(task.name, "make clay");
  EXPECT_FALSE(task.has_progress);
  settle();
  EXPECT_FALSE(thread_.task().is_running);
}

TEST_F(DocumentThreadTest, ExportCanBeStopped) {
  thread_.send(NewClay{{io::StartShape::Kind::ball, {25.0, 0.0, 0.0}, {}}});
  thread_.send(DoStep{Resample{0.1}});
  settle();
  thread_.send(ExportMesh{folder_ / "m.3mf", {}});
  for (int n = 0; n < 2000 && !thread_.task().is_running; ++n) {
    std::this_thread::sleep_for(milliseconds(1));
  }
  thread_.cancel_task();
  settle();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "m.3mf"));
  EXPECT_FALSE(thread_.task().is_running);
}

TEST_F(DocumentThreadTest, SlicesAndAnswersFollowTheClay) {
  thread_.send(NewClay{ball(20.0)});
  settle();
  thread_.cut(SlicePlane{{-30.0, 0.0, 30.0}, {60.0, 0.0, 0.0}, {0.0, 0.0, -60.0}, 61, 61});
  thread_.ask({{0.0, -100.0, 0.0}, {0.0, 1.0, 0.0}});
  settle();
  const auto slice = thread_.take_slice();
  ASSERT_TRUE(slice);
  EXPECT_LT(slice->distance_mm[30 * 61 + 30], -5.0F);
  EXPECT_GT(slice->distance_mm[0], 5.0F);
  ASSERT_TRUE(thread_.answer() && thread_.answer()->pick);
  EXPECT_NEAR(thread_.answer()->pick->distance_mm, 80.0, 0.05);
}

TEST(DocumentThreadNews, WakeTheWindowOnceUntilTheyAreTaken) {
  const test::ScratchFolder folder;
  std::atomic<int> wakes{0};
  DocumentThread thread({folder.path(), [&] { ++wakes; }});
  const auto soon = [](const auto& is_so) {
    for (int n = 0; n < 2000 && !is_so(); ++n) std::this_thread::sleep_for(milliseconds(5));
    return is_so();
  };
  thread.send(NewClay{{io::StartShape::Kind::ball, {10.0, 0.0, 0.0}, {}}});
  ASSERT_TRUE(soon([&] { return thread.state().has_clay; }));
  EXPECT_EQ(wakes, 1);
  std::vector<double> inputs;
  ASSERT_TRUE(
      soon([&] { return static_cast<void>(thread.take_blocks(inputs)), thread.is_idle(); }));
  thread.take_blocks(inputs);
  const int before = wakes;
  EXPECT_FALSE(thread.has_news());
  thread.ask({{0.0, -100.0, 0.0}, {0.0, 1.0, 0.0}});
  ASSERT_TRUE(soon([&] { return thread.has_news(); }));
  EXPECT_EQ(wakes, before + 1);
  EXPECT_TRUE(thread.answer());
}

/// Strokes, undo and another clay: what is picked is what is shown.
TEST_F(DocumentThreadTest, AnswersAreOfTheClayThatIsShown) {
  const auto picked = [&]() -> Pick {
    settle();  // a question is answered between requests
    thread_.ask({{100.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}});
    settle();
    const auto answer = thread_.answer();
    EXPECT_TRUE(answer && answer->pick);
    return answer && answer->pick ? *answer->pick : Pick{};
  };
  thread_.send(NewClay{ball(20.0)});
  const Pick before = picked();
  EXPECT_NEAR(before.distance_mm, 80.0, 0.05);
  EXPECT_GT(before.normal.x, 0.99);
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  EXPECT_GT(std::abs(picked().distance_mm - before.distance_mm), 0.2);
  thread_.send(DoStep{io::HistoryStep::undo});
  EXPECT_EQ(picked().point_mm, before.point_mm);
  thread_.send(NewClay{ball(10.0), false});
  EXPECT_NEAR(picked().distance_mm, 90.0, 0.05);
}

}  // namespace
}  // namespace argil::viewer
