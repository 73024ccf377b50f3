// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/session.h"

#include <chrono>
#include <csignal>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include "argil/io/project_file.h"

#include "readers/project/small_session.h"
#include "support/built.h"
#include "support/effort.h"
#include "support/scratch.h"
#include "support/session_life.h"
#include "support/spawn.h"
#include "support/stroke_maker.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::fill;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

/// A folder with piece.vdb, and sessions that end as after a kill when they go out of scope.
class SessionFolder : public testing::Test {
 protected:
  fs::path file(const std::string& name = "piece.vdb") const { return folder_ / name; }

  static SessionOptions no_autosave() {
    SessionOptions options;
    options.autosave_steps = 0;
    return options;
  }

  Session create() const {
    auto session = Session::create(file(), small_clay(), no_autosave());
    EXPECT_TRUE(session) << session.error().message;
    return std::move(session).value();
  }
  Session open() const {
    auto session = Session::open(file(), no_autosave());
    EXPECT_TRUE(session) << session.error().message;
    return std::move(session).value();
  }

  static void sculpt(Session& session, const ScriptStep& step) {
    const auto done = apply_step(session.sculpture(), step);
    ASSERT_TRUE(done) << done.error().message;
    session.record(step);
  }
  static void sculpt(Session& session, unsigned first, unsigned count) {
    for (unsigned n = first; n < first + count; ++n) sculpt(session, small_stroke(n));
  }
  /// A clay with strokes 0 to `count - 1` on the start.
  static std::uint64_t hash_after(unsigned count) {
    static Clay clay = small_clay();
    static std::vector<std::uint64_t> hashes{clay.hash()};
    while (hashes.size() <= count) {
      EXPECT_TRUE(clay.apply(small_stroke(static_cast<unsigned>(hashes.size()) - 1)));
      hashes.push_back(clay.hash());
    }
    return hashes[count];
  }

  test::ScratchFolder folder_;
};

using SessionJournal = SessionFolder;
using SessionLock = SessionFolder;
using SessionSave = SessionFolder;
using SessionDisk = SessionFolder;

TEST_F(SessionJournal, BringsEveryStrokeBackWithTheSameBits) {
  {
    Session session = create();
    sculpt(session, 0, 4);
    ASSERT_TRUE(session.flush());
  }
  EXPECT_THAT(folder_.names(), UnorderedElementsAre("piece.vdb", "piece.journal.jsonl"));
  const auto opened = open_project(file());
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened.value().sculpture.hash(), hash_after(4));
  EXPECT_EQ(opened.value().recovered_steps, 4);
  EXPECT_THAT(lines_of(opened.value().notes), HasSubstr("'piece.vdb': recovered 4 strokes"));
  Session session = open();
  EXPECT_EQ(session.recovered_steps(), 4);
  sculpt(session, 4, 1);
  ASSERT_TRUE(session.close());
  EXPECT_THAT(folder_.names(), ElementsAre("piece.vdb"));
  EXPECT_EQ(load_project(file()).value().hash(), hash_after(5));
}

TEST_F(SessionJournal, IsAScriptThatSculptsTheSame) {
  Session session = create();
  sculpt(session, 0, 2);
  sculpt(session, HistoryStep::undo);
  ASSERT_TRUE(session.save());
  const auto script = read_stroke_script(file("piece.journal.jsonl"));
  ASSERT_TRUE(script) << script.error().message;
  Clay clay = small_clay();
  for (const ScriptStep& step : script.value().steps) ASSERT_TRUE(apply_step(clay, step));
  EXPECT_EQ(clay.hash(), session.clay().hash());
}

TEST_F(SessionJournal, LeavesOutALineThatWasCutOffAtAnyLength) {
  {
    Session session = create();
    sculpt(session, 0, 2);
    ASSERT_TRUE(session.flush());
  }
  const std::string whole = content_of(file("piece.journal.jsonl"));
  const std::size_t header = whole.find('\n') + 1;
  const std::size_t first = whole.find('\n', header) + 1;
  for (std::size_t length = 0; length < whole.size(); length += test::effort(26U, 13U)) {
    fill(file("piece.journal.jsonl"), whole.substr(0, length));
    const auto opened = open_project(file());
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ(opened.value().recovered_steps, length >= first ? 1 : 0) << length;
    EXPECT_EQ(content_of(file("piece.journal.jsonl")).size(), length) << "reading changed it";
  }
  fill(file("piece.journal.jsonl"), whole.substr(0, whole.size() - 5));
  Session session = open();
  EXPECT_THAT(lines_of(session.notes()), HasSubstr("was cut off when the program ended"));
  sculpt(session, 1, 1);
  ASSERT_TRUE(session.flush());
  EXPECT_EQ(content_of(file("piece.journal.jsonl")), whole);
}

