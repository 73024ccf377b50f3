// SPDX-License-Identifier: GPL-3.0-or-later
// Undo of steps of before a project was opened, and when a project counts as changed.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/io/project_file.h"
#include "argil/io/session.h"

#include "viewer/document/document_fixture.h"

namespace argil::viewer {
namespace {

class DocumentHistoryTest : public DocumentThreadTest {
 protected:
  std::filesystem::path project() const { return folder_ / "p.vdb"; }

  static std::uint64_t hash_of(const std::filesystem::path& file) {
    const auto opened = io::open_project(file);
    EXPECT_TRUE(opened.ok());
    return opened ? opened.value().sculpture.hash() : 0;
  }
  void undo() { thread_.send(DoStep{io::HistoryStep::undo}); }
  void redo() { thread_.send(DoStep{io::HistoryStep::redo}); }

  /// What the clay is now, as a file of that name has it. The project goes on under its own.
  std::uint64_t hash_now() {
    thread_.send(SaveProject{});
    settle();
    return io::load_project(project()).value().hash();
  }

  /// A project of a stroke, a cut and a stroke that was taken back, which is closed.
  void make_and_close() {
    thread_.send(NewClay{ball(20.0)});
    stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
    thread_.send(SaveProjectAs{project()});
    settle();
    hashes_.push_back(io::load_project(project()).value().hash());
    thread_.send(DoStep{Operation(Cut{{0.0, 0.0, -15.0}, {0.0, 0.0, 1.0}, true})});
    hashes_.push_back(hash_now());
    stroke({0.0, 19.0, -3.0}, {0.0, 19.0, 3.0});
    hashes_.push_back(hash_now());
    undo();
    thread_.send(SaveProject{});
    thread_.send(EndProject{true});
    settle();
    ASSERT_TRUE(errors().empty());
    ASSERT_FALSE(thread_.state().has_clay);
  }

  std::vector<std::uint64_t> hashes_;  ///< after one step, two, three
};

TEST_F(DocumentHistoryTest, GoesOnAfterTheProjectWasClosed) {
  make_and_close();
  thread_.send(OpenFile{project()});
  settle();
  ClayState state = thread_.state();
  EXPECT_FALSE(state.left);
  EXPECT_FALSE(state.is_changed);
  EXPECT_EQ(state.undo_depth, 0);
  EXPECT_TRUE(state.has_older_steps);
  ASSERT_TRUE(state.steps);
  EXPECT_EQ(state.steps->names, (std::vector<std::string>{"Add, 2 mm", "Cut", "Add, 2 mm"}));
  EXPECT_EQ(state.steps->done, 2U);
  EXPECT_EQ(state.steps->older, 2U);
  EXPECT_FALSE(state.steps->has_unread);
  EXPECT_EQ(state.steps->kept.steps, 4U);
  EXPECT_GT(state.steps->kept.bytes, 1000U);

  undo();
  settle();
  state = thread_.state();
  EXPECT_TRUE(state.is_changed);
  EXPECT_EQ(state.undo_depth, 1);
  EXPECT_FALSE(state.has_older_steps);
  EXPECT_EQ(state.steps->done, 1U);
  EXPECT_EQ(hash_now(), hashes_[0]);
  thread_.send(GoToStep{3});
  EXPECT_EQ(hash_now(), hashes_[2]) << "a step that was taken back before it was closed";
  thread_.send(GoToStep{0});
  EXPECT_EQ(hash_now(), Clay::ball(20.0, {}).value().hash());
  EXPECT_TRUE(errors().empty());
}

TEST_F(DocumentHistoryTest, GoesOnFromTheListAndByRedo) {
  make_and_close();
  thread_.send(OpenFile{project()});
  settle();
  redo();
  EXPECT_EQ(hash_now(), hashes_[2]);
  redo();
  settle();
  const std::vector<Notice> told = thread_.take_notices();
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back().text, "there is nothing to redo");
}

TEST_F(DocumentHistoryTest, NewStepsComeBehindTheOlderOnes) {
  make_and_close();
  thread_.send(OpenFile{project()});
  stroke({-19.0, -3.0, 0.0}, {-19.0, 3.0, 0.0});  // before their names are read
  settle();
  EXPECT_EQ(thread_.state().steps->names.size(), 3U);
  EXPECT_EQ(thread_.state().steps->done, 3U);
  EXPECT_EQ(thread_.state().steps->older, 2U);
  EXPECT_TRUE(thread_.state().is_changed);
  undo();
  settle();
  EXPECT_FALSE(thread_.state().is_changed);
  EXPECT_TRUE(thread_.state().has_older_steps) << "nothing was read for that";
  undo();
  EXPECT_EQ(hash_now(), hashes_[0]);
}

TEST_F(DocumentHistoryTest, ThatCannotBeReadIsSaidOnceAndThenThereIsNothingToUndo) {
  make_and_close();
  ASSERT_TRUE(io::save_project(folder_ / ".p.origin.vdb", Clay::ball(9.0, {}).value()).ok());
  thread_.send(OpenFile{project()});
  settle();
  undo();
  settle();
  const std::vector<std::string> said = errors();
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find("undo ends where 'p.vdb' was opened"), std::string::npos) << said[0];
  EXPECT_FALSE(thread_.state().has_older_steps);
  EXPECT_TRUE(thread_.state().steps->names.empty());
  undo();
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_EQ(hash_of(project()), hashes_[1]);
}

