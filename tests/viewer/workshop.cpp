// SPDX-License-Identifier: GPL-3.0-or-later
#include "workshop.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "argil/io/project_file.h"
#include "argil/io/session.h"

#include "desk.h"
#include "support/scratch.h"

namespace argil::viewer {
namespace {

using std::chrono::milliseconds;

io::StartShape ball(double radius_mm) {
  return {io::StartShape::Kind::ball, {radius_mm, 0.0, 0.0}, {}};
}

Tool small_tool() {
  Tool tool;
  tool.radii_mm = {2.0, 2.0, 2.0};
  return tool;
}

StrokeSample at(double time_s, const Vec3& place) { return {time_s, place, {}, 1.0}; }

class WorkshopTest : public testing::Test {
 protected:
  /// Waits until all was done, and takes the blocks as a renderer would.
  BlockNews settle() {
    BlockNews all;
    do {
      std::this_thread::sleep_for(milliseconds(2));
      std::vector<double> inputs;
      all.append(shop_.take_blocks(inputs));
    } while (!shop_.is_idle());
    return all;
  }

  std::vector<std::string> errors() {
    std::vector<std::string> found;
    for (const Notice& notice : shop_.take_notices()) {
      if (notice.kind == Notice::Kind::error) found.push_back(notice.text);
    }
    return found;
  }

  void stroke(const Vec3& from, const Vec3& to, const Tool& tool = small_tool()) {
    shop_.send(BeginStroke{tool, {}});
    for (int n = 0; n <= 10; ++n) {
      shop_.send(ExtendStroke{{at(0.01 * n, from + (0.1 * n) * (to - from))}, 0.0});
    }
    shop_.send(EndStroke{});
  }