TEST_F(SessionJournal, KeepsADamagedOneAsideAndUsesWhatIsBefore) {
  {
    Session session = create();
    sculpt(session, 0, 3);
    ASSERT_TRUE(session.flush());
  }
  std::string damaged = content_of(file("piece.journal.jsonl"));
  std::size_t second = damaged.find('\n') + 1;
  second = damaged.find('\n', second) + 1;
  const std::size_t digit = damaged.find("\"spacing\":0.", second) + 12;
  damaged[digit] = damaged[digit] == '3' ? '4' : '3';  // still JSON, still in range
  fill(file("piece.journal.jsonl"), damaged);
  {
    Session session = open();
    EXPECT_EQ(session.clay().hash(), hash_after(1));
    EXPECT_THAT(lines_of(session.notes()),
                AllOf(HasSubstr("piece.journal.jsonl:3: key 'xxh64' is"),
                      HasSubstr("is kept as 'piece.journal.jsonl.damaged-1'")));
    sculpt(session, 1, 1);
    ASSERT_TRUE(session.flush());
  }
  EXPECT_EQ(content_of(file("piece.journal.jsonl.damaged-1")), damaged);
  EXPECT_EQ(open_project(file()).value().sculpture.hash(), hash_after(2));
}

TEST_F(SessionJournal, OfAnotherProjectIsKeptAside) {
  {
    Session session = create();
    sculpt(session, 0, 2);
    ASSERT_TRUE(session.flush());
  }
  const std::string journal = content_of(file("piece.journal.jsonl"));
  const Clay other = Clay::ball(5.0, {0.4, 0.1}).value();
  ASSERT_TRUE(save_project(file(), other));
  const auto read = open_project(file());
  EXPECT_EQ(read.value().sculpture.hash(), other.hash());
  EXPECT_THAT(lines_of(read.value().notes), HasSubstr("does not belong to 'piece.vdb'"));
  Session session = open();
  EXPECT_EQ(session.clay().hash(), other.hash());
  EXPECT_EQ(content_of(file("piece.journal.jsonl.foreign-1")), journal);
  ASSERT_TRUE(session.close());
  EXPECT_THAT(folder_.names(), UnorderedElementsAre("piece.vdb", "piece.journal.jsonl.foreign-1"));
}

TEST_F(SessionJournal, NeverTakesAnotherFileForItsOwn) {
  ASSERT_TRUE(save_project(file(), small_clay()));
  for (const char* text : {"my notes", "my notes\n", "{\"argil_strokes\":1}\n"}) {
    fill(file("piece.journal.jsonl"), text);
    { Session session = open(); }
    EXPECT_FALSE(fs::exists(file("piece.journal.jsonl")));
    EXPECT_EQ(content_of(file("piece.journal.jsonl.foreign-1")), text);
    fs::remove(file("piece.journal.jsonl.foreign-1"));
  }
}

TEST_F(SessionLock, NamesWhoHoldsTheProject) {
  Session session = create();
  const auto second = Session::open(file());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(second.error().message,
              HasSubstr("'piece.vdb' is being sculpted by process " + std::to_string(::getpid())));
  EXPECT_FALSE(replace_project(file(), small_clay()));
  EXPECT_TRUE(open_project(file())) << "reading needs no lock";
}

TEST_F(SessionLock, OfAKilledProgramStopsNobody) {
  ASSERT_TRUE(save_project(file(), small_clay()));
  int pipe[2] = {-1, -1};
  ASSERT_EQ(::pipe(pipe), 0);
  const pid_t child = test::spawn(test::session_child_program(),
                                  {file().string(), "1", std::to_string(pipe[1]), "waits"});
  ::close(pipe[1]);  // so that a child that ends is noticed
  std::uint32_t ready = 0;
  ASSERT_EQ(::read(pipe[0], &ready, sizeof ready), sizeof ready);
  ::close(pipe[0]);
  EXPECT_FALSE(Session::open(file()));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(fs::exists(file("piece.lock")));
  EXPECT_TRUE(Session::open(file()));
  EXPECT_FALSE(fs::exists(file("piece.lock")));
}

