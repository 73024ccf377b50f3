// SPDX-License-Identifier: GPL-3.0-or-later
// Where projects lie, what is left of them, and what a window may throw away.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "argil/io/project_file.h"
#include "argil/io/session.h"

#include "viewer/document/document_fixture.h"

namespace argil::viewer {
namespace {

TEST_F(DocumentThreadTest, WhatWasNeverSavedIsInTheHomeFolderUntilItIs) {
  thread_.send(NewClay{ball(20.0)});
  settle();
  ASSERT_EQ(left_untitled(folder_.path()).size(), 1U);
  EXPECT_TRUE(thread_.state().is_untitled);
  EXPECT_FALSE(thread_.state().is_changed);
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  settle();
  EXPECT_TRUE(thread_.state().is_changed);
  thread_.send(SaveProject{});
  settle();
  EXPECT_EQ(errors().size(), 1U);  // it has no name
  thread_.send(SaveProjectAs{folder_ / "named.vdb"});
  settle();
  EXPECT_TRUE(left_untitled(folder_.path()).empty());
  EXPECT_EQ(thread_.state().file, folder_ / "named.vdb");
  EXPECT_FALSE(thread_.state().is_changed);
}

/// What the project is now, with the steps of its journal, as another window would find it.
std::uint64_t hash_with_journal(const std::filesystem::path& project) {
  const auto opened = io::open_project(project);
  EXPECT_TRUE(opened.ok());
  return opened ? opened.value().sculpture.hash() : 0;
}

TEST_F(DocumentThreadTest, SavingUnderAnotherNameKeepsWhatCanBeUndoneAndRedone) {
  const auto named = folder_ / "named.vdb";
  thread_.send(NewClay{ball(20.0)});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  thread_.send(DoStep{Cut{{0.0, 0.0, -15.0}, {0.0, 0.0, 1.0}, true}});
  stroke({0.0, 19.0, -3.0}, {0.0, 19.0, 3.0});
  thread_.send(DoStep{io::HistoryStep::undo});
  thread_.send(SaveProjectAs{named});
  settle();
  ASSERT_TRUE(errors().empty());
  EXPECT_EQ(thread_.state().undo_depth, 2);
  EXPECT_FALSE(thread_.state().is_changed);
  const std::uint64_t first = Clay::ball(20.0, {}).value().hash();
  EXPECT_NE(io::load_project(named).value().hash(), first);
  ASSERT_TRUE(thread_.state().steps);
  EXPECT_EQ(thread_.state().steps->names.size(), 3U);
  EXPECT_EQ(thread_.state().steps->done, 2U);

  // Behind the save and back: the journal says the same as the clay, as after a kill.
  const std::uint64_t saved = io::load_project(named).value().hash();
  thread_.send(GoToStep{0});
  settle();
  EXPECT_TRUE(thread_.state().is_changed);
  thread_.send(SaveProjectAs{folder_ / "first.vdb"});
  settle();
  EXPECT_EQ(io::load_project(folder_ / "first.vdb").value().hash(), first);
  EXPECT_EQ(io::load_project(named).value().hash(), saved);
  thread_.send(GoToStep{2});
  thread_.send(SaveProject{});
  settle();
  EXPECT_EQ(io::load_project(folder_ / "first.vdb").value().hash(), saved);
  thread_.send(GoToStep{3});
  settle();
  EXPECT_EQ(thread_.state().undo_depth, 3);
  EXPECT_TRUE(errors().empty());
}

TEST_F(DocumentThreadTest, AnUndoBehindASaveUnderAnotherNameIsRecovered) {
  const auto named = folder_ / "named.vdb";
  const std::uint64_t first = Clay::ball(20.0, {}).value().hash();
  {
    DocumentThread thread{DocumentThreadOptions{folder_.path()}};
    thread.send(NewClay{ball(20.0)});
    for (const double y : {-3.0, 3.0}) {
      thread.send(BeginStroke{small_tool(), {}});
      thread.send(ExtendStroke{{at(0.0, {19.0, y, 0.0})}, 0.0});
      thread.send(EndStroke{});
    }
    thread.send(SaveProjectAs{named});
    thread.send(GoToStep{0});
    while (!thread.is_idle() || !thread.state().has_clay) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      std::vector<double> inputs;
      thread.take_blocks(inputs);
    }
    ASSERT_EQ(thread.state().undo_depth, 0);
    EXPECT_TRUE(left_untitled(folder_.path()).empty());
  }  // its journal stays, as after a kill
  EXPECT_NE(io::load_project(named).value().hash(), first);
  EXPECT_EQ(hash_with_journal(named), first);
  // And whoever recovers it sees the steps by their names, and can repeat them.
  thread_.send(OpenFile{named, true, OpenFile::Left::repeat});
  settle();
  EXPECT_TRUE(errors().empty());
  ASSERT_TRUE(thread_.state().steps);
  EXPECT_EQ(thread_.state().steps->done, 0U);
  ASSERT_EQ(thread_.state().steps->names.size(), 2U);
  EXPECT_EQ(thread_.state().steps->names[1], "Add, 2 mm");
  thread_.send(GoToStep{2});
  settle();
  EXPECT_EQ(thread_.state().undo_depth, 2);
}

TEST_F(DocumentThreadTest, AFileThatSomebodyRemovedIsWrittenAgain) {
  const auto named = folder_ / "p.vdb";
  thread_.send(NewClay{ball(20.0)});
  thread_.send(SaveProjectAs{named});
  settle();
  std::filesystem::remove(named);
  thread_.send(SaveProject{});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_TRUE(io::load_project(named).ok());
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  settle();
  std::filesystem::remove(named);
  thread_.send(SaveProjectAs{named});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_NE(io::load_project(named).value().hash(), Clay::ball(20.0, {}).value().hash());
}

TEST_F(DocumentThreadTest, AFileThatCannotBeOpenedLeavesTheClayWhereItWas) {
  thread_.send(NewClay{ball(20.0)});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  thread_.send(SaveProjectAs{folder_ / "p.vdb"});
  settle();
  for (const char* name : {"no_such.vdb", "no_such.obj"}) {
    thread_.send(OpenFile{folder_ / name});
    settle();
    EXPECT_EQ(errors().size(), 1U) << name;
    EXPECT_EQ(thread_.state().file, folder_ / "p.vdb");
    EXPECT_EQ(thread_.state().undo_depth, 1);
  }
  thread_.send(NewClay{ball(-1.0)});
  settle();
  EXPECT_EQ(errors().size(), 1U);
  EXPECT_EQ(thread_.state().file, folder_ / "p.vdb");
}

TEST_F(DocumentThreadTest, AnImportedMeshIsNotThrownAwayUnasked) {
  std::ofstream(folder_ / "m.obj") << "v 0 0 0\nv 10 0 0\nv 0 2 0\nv 0 0 2\n"
                                      "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  thread_.send(OpenFile{folder_ / "m.obj"});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_TRUE(thread_.state().is_changed);
  thread_.send(EndProject{true});
  settle();
  EXPECT_EQ(errors().size(), 1U);  // it has no name
  thread_.send(SaveProjectAs{folder_ / "m.vdb"});
  settle();
  EXPECT_FALSE(thread_.state().is_changed);
}

TEST_F(DocumentThreadTest, WhatAKilledWindowLeftWithoutANameIsNotThrownAwayUnasked) {
  const std::filesystem::path file = folder_ / "unsaved/Untitled-1.vdb";
  std::filesystem::create_directories(file.parent_path());
  ASSERT_TRUE(io::save_project(file, Clay::ball(20.0, {}).value()).ok());  // as an import is
  thread_.send(OpenFile{file});
  settle();
  EXPECT_TRUE(thread_.state().is_untitled);
  EXPECT_TRUE(thread_.state().is_changed);
  thread_.send(EndProject{true});
  settle();
  EXPECT_EQ(errors().size(), 1U);  // it has no name
  EXPECT_TRUE(std::filesystem::exists(file));
  thread_.send(EndProject{false});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_FALSE(std::filesystem::exists(file)) << "a person said so";
}

TEST_F(DocumentThreadTest, StepsThatWerePutAsideKeepTheProjectThatTheyBelongTo) {
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
  thread_.send(OpenFile{file, true, OpenFile::Left::put_aside});
  stroke({0.0, 20.0, -3.0}, {0.0, 20.0, 3.0});
  thread_.send(EndProject{false});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_FALSE(thread_.state().has_clay);
  ASSERT_TRUE(std::filesystem::exists(folder_ / "unsaved/Untitled-1.journal.jsonl.left-1"));
  ASSERT_TRUE(std::filesystem::exists(file));
  EXPECT_EQ(hash_with_journal(file), Clay::ball(20.0, {}).value().hash());
}

TEST_F(DocumentThreadTest,
       AProjectWithoutANameWhoseStepsWerePutAsideIsAskedAboutAndCanBeThrownAway) {
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
  thread_.send(OpenFile{first, true, OpenFile::Left::put_aside});
  settle();
  thread_.send(DropProject{first});  // it is open
  settle();
  EXPECT_EQ(errors().size(), 1U);
  thread_.send(EndProject{false});
  thread_.send(OpenFile{first});
  settle();
  EXPECT_FALSE(thread_.state().has_clay);
  ASSERT_TRUE(thread_.state().left);
  EXPECT_EQ(thread_.state().left->left.steps, 0U);
  thread_.send(DropProject{first});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_FALSE(thread_.state().left);
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

TEST_F(DocumentThreadTest, AFullDiskLeavesWhatLayUnderTheNameAsItWas) {
  const auto there = folder_ / "there.vdb";
  ASSERT_TRUE(io::save_project(there, Clay::block({9.0, 8.0, 7.0}, {}).value()).ok());
  const std::uint64_t hash = io::load_project(there).value().hash();
  thread_.send(NewClay{ball(20.0)});
  settle();
  const std::uintmax_t start_bytes = std::filesystem::file_size(thread_.state().file);
  for (int n = -5; n <= 5; ++n) stroke({19.0, 3.0 * n, -12.0}, {19.0, 3.0 * n, 12.0});
  const auto saved = folder_ / "saved.vdb";
  thread_.send(SaveProjectAs{saved});
  settle();
  const std::uintmax_t bytes = std::filesystem::file_size(saved);
  ASSERT_GT(bytes, start_bytes + 20'000);
  {
    const FullDisk disk((start_bytes + bytes) / 2);  // room for the start, not for the rest
    for (const char* const name : {"there.vdb", "fresh.vdb"}) {
      thread_.send(SaveProjectAs{folder_ / name});
      settle();
      EXPECT_FALSE(errors().empty()) << name;
    }
  }
  EXPECT_EQ(io::load_project(there).value().hash(), hash);
  EXPECT_EQ(thread_.state().file, saved);
  EXPECT_EQ(thread_.state().undo_depth, 11);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "fresh.vdb"));
  for (const std::string& name : folder_.names()) {
    EXPECT_EQ(name.find("former"), std::string::npos) << name;
    EXPECT_FALSE(name.starts_with("fresh.")) << name;
  }
  // And with room it is saved, and nothing else lies about.
  thread_.send(SaveProjectAs{there});
  settle();
  EXPECT_EQ(thread_.state().file, there);
  EXPECT_NE(io::load_project(there).value().hash(), hash);
  for (const std::string& name : folder_.names()) {
    EXPECT_EQ(name.find("former"), std::string::npos) << name;
  }
}

TEST_F(DocumentThreadTest, WhatWasMeantForASavedClayIsNotDoneWithoutAndNotComplainedAbout) {
  thread_.send(NewClay{ball(20.0)});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  thread_.send(SaveProjectAs{folder_ / "no folder" / "p.vdb", true});
  thread_.send(EndProject{true});
  settle();
  EXPECT_EQ(errors().size(), 1U);
  EXPECT_EQ(thread_.state().undo_depth, 1);
  thread_.send(EndProject{true});  // was not meant for it
  settle();
  EXPECT_EQ(errors().size(), 1U);
}

}  // namespace
}  // namespace argil::viewer