  test::ScratchFolder folder_;
  Workshop shop_{WorkshopOptions{folder_.path()}};
};

TEST_F(WorkshopTest, SendsTheBlocksOfANewClayAndThenOnlyThoseThatAStrokeChanged) {
  shop_.send(NewClay{ball(60.0)});
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

TEST_F(WorkshopTest, BlocksThatWereFollowedAreThoseOfTheClay) {
  shop_.send(NewClay{ball(20.0)});
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
  shop_.send(DoStep{io::HistoryStep::undo});
  follow(settle());
  stroke({0.0, 0.0, 20.0}, {5.0, 0.0, 18.0});
  shop_.send(SaveProjectAs{folder_ / "p.vdb"});
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

TEST_F(WorkshopTest, AStrokeInPiecesIsTheStrokeOfTheScript) {
  shop_.send(NewClay{ball(20.0)});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  shop_.send(SaveProjectAs{folder_ / "p.vdb"});
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

TEST_F(WorkshopTest, ALargeToolIsSketchedAndEndsAsItsStroke) {
  shop_.send(NewClay{ball(40.0)});
  std::map<BlockId, BlockMesh> held;
  bool was_sketched = false;
  const auto follow = [&](BlockNews&& news) {
    if (news.is_fresh) held.clear();
    for (const BlockId& id : news.gone) held.erase(id);
    for (auto& [id, block] : news.changed) held.insert_or_assign(id, std::move(block));
  };
  follow(settle());
  Tool large = small_tool();
  large.radii_mm = {15.0, 15.0, 15.0};
  Stroke whole;
  whole.tool = large;
  shop_.send(BeginStroke{large, {}});
  for (int n = 0; n <= 10; ++n) {
    const StrokeSample sample = at(0.01 * n, {36.0, -20.0 + 4.0 * n, 0.0});
    whole.samples.push_back(sample);
    shop_.send(ExtendStroke{{sample}, 0.0});
    std::vector<double> inputs;
    follow(shop_.take_blocks(inputs));
  }
  // Shown before the clay is there.
  for (int n = 0; n < 2000 && !was_sketched; ++n) {
    std::vector<double> inputs;
    BlockNews news = shop_.take_blocks(inputs);
    for (const auto& [id, block] : news.changed) {
      was_sketched = was_sketched || block.bounds_mm.max.x > 48.0;
    }
    follow(std::move(news));
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_TRUE(was_sketched);
  EXPECT_FALSE(shop_.is_idle());
  shop_.send(EndStroke{});
  follow(settle());
  EXPECT_EQ(shop_.state().strokes, 1);
  shop_.send(SaveProjectAs{folder_ / "p.vdb"});
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

TEST_F(WorkshopTest, APaintedMaskIsSentWithItsBlocks) {
  shop_.send(NewClay{ball(20.0)});
  settle();
  Tool mask = small_tool();
  mask.action = Action::mask;
  stroke({20.0, -3.0, 0.0}, {20.0, 3.0, 0.0}, mask);
  const BlockNews news = settle();
  int held = 0;
  for (const auto& [id, block] : news.changed) {
    ASSERT_EQ(block.held.size(), block.vertices.size());
    for (std::size_t n = 0; n < block.held.size(); ++n) {
      if (block.held[n] < 200) continue;
      ++held;
      EXPECT_GT(block.vertices[n].position_mm[0], 17.0F);
    }
  }
  EXPECT_GT(held, 20);
  EXPECT_TRUE(shop_.state().has_mask);
  shop_.send(DoStep{MaskEdit::clear});
  for (const auto& [id, block] : settle().changed) EXPECT_TRUE(block.held.empty());
}

TEST_F(WorkshopTest, WhatWasNeverSavedIsInTheHomeFolderUntilItIs) {
  shop_.send(NewClay{ball(20.0)});
  settle();
  ASSERT_EQ(left_untitled(folder_.path()).size(), 1U);
  EXPECT_TRUE(shop_.state().is_untitled);
  EXPECT_FALSE(shop_.state().is_changed);
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  settle();
  EXPECT_TRUE(shop_.state().is_changed);
  shop_.send(SaveProject{});
  settle();
  EXPECT_EQ(errors().size(), 1U);  // it has no name
  shop_.send(SaveProjectAs{folder_ / "named.vdb"});
  settle();
  EXPECT_TRUE(left_untitled(folder_.path()).empty());
  EXPECT_EQ(shop_.state().file, folder_ / "named.vdb");
  EXPECT_FALSE(shop_.state().is_changed);
}

/// What the project is now, with the steps of its journal, as another window would find it.
std::uint64_t hash_with_journal(const std::filesystem::path& project) {
  const auto opened = io::open_project(project);
  EXPECT_TRUE(opened.ok());
  return opened ? opened.value().clay.hash() : 0;
}

TEST_F(WorkshopTest, SavingUnderAnotherNameKeepsWhatCanBeUndoneAndRedone) {
  const auto named = folder_ / "named.vdb";
  shop_.send(NewClay{ball(20.0)});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  shop_.send(DoStep{Cut{{0.0, 0.0, -15.0}, {0.0, 0.0, 1.0}, true}});
  stroke({0.0, 19.0, -3.0}, {0.0, 19.0, 3.0});
  shop_.send(DoStep{io::HistoryStep::undo});
  shop_.send(SaveProjectAs{named});
  settle();
  ASSERT_TRUE(errors().empty());
  EXPECT_EQ(shop_.state().undo_depth, 2);
  EXPECT_FALSE(shop_.state().is_changed);
  const std::uint64_t first = Clay::ball(20.0, {}).value().hash();
  EXPECT_NE(io::load_project(named).value().hash(), first);
  ASSERT_TRUE(shop_.state().steps);
  EXPECT_EQ(shop_.state().steps->names.size(), 3U);
  EXPECT_EQ(shop_.state().steps->done, 2U);

  // Behind the save and back: the journal says the same as the clay, as after a kill.
  const std::uint64_t saved = io::load_project(named).value().hash();
  shop_.send(GoToStep{0});
  settle();
  EXPECT_TRUE(shop_.state().is_changed);
  shop_.send(SaveProjectAs{folder_ / "first.vdb"});
  settle();
  EXPECT_EQ(io::load_project(folder_ / "first.vdb").value().hash(), first);
  EXPECT_EQ(io::load_project(named).value().hash(), saved);
  shop_.send(GoToStep{2});
  shop_.send(SaveProject{});
  settle();
  EXPECT_EQ(io::load_project(folder_ / "first.vdb").value().hash(), saved);
  shop_.send(GoToStep{3});
  settle();
  EXPECT_EQ(shop_.state().undo_depth, 3);
  EXPECT_TRUE(errors().empty());
}

TEST_F(WorkshopTest, AnUndoBehindASaveUnderAnotherNameIsRecovered) {
  const auto named = folder_ / "named.vdb";
  const std::uint64_t first = Clay::ball(20.0, {}).value().hash();
  {
    Workshop shop{WorkshopOptions{folder_.path()}};
    shop.send(NewClay{ball(20.0)});
    for (const double y : {-3.0, 3.0}) {
      shop.send(BeginStroke{small_tool(), {}});
      shop.send(ExtendStroke{{at(0.0, {19.0, y, 0.0})}, 0.0});
      shop.send(EndStroke{});
    }
    shop.send(SaveProjectAs{named});
    shop.send(GoToStep{0});
    while (!shop.is_idle() || !shop.state().has_clay) {
      std::this_thread::sleep_for(milliseconds(2));
      std::vector<double> inputs;
      shop.take_blocks(inputs);
    }
    ASSERT_EQ(shop.state().undo_depth, 0);
    EXPECT_TRUE(left_untitled(folder_.path()).empty());
  }  // its journal stays, as after a kill
  EXPECT_NE(io::load_project(named).value().hash(), first);
  EXPECT_EQ(hash_with_journal(named), first);
  // And whoever recovers it sees the steps by their names, and can repeat them.
  shop_.send(OpenFile{named, true, OpenFile::Left::repeat});
  settle();
  EXPECT_TRUE(errors().empty());
  ASSERT_TRUE(shop_.state().steps);
  EXPECT_EQ(shop_.state().steps->done, 0U);
  ASSERT_EQ(shop_.state().steps->names.size(), 2U);
  EXPECT_EQ(shop_.state().steps->names[1], "Add, 2 mm");
  shop_.send(GoToStep{2});
  settle();
  EXPECT_EQ(shop_.state().undo_depth, 2);
}

TEST_F(WorkshopTest, AFileThatSomebodyRemovedIsWrittenAgain) {
  const auto named = folder_ / "p.vdb";
  shop_.send(NewClay{ball(20.0)});
  shop_.send(SaveProjectAs{named});
  settle();
  std::filesystem::remove(named);
  shop_.send(SaveProject{});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_TRUE(io::load_project(named).ok());
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  settle();
  std::filesystem::remove(named);
  shop_.send(SaveProjectAs{named});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_NE(io::load_project(named).value().hash(), Clay::ball(20.0, {}).value().hash());
}

TEST_F(WorkshopTest, AFileThatCannotBeOpenedLeavesTheClayWhereItWas) {
  shop_.send(NewClay{ball(20.0)});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  shop_.send(SaveProjectAs{folder_ / "p.vdb"});
  settle();
  for (const char* name : {"no_such.vdb", "no_such.obj"}) {
    shop_.send(OpenFile{folder_ / name});
    settle();
    EXPECT_EQ(errors().size(), 1U) << name;
    EXPECT_EQ(shop_.state().file, folder_ / "p.vdb");
    EXPECT_EQ(shop_.state().undo_depth, 1);
  }
  shop_.send(NewClay{ball(-1.0)});
  settle();
  EXPECT_EQ(errors().size(), 1U);
  EXPECT_EQ(shop_.state().file, folder_ / "p.vdb");
}

TEST_F(WorkshopTest, AnImportedMeshIsNotThrownAwayUnasked) {
  std::ofstream(folder_ / "m.obj") << "v 0 0 0\nv 10 0 0\nv 0 2 0\nv 0 0 2\n"
                                      "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  shop_.send(OpenFile{folder_ / "m.obj"});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_TRUE(shop_.state().is_changed);
  shop_.send(EndProject{true});
  settle();
  EXPECT_EQ(errors().size(), 1U);  // it has no name
  shop_.send(SaveProjectAs{folder_ / "m.vdb"});
  settle();
  EXPECT_FALSE(shop_.state().is_changed);
}

TEST_F(WorkshopTest, WhatAKilledWindowLeftWithoutANameIsNotThrownAwayUnasked) {
  const std::filesystem::path file = folder_ / "unsaved/Untitled-1.vdb";
  std::filesystem::create_directories(file.parent_path());
  ASSERT_TRUE(io::save_project(file, Clay::ball(20.0, {}).value()).ok());  // as an import is
  shop_.send(OpenFile{file});
  settle();
  EXPECT_TRUE(shop_.state().is_untitled);
  EXPECT_TRUE(shop_.state().is_changed);
  shop_.send(EndProject{true});
  settle();
  EXPECT_EQ(errors().size(), 1U);  // it has no name
  EXPECT_TRUE(std::filesystem::exists(file));
  shop_.send(EndProject{false});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_FALSE(std::filesystem::exists(file)) << "a person said so";
}

TEST_F(WorkshopTest, StepsThatWerePutAsideKeepTheProjectThatTheyBelongTo) {
  const std::filesystem::path file = folder_ / "unsaved/Untitled-1.vdb";
  std::filesystem::create_directories(file.parent_path());
  {
    auto session = io::Session::create(file, Clay::ball(20.0, {}).value());
    ASSERT_TRUE(session.ok());
    Stroke left;
    left.tool = small_tool();
    left.samples = {at(0.0, {20.0, 0.0, 0.0})};
    ASSERT_TRUE(session.value().clay().apply(left).ok());
    session.value().record(left);
  }
  shop_.send(OpenFile{file, true, OpenFile::Left::put_aside});
  stroke({0.0, 20.0, -3.0}, {0.0, 20.0, 3.0});
  shop_.send(EndProject{false});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_FALSE(shop_.state().has_clay);
  ASSERT_TRUE(std::filesystem::exists(folder_ / "unsaved/Untitled-1.journal.jsonl.left-1"));
  ASSERT_TRUE(std::filesystem::exists(file));
  EXPECT_EQ(hash_with_journal(file), Clay::ball(20.0, {}).value().hash());
}

TEST_F(WorkshopTest, AProjectWithoutANameWhoseStepsWerePutAsideIsAskedAboutAndCanBeThrownAway) {
  const std::filesystem::path unsaved = folder_ / "unsaved";
  std::filesystem::create_directories(unsaved);
  for (const char* const name : {"Untitled-1.vdb", "Untitled-2.vdb"}) {
    auto session = io::Session::create(unsaved / name, Clay::ball(20.0, {}).value());
    ASSERT_TRUE(session.ok());
    Stroke left;
    left.tool = small_tool();
    left.samples = {at(0.0, {20.0, 0.0, 0.0})};
    ASSERT_TRUE(session.value().clay().apply(left).ok());
    session.value().record(left);
    ASSERT_TRUE(session.value().save().ok());  // so that there is an origin, too
    session.value().record(left);
  }
  const auto first = unsaved / "Untitled-1.vdb";
  shop_.send(OpenFile{first, true, OpenFile::Left::put_aside});
  settle();
  shop_.send(DropProject{first});  // it is on the desk
  settle();
  EXPECT_EQ(errors().size(), 1U);
  shop_.send(EndProject{false});
  shop_.send(OpenFile{first});
  settle();
  EXPECT_FALSE(shop_.state().has_clay);
  ASSERT_TRUE(shop_.state().left);
  EXPECT_EQ(shop_.state().left->left.steps, 0U);
  shop_.send(DropProject{first});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_FALSE(shop_.state().left);
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(unsaved)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{".Untitled-2.origin.vdb", "Untitled-2.journal.jsonl",
                                             "Untitled-2.vdb"}));
}

/// No file grows beyond this, as on a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(std::uintmax_t bytes) {
    former_signal_ = std::signal(SIGXFSZ, SIG_IGN);  // then a write beyond it fails with EFBIG
    ::getrlimit(RLIMIT_FSIZE, &former_);
    const rlimit limit{bytes, former_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &former_);
    std::signal(SIGXFSZ, former_signal_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit former_{};
  void (*former_signal_)(int) = SIG_DFL;
};

TEST_F(WorkshopTest, AFullDiskLeavesWhatLayUnderTheNameAsItWas) {
  const auto there = folder_ / "there.vdb";
  ASSERT_TRUE(io::save_project(there, Clay::block({9.0, 8.0, 7.0}, {}).value()).ok());
  const std::uint64_t hash = io::load_project(there).value().hash();
  shop_.send(NewClay{ball(20.0)});
  settle();
  const std::uintmax_t start_bytes = std::filesystem::file_size(shop_.state().file);
  for (int n = -5; n <= 5; ++n) stroke({19.0, 3.0 * n, -12.0}, {19.0, 3.0 * n, 12.0});
  const auto saved = folder_ / "saved.vdb";
  shop_.send(SaveProjectAs{saved});
  settle();
  const std::uintmax_t bytes = std::filesystem::file_size(saved);
  ASSERT_GT(bytes, start_bytes + 20'000);
  {
    const FullDisk disk((start_bytes + bytes) / 2);  // room for the start, not for the rest
    for (const char* const name : {"there.vdb", "fresh.vdb"}) {
      shop_.send(SaveProjectAs{folder_ / name});
      settle();
      EXPECT_FALSE(errors().empty()) << name;
    }
  }
  EXPECT_EQ(io::load_project(there).value().hash(), hash);
  EXPECT_EQ(shop_.state().file, saved);
  EXPECT_EQ(shop_.state().undo_depth, 11);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "fresh.vdb"));
  for (const std::string& name : folder_.names()) {
    EXPECT_EQ(name.find("former"), std::string::npos) << name;
    EXPECT_FALSE(name.starts_with("fresh.")) << name;
  }
  // And with room it is saved, and nothing else lies about.
  shop_.send(SaveProjectAs{there});
  settle();
  EXPECT_EQ(shop_.state().file, there);
  EXPECT_NE(io::load_project(there).value().hash(), hash);
  for (const std::string& name : folder_.names()) {
    EXPECT_EQ(name.find("former"), std::string::npos) << name;
  }
}

TEST_F(WorkshopTest, WhatWasMeantForASavedClayIsNotDoneWithoutAndNotComplainedAbout) {
  shop_.send(NewClay{ball(20.0)});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  shop_.send(SaveProjectAs{folder_ / "no folder" / "p.vdb", true});
  shop_.send(EndProject{true});
  settle();
  EXPECT_EQ(errors().size(), 1U);
  EXPECT_EQ(shop_.state().undo_depth, 1);
  shop_.send(EndProject{true});  // was not meant for it
  settle();
  EXPECT_EQ(errors().size(), 1U);
}

TEST_F(WorkshopTest, AStrokeThatCrossedTheAirIsTakenBackWithAllItsParts) {
  shop_.send(NewClay{ball(20.0)});
  stroke({0.0, 19.0, -3.0}, {0.0, 19.0, 3.0});
  settle();
  shop_.send(SaveProjectAs{folder_ / "before.vdb"});
  const auto part = [&](double y, bool goes_on) {
    shop_.send(BeginStroke{small_tool(), {}, false, goes_on});
    shop_.send(ExtendStroke{{at(0.0, {19.0, y, 0.0})}, 0.0});
  };
  part(-4.0, false);
  shop_.send(EndStroke{});
  part(0.0, true);
  shop_.send(EndStroke{});
  part(4.0, true);
  shop_.send(CancelStroke{});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_EQ(shop_.state().undo_depth, 1);
  shop_.send(SaveProjectAs{folder_ / "after.vdb"});
  settle();
  EXPECT_EQ(io::load_project(folder_ / "after.vdb").value().hash(),
            io::load_project(folder_ / "before.vdb").value().hash());
}

TEST_F(WorkshopTest, AStampIsCalledSoAndNothingToRedoIsSaidInWords) {
  shop_.send(NewClay{ball(20.0)});
  shop_.send(BeginStroke{small_tool(), {}, true});
  shop_.send(ExtendStroke{{at(0.0, {19.0, 0.0, 0.0})}, 0.0});
  shop_.send(EndStroke{});
  stroke({0.0, 19.0, -3.0}, {0.0, 19.0, 3.0});
  shop_.send(DoStep{io::HistoryStep::redo});
  settle();
  EXPECT_EQ(shop_.state().steps->names, (std::vector<std::string>{"Stamp, 2 mm", "Add, 2 mm"}));
  const std::vector<Notice> told = shop_.take_notices();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].text, "there is nothing to redo");
}

TEST_F(WorkshopTest, AnEndingMayBeOfCapitals) {
  ASSERT_TRUE(io::save_project(folder_ / "OWL.VDB", Clay::ball(20.0, {}).value()).ok());
  shop_.send(OpenFile{folder_ / "OWL.VDB"});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_EQ(shop_.state().file, folder_ / "OWL.VDB");
  EXPECT_FALSE(shop_.state().is_untitled);
}

TEST_F(WorkshopTest, WithoutSavingAProjectIsWhatItWas) {
  shop_.send(NewClay{ball(20.0)});
  shop_.send(SaveProjectAs{folder_ / "p.vdb"});
  settle();
  const std::uint64_t hash = io::load_project(folder_ / "p.vdb").value().hash();
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  shop_.send(EndProject{false});
  settle();
  EXPECT_FALSE(shop_.state().has_clay);
  EXPECT_EQ(io::open_project(folder_ / "p.vdb").value().clay.hash(), hash);
}

TEST_F(WorkshopTest, AChangedClayWithoutANameIsNotLeftToBeSaved) {
  shop_.send(NewClay{ball(20.0)});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  settle();
  const int depth = shop_.state().undo_depth;
  shop_.send(NewClay{ball(10.0), true});
  shop_.send(EndProject{true});
  settle();
  EXPECT_EQ(errors().size(), 2U);
  EXPECT_EQ(shop_.state().undo_depth, depth);
}

TEST_F(WorkshopTest, WithoutSavingWhatCameAfterASaveIsNotLeftToBeRecovered) {
  shop_.send(NewClay{ball(20.0)});
  shop_.send(SaveProjectAs{folder_ / "p.vdb"});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  shop_.send(SaveProject{});
  settle();
  const std::uint64_t hash = io::load_project(folder_ / "p.vdb").value().hash();
  stroke({-19.0, -3.0, 0.0}, {-19.0, 3.0, 0.0});
  shop_.send(EndProject{false});
  settle();
  EXPECT_EQ(io::open_project(folder_ / "p.vdb").value().clay.hash(), hash);
  EXPECT_FALSE(io::left_steps(folder_ / "p.vdb").value());
}

TEST_F(WorkshopTest, OpeningWhatIsOpenHereOrInAnotherWindowIsRefusedWithoutAQuestion) {
  shop_.send(NewClay{ball(20.0)});
  shop_.send(SaveProjectAs{folder_ / "p.vdb"});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  shop_.send(OpenFile{folder_ / "p.vdb"});
  settle();
  EXPECT_FALSE(shop_.state().left);
  EXPECT_EQ(shop_.state().undo_depth, 1);
  auto told = errors();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("in this window already"), std::string::npos) << told[0];