TEST_F(SessionSave, LetsUndoReachBehindIt) {
  {
    Session session = create();
    sculpt(session, 0, 3);
    ASSERT_TRUE(session.save());
    EXPECT_EQ(load_project(file()).value().hash(), hash_after(3));
    sculpt(session, HistoryStep::undo);
    sculpt(session, HistoryStep::undo);
    ASSERT_TRUE(session.flush());
  }
  const auto opened = open_project(file());
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened.value().sculpture.hash(), hash_after(1));
  Session session = open();
  ASSERT_TRUE(session.close());
  EXPECT_THAT(folder_.names(), ElementsAre("piece.vdb"));
}

TEST_F(SessionSave, OfAStateThatWasThereBeforeLetsRedoReachBehindIt) {
  {
    Session session = create();
    sculpt(session, 0, 1);
    sculpt(session, HistoryStep::undo);
    ASSERT_TRUE(session.save());
    sculpt(session, HistoryStep::redo);
    ASSERT_TRUE(session.flush());
  }
  const auto opened = open_project(file());
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened.value().sculpture.hash(), hash_after(1));
}

TEST_F(SessionSave, RepeatsOnlyWhatCameAfter) {
  {
    Session session = create();
    sculpt(session, 0, 3);
    ASSERT_TRUE(session.save());
    sculpt(session, 3, 2);
    ASSERT_TRUE(session.flush());
  }
  const auto opened = open_project(file());
  EXPECT_EQ(opened.value().recovered_steps, 2);
  EXPECT_EQ(opened.value().sculpture.hash(), hash_after(5));
}

TEST_F(SessionSave, DiscardLeavesTheFilesAsTheyWere) {
  {
    Session session = create();
    sculpt(session, 0, 2);
    ASSERT_TRUE(session.flush());
  }
  const std::string journal = content_of(file("piece.journal.jsonl"));
  Session session = open();
  sculpt(session, 2, 2);
  ASSERT_TRUE(session.discard());
  EXPECT_EQ(content_of(file("piece.journal.jsonl")), journal);
  EXPECT_EQ(open_project(file()).value().sculpture.hash(), hash_after(2));
  fs::remove(file());
  fs::remove(file("piece.journal.jsonl"));
  Session fresh = create();
  sculpt(fresh, 0, 1);
  ASSERT_TRUE(fresh.discard());
  EXPECT_THAT(folder_.names(), ElementsAre());
}

TEST_F(SessionSave, DiscardForgetsWhatCameAfterIt) {
  Session session = create();
  sculpt(session, 0, 2);
  ASSERT_TRUE(session.save());
  sculpt(session, 2, 2);
  ASSERT_TRUE(session.discard());
  EXPECT_THAT(folder_.names(), ElementsAre("piece.vdb"));
  EXPECT_EQ(open_project(file()).value().sculpture.hash(), hash_after(2));
}

using SessionSaveAs = SessionFolder;

TEST_F(SessionSaveAs, GoesOnUnderTheNameAndLeavesTheOldProjectAsItWasSaved) {
  {
    Session session = create();
    sculpt(session, 0, 3);
    ASSERT_TRUE(session.save());
    sculpt(session, 3, 2);
    const auto saved = session.save_as(file("other.vdb"));
    ASSERT_TRUE(saved) << saved.error().message;
    EXPECT_TRUE(saved.value().keeps_undo);
    EXPECT_THAT(saved.value().notes, ElementsAre());
    EXPECT_EQ(session.step_count(), 5U);
    EXPECT_THAT(folder_.names(), UnorderedElementsAre("piece.vdb", "other.vdb", "other.lock",
                                                      ".other.origin.vdb", "other.journal.jsonl"));
    EXPECT_EQ(load_project(file()).value().hash(), hash_after(3));
    EXPECT_EQ(load_project(file("other.vdb")).value().hash(), hash_after(5));
    EXPECT_FALSE(left_steps(file("other.vdb")).value());
    for (int n = 0; n < 3; ++n) sculpt(session, HistoryStep::undo);  // behind both saves
    ASSERT_TRUE(session.flush());
  }
  const auto opened = open_project(file("other.vdb"));
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened.value().sculpture.hash(), hash_after(2));
  auto session = Session::open(file("other.vdb"));
  ASSERT_TRUE(session && session.value().close());
  EXPECT_THAT(folder_.names(), UnorderedElementsAre("piece.vdb", "other.vdb"));
}