TEST_F(DocumentHistoryTest, IsDroppedWhenTheUserWantsIt) {
  make_and_close();
  thread_.send(OpenFile{project()});
  settle();
  stroke({-19.0, -3.0, 0.0}, {-19.0, 3.0, 0.0});
  thread_.send(ForgetHistory{});
  settle();
  EXPECT_EQ(errors().size(), 1U) << "it has changes that are not saved";
  const std::uint64_t now = hash_now();
  thread_.send(ForgetHistory{});
  settle();
  EXPECT_TRUE(errors().empty());
  EXPECT_EQ(thread_.state().undo_depth, 0);
  EXPECT_TRUE(thread_.state().steps->names.empty());
  EXPECT_EQ(thread_.state().steps->kept.steps, 0U);
  EXPECT_FALSE(thread_.state().is_changed);
  EXPECT_EQ(io::load_project(project()).value().hash(), now);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "p.journal.jsonl"));
}

TEST_F(DocumentHistoryTest, AProjectIsAsSavedWhereverUndoAndRedoMeetTheSave) {
  thread_.send(NewClay{ball(20.0)});
  thread_.send(SaveProjectAs{project()});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  thread_.send(SaveProject{});
  const auto is_changed = [&] {
    settle();
    return thread_.state().is_changed;
  };
  EXPECT_FALSE(is_changed());
  stroke({0.0, 19.0, -3.0}, {0.0, 19.0, 3.0});
  EXPECT_TRUE(is_changed());
  undo();
  EXPECT_FALSE(is_changed());
  undo();
  EXPECT_TRUE(is_changed()) << "before the save";
  redo();
  EXPECT_FALSE(is_changed());
  redo();
  EXPECT_TRUE(is_changed());
  undo();
  undo();
  stroke({0.0, 19.0, -3.0}, {0.0, 19.0, 3.0});
  EXPECT_TRUE(is_changed()) << "another step in its place is another clay";
  undo();
  EXPECT_TRUE(is_changed());
  thread_.send(DoStep{PieceEdit{CopyPiece{"Clay", "Other"}}});
  thread_.send(SaveProject{});
  EXPECT_FALSE(is_changed());
  for (const char* name : {"Other", "Clay"}) {
    thread_.send(DoStep{PieceEdit{SelectPiece{name}}});
    EXPECT_FALSE(is_changed()) << "which one is at hand is no work";
  }
}

TEST_F(DocumentHistoryTest, WithoutANameLeavesNothingInTheHome) {
  thread_.send(NewClay{ball(20.0)});
  stroke({19.0, -3.0, 0.0}, {19.0, 3.0, 0.0});
  thread_.send(EndProject{false});
  settle();
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "unsaved"));
}

}  // namespace
}  // namespace argil::viewer