  Workshop other{WorkshopOptions{folder_ / "other"}};
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

TEST_F(WorkshopTest, AProjectThatCannotBeSavedIsNotLeftForAnother) {
  shop_.send(NewClay{ball(20.0)});
  shop_.send(SaveProjectAs{folder_ / "p.vdb"});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  settle();
  std::filesystem::remove(folder_ / "p.vdb");
  std::filesystem::create_directories(folder_ / "p.vdb" / "in the way");
  shop_.send(NewClay{ball(10.0), true});
  shop_.send(EndProject{true});
  settle();
  EXPECT_EQ(errors().size(), 2U);
  EXPECT_EQ(shop_.state().file, folder_ / "p.vdb");
  EXPECT_EQ(shop_.state().undo_depth, 1);
  EXPECT_TRUE(left_untitled(folder_.path()).empty());
  // And saved once it can be.
  std::filesystem::remove_all(folder_ / "p.vdb");
  shop_.send(SaveProjectAs{folder_ / "q.vdb"});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_TRUE(io::load_project(folder_ / "q.vdb").ok());
}

TEST_F(WorkshopTest, AnUntitledFileThatCannotBeRemovedEndsNoWindow) {
  shop_.send(NewClay{ball(20.0)});
  settle();
  const std::filesystem::path file = shop_.state().file;
  std::filesystem::remove(file);
  std::filesystem::create_directories(file / "in the way");
  shop_.send(EndProject{true});
  settle();
  EXPECT_FALSE(shop_.state().has_clay);
  EXPECT_EQ(errors().size(), 1U);
  shop_.send(NewClay{ball(10.0)});
  settle();
  EXPECT_TRUE(shop_.state().has_clay);
}

TEST_F(WorkshopTest, OnlyWhatTheWindowItselfNamedIsThrownAwayUnsaved) {
  const std::filesystem::path unsaved = folder_ / "unsaved";
  std::filesystem::create_directories(unsaved);
  ASSERT_TRUE(io::save_project(unsaved / "mine.vdb", Clay::ball(5.0, {}).value()).ok());
  shop_.send(OpenFile{unsaved / "mine.vdb"});
  settle();
  EXPECT_FALSE(shop_.state().is_untitled);
  shop_.send(EndProject{true});
  shop_.send(NewClay{ball(20.0)});
  settle();
  EXPECT_TRUE(std::filesystem::exists(unsaved / "mine.vdb"));
  // What would be taken for untitled later is not a place to save.
  shop_.send(SaveProjectAs{shop_.state().file});
  shop_.send(SaveProjectAs{unsaved / "Untitled-of-mine.vdb"});
  settle();
  EXPECT_EQ(errors().size(), 2U);
  EXPECT_TRUE(shop_.state().is_untitled);
}

TEST_F(WorkshopTest, AnExportDoesNotReplaceTheProjectItself) {
  shop_.send(NewClay{ball(20.0)});
  shop_.send(SaveProjectAs{folder_ / "p.vdb"});
  settle();
  const std::uint64_t hash = io::load_project(folder_ / "p.vdb").value().hash();
  shop_.send(ExportMesh{folder_ / "p.vdb", {}});
  settle();
  EXPECT_EQ(errors().size(), 1U);
  EXPECT_EQ(io::load_project(folder_ / "p.vdb").value().hash(), hash);
}

TEST_F(WorkshopTest, AHandThatIsLinkedDoesNotEndTheStrokeOfTheMouse) {
  shop_.send(NewClay{ball(20.0)});
  shop_.send(SaveProjectAs{folder_ / "p.vdb"});
  ToolSampleRing ring(64);
  WindowChannel channel;
  ClayPulse pulse;
  shop_.send(LinkHaptics{&ring, &channel, &pulse, small_tool(), {}});
  shop_.send(BeginStroke{small_tool(), {}});
  shop_.send(ExtendStroke{{at(0.0, {19.0, -3.0, 0.0})}, 0.0});
  settle();
  ToolSample resting;  // as a device that is not pressed tells it
  resting.index = 1;
  resting.position_mm = {0.0, -60.0, 0.0};
  resting.voxel_mm = 1.0;
  resting.reach_mm = 5.0;
  resting.depth_mm = 5.0;
  ring.push(resting);
  std::this_thread::sleep_for(milliseconds(50));
  shop_.send(ExtendStroke{{at(0.1, {19.0, 3.0, 0.0})}, 0.0});
  shop_.send(EndStroke{});
  settle();
  EXPECT_EQ(shop_.state().strokes, 1);
  EXPECT_EQ(shop_.state().undo_depth, 1);
  shop_.send(UnlinkHaptics{});
  shop_.send(SaveProject{});
  settle();
  EXPECT_TRUE(errors().empty());
  Stroke whole;
  whole.tool = small_tool();
  whole.samples = {at(0.0, {19.0, -3.0, 0.0}), at(0.1, {19.0, 3.0, 0.0})};
  Clay clay = Clay::ball(20.0, {}).value();
  ASSERT_TRUE(clay.apply(whole).ok());
  EXPECT_EQ(io::load_project(folder_ / "p.vdb").value().hash(), clay.hash());
}

TEST_F(WorkshopTest, AnEndedWorkshopLeavesItsStrokesInTheJournal) {
  {
    Workshop shop{WorkshopOptions{folder_.path()}};
    shop.send(NewClay{ball(20.0)});
    shop.send(BeginStroke{small_tool(), {}});
    shop.send(ExtendStroke{{at(0.0, {20.0, 0.0, 0.0})}, 0.0});
    shop.send(EndStroke{});
    while (!shop.is_idle() || shop.state().strokes == 0) {
      std::this_thread::sleep_for(milliseconds(2));
      std::vector<double> inputs;
      shop.take_blocks(inputs);
    }
  }
  const auto files = left_untitled(folder_.path());
  ASSERT_EQ(files.size(), 1U);
  const auto left = io::left_steps(files.front());
  ASSERT_TRUE(left.ok() && left.value());
  EXPECT_EQ(left.value()->steps, 1U);
}

TEST_F(WorkshopTest, WhatTakesLongIsToldEvenWhereNobodyKnowsHowLong) {
  shop_.send(NewClay{{io::StartShape::Kind::ball, {60.0, 0.0, 0.0}, {0.2}}});
  Task task;
  for (int n = 0; n < 5000 && !task.is_running; ++n) {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    task = shop_.task();
  }
  EXPECT_EQ(task.name, "make clay");
  EXPECT_FALSE(task.has_progress);
  settle();
  EXPECT_FALSE(shop_.task().is_running);
}

TEST_F(WorkshopTest, ExportCanBeStopped) {
  shop_.send(NewClay{{io::StartShape::Kind::ball, {25.0, 0.0, 0.0}, {}}});
  shop_.send(DoStep{Resample{0.1}});
  settle();
  shop_.send(ExportMesh{folder_ / "m.3mf", {}});
  for (int n = 0; n < 2000 && !shop_.task().is_running; ++n) {
    std::this_thread::sleep_for(milliseconds(1));
  }
  shop_.cancel_task();
  settle();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "m.3mf"));
  EXPECT_FALSE(shop_.task().is_running);
}

TEST_F(WorkshopTest, SlicesAndAnswersFollowTheClay) {
  shop_.send(NewClay{ball(20.0)});
  settle();
  shop_.cut(Workshop::SlicePlane{{-30.0, 0.0, 30.0}, {60.0, 0.0, 0.0}, {0.0, 0.0, -60.0}, 61, 61});
  shop_.ask({{0.0, -100.0, 0.0}, {0.0, 1.0, 0.0}});
  settle();
  const auto slice = shop_.take_slice();
  ASSERT_TRUE(slice);
  EXPECT_LT(slice->distance_mm[30 * 61 + 30], -5.0F);
  EXPECT_GT(slice->distance_mm[0], 5.0F);
  ASSERT_TRUE(shop_.answer() && shop_.answer()->pick);
  EXPECT_NEAR(shop_.answer()->pick->distance_mm, 80.0, 0.05);
}

}  // namespace
}  // namespace argil::viewer