TEST_F(SessionSaveAs, LeavesRecoveredStepsOfTheOldProjectBesideIt) {
  {
    Session session = create();
    sculpt(session, 0, 2);
  }
  Session session = open();
  sculpt(session, 2, 1);
  ASSERT_TRUE(session.save_as(file("other.vdb")));
  EXPECT_EQ(open_project(file()).value().sculpture.hash(), hash_after(2));
  EXPECT_EQ(load_project(file("other.vdb")).value().hash(), hash_after(3));
  ASSERT_TRUE(session.discard());
  EXPECT_EQ(load_project(file("other.vdb")).value().hash(), hash_after(3));
}

TEST_F(SessionSaveAs, TakesAlongWhatStepsWorkWith) {
  std::uint64_t hash = 0;
  {
    Session session = create();
    Stroke rod = small_stroke(0);
    rod.tool = {Action::add, Shape::mesh, {3.0, 1.5, 1.5}, 1.0};
    rod.tool.mesh = test::rod_tool(true);
    for (const Action action : {Action::add, Action::carve}) {
      rod.tool.action = action;
      sculpt(session, rod);
    }
    hash = session.clay().hash();
    ASSERT_TRUE(session.save_as(file("other.vdb")));
    sculpt(session, HistoryStep::undo);
    sculpt(session, HistoryStep::redo);
    ASSERT_TRUE(session.flush());
    EXPECT_THAT(lines_of(folder_.names()),
                AllOf(HasSubstr(".other.solid-"), testing::Not(HasSubstr(".piece.solid-"))));
  }
  EXPECT_EQ(open_project(file("other.vdb")).value().sculpture.hash(), hash);
}

TEST_F(SessionSaveAs, KeepsTheLeftStepsOfWhatItReplacesAndTouchesNoneInASession) {
  ASSERT_TRUE(save_project(file("other.vdb"), Clay::ball(5.0, {0.4, 0.1}).value()));
  Session session = create();
  sculpt(session, 0, 1);
  {
    auto other = Session::open(file("other.vdb"));
    ASSERT_TRUE(other);
    sculpt(other.value(), 7, 1);
    const auto refused = session.save_as(file("other.vdb"));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
  }
  const auto saved = session.save_as(file("other.vdb"));
  ASSERT_TRUE(saved) << saved.error().message;
  EXPECT_THAT(lines_of(saved.value().notes), HasSubstr("'other.journal.jsonl.replaced-1'"));
  EXPECT_EQ(load_project(file("other.vdb")).value().hash(), hash_after(1));
  EXPECT_TRUE(fs::exists(file()));
}

TEST_F(SessionSaveAs, SavesWithoutUndoWhereTheStepsAreGone) {
  {
    Session session = create();
    sculpt(session, 0, 3);
    ASSERT_TRUE(session.flush());
    fs::remove(file("piece.journal.jsonl"));
    const auto saved = session.save_as(file("other.vdb"));
    ASSERT_TRUE(saved) << saved.error().message;
    EXPECT_FALSE(saved.value().keeps_undo);
    EXPECT_THAT(lines_of(saved.value().notes), HasSubstr("undo ends at the save"));
    EXPECT_EQ(session.clay().undo_depth(), 0);
    EXPECT_EQ(session.clay().hash(), hash_after(3));
    sculpt(session, 3, 1);
    ASSERT_TRUE(session.flush());
  }
  EXPECT_EQ(open_project(file("other.vdb")).value().sculpture.hash(), hash_after(4));
}

TEST_F(SessionSaveAs, ThatCannotBeWrittenChangesNothing) {
  Session session = create();
  sculpt(session, 0, 2);
  EXPECT_FALSE(session.save_as(file("no folder") / "other.vdb"));
  fs::create_directories(file("other.vdb") / "in the way");
  EXPECT_FALSE(session.save_as(file("other.vdb")));
  EXPECT_THAT(folder_.names(),
              UnorderedElementsAre("piece.vdb", "piece.lock", "other.vdb", "piece.journal.jsonl"));
  sculpt(session, 2, 1);
  ASSERT_TRUE(session.close());
  EXPECT_EQ(load_project(file()).value().hash(), hash_after(3));
}

TEST_F(SessionSave, AutosaveIsWhereARecoveryStarts) {
  SessionOptions often;
  often.autosave_steps = 4;
  often.autosave_leaves = 10;  // so that a copy takes several steps
  {
    auto session = Session::create(file(), small_clay(), often);
    ASSERT_TRUE(session) << session.error().message;
    for (unsigned n = 0; n < 400 && !fs::exists(file(".piece.autosave.vdb")); ++n) {
      sculpt(session.value(), n, 1);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ASSERT_TRUE(session.value().flush());
    ASSERT_TRUE(session.value().problem());
    ASSERT_TRUE(fs::exists(file(".piece.autosave.vdb")));
  }
  const auto script = read_stroke_script(file("piece.journal.jsonl"));
  ASSERT_TRUE(script) << script.error().message;
  const auto steps = static_cast<unsigned>(script.value().steps.size());
  const auto opened = open_project(file());
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened.value().sculpture.hash(), hash_after(steps));
  EXPECT_EQ(opened.value().recovered_steps, steps);
  EXPECT_LT(opened.value().sculpture.clay().undo_depth(), static_cast<int>(steps))
      << "all was repeated";
}

Stroke mask_stroke(unsigned n) {
  Stroke stroke = small_stroke(n);
  stroke.tool.action = Action::mask;
  stroke.tool.strength = n % 3 == 2 ? -0.7 : 0.7;
  return stroke;
}

TEST_F(SessionJournal, RepeatsWhatWasMaskedAndWhatThatHeld) {
  std::uint64_t hash = 0;
  {
    Session session = create();
    for (unsigned n = 0; n < 4; ++n) {
      sculpt(session, mask_stroke(n));
      sculpt(session, small_stroke(50 + n));
    }
    for (const MaskEdit edit : {MaskEdit::invert, MaskEdit::blur}) sculpt(session, edit);
    sculpt(session, 60, 2);
    sculpt(session, MaskEdit::fill);
    sculpt(session, HistoryStep::undo);
    ASSERT_TRUE(session.flush());
    ASSERT_TRUE(session.clay().has_mask());
    hash = session.clay().hash();
  }
  Session session = open();
  EXPECT_EQ(session.recovered_steps(), 14);
  EXPECT_EQ(session.clay().hash(), hash);
  ASSERT_TRUE(session.close());
  EXPECT_EQ(load_project(file()).value().hash(), hash);
}

TEST_F(SessionDisk, GoesOnWhenFullAndCatchesUpWhenThereIsRoom) {
  const fs::path disk = file("disk");
  fs::create_directory(disk);
  if (::mount("argil", disk.c_str(), "tmpfs", 0, "size=2m") != 0) {
    GTEST_SKIP() << "mounting a small tmpfs needs root; SessionKillsSlow fills the disk without";
  }
  {
    auto created = Session::create(disk / "piece.vdb", small_clay(), no_autosave());
    ASSERT_TRUE(created) << created.error().message;
    Session& session = created.value();
    sculpt(session, 0, 1);
    ASSERT_TRUE(session.flush());
    fill(disk / "filler", std::string(4 << 20, 'x'));  // as much of it as there is room for
    Stroke lengthy = small_stroke(1);
    lengthy.samples.resize(2000, lengthy.samples.back());
    sculpt(session, lengthy);
    const auto full = session.flush();
    ASSERT_FALSE(full);
    EXPECT_THAT(full.error().message, HasSubstr("free some space"));
    EXPECT_FALSE(session.problem());
    EXPECT_FALSE(session.save());
    for (unsigned n = 2; n < 100; ++n) session.record(small_stroke(n));  // more than the queue
    EXPECT_FALSE(session.flush());
    fs::remove(disk / "filler");
    EXPECT_TRUE(session.flush());
    EXPECT_TRUE(session.problem());
    const auto script = read_stroke_script(disk / "piece.journal.jsonl");
    EXPECT_TRUE(script && script.value().steps.size() == 100);
  }
  ::umount(disk.c_str());
}

}  // namespace
}  // namespace argil::io
