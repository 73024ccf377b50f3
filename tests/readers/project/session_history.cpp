// SPDX-License-Identifier: GPL-3.0-or-later
// What a session leaves for undo when it ends in order, and how the next one reads it.
#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/core/hash_text.h"
#include "argil/io/project_file.h"
#include "argil/io/session.h"

#include "readers/project/small_session.h"
#include "script/script_line.h"
#include "support/effort.h"
#include "support/scratch.h"
#include "support/session_life.h"
#include "support/stroke_maker.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::fill;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

/// A folder with piece.vdb, whose sessions keep their history.
class SessionHistory : public testing::Test {
 protected:
  fs::path file(const std::string& name = "piece.vdb") const { return folder_ / name; }

  static SessionOptions keeping() {
    SessionOptions options;
    options.autosave_steps = 0;
    options.keeps_history = true;
    return options;
  }

  Session create(const SessionOptions& options = keeping()) const {
    auto session = Session::create(file(), small_clay(), options);
    EXPECT_TRUE(session) << session.error().message;
    return std::move(session).value();
  }
  Session open(const SessionOptions& options = keeping()) const {
    auto session = Session::open(file(), options);
    EXPECT_TRUE(session) << session.error().message;
    return std::move(session).value();
  }

  /// Does a step and remembers the hash behind it.
  void sculpt(Session& session, const ScriptStep& step) {
    if (hashes_.empty()) hashes_.push_back(session.sculpture().hash());
    const auto done = apply_step(session.sculpture(), step);
    ASSERT_TRUE(done) << done.error().message;
    session.record(step);
    hashes_.push_back(session.sculpture().hash());
  }
  void sculpt(Session& session, unsigned first, unsigned count) {
    for (unsigned n = first; n < first + count; ++n) sculpt(session, small_stroke(n));
  }

  /// A session that does a few things of each kind, and ends.
  void work_and_close() {
    Session session = create();
    sculpt(session, 0, 3);
    ASSERT_TRUE(session.save());
    sculpt(session, Operation(Cut{{0.0, 0.0, 4.0}, {0.0, 0.0, 1.0}, true}));
    Stroke rod = small_stroke(9);
    rod.tool = {Action::add, Shape::mesh, {3.0, 1.5, 1.5}, 1.0};
    rod.tool.mesh = test::rod_tool(true);
    sculpt(session, rod);
    Stroke mask = small_stroke(10);
    mask.tool.action = Action::mask;
    sculpt(session, mask);
    sculpt(session, MaskEdit::invert);
    ASSERT_TRUE(session.close());
  }

  /// Undo down to the start, each state by its hash.
  void expect_each_earlier_state(Session& session, std::size_t from) {
    for (std::size_t n = from; n-- > 0;) {
      ASSERT_TRUE(session.sculpture().undo()) << "to state " << n;
      session.record(HistoryStep::undo);
      EXPECT_EQ(session.sculpture().hash(), hashes_[n]) << "state " << n;
    }
    EXPECT_FALSE(session.sculpture().undo());
    EXPECT_THAT(session.clay().validate(), testing::IsEmpty());
  }

  test::ScratchFolder folder_;
  std::vector<std::uint64_t> hashes_;
};

TEST_F(SessionHistory, LeadsBackToEachStateOfBeforeTheProjectWasClosed) {
  work_and_close();
  EXPECT_FALSE(fs::exists(file("piece.lock")));
  EXPECT_TRUE(fs::exists(file("piece.journal.jsonl")));
  EXPECT_TRUE(fs::exists(file(".piece.origin.vdb")));
  EXPECT_EQ(load_project(file()).value().hash(), hashes_.back());
  EXPECT_FALSE(left_steps(file()).value());

  Session session = open();
  EXPECT_EQ(session.recovered_steps(), 0);
  EXPECT_THAT(session.notes(), ElementsAre());
  EXPECT_EQ(session.sculpture().undo_depth(), 0) << "read only when it is wanted";
  ASSERT_TRUE(session.has_older_steps());
  EXPECT_EQ(session.history_size().steps, 7U);
  EXPECT_GT(session.history_size().bytes, fs::file_size(file(".piece.origin.vdb")));
  EXPECT_EQ(session.told_steps().value().size(), 7U);

  const Clay* clay = &session.clay();
  const auto deepened = session.deepen();
  ASSERT_TRUE(deepened) << deepened.error().message;
  EXPECT_EQ(&session.clay(), clay) << "what is shown stays what it is";
  EXPECT_FALSE(session.has_older_steps());
  EXPECT_EQ(session.clay().hash(), hashes_.back());
  expect_each_earlier_state(session, 7);
  for (std::size_t n = 1; n < hashes_.size(); ++n) {
    ASSERT_TRUE(session.sculpture().redo());
    session.record(HistoryStep::redo);
    EXPECT_EQ(session.clay().hash(), hashes_[n]);
  }
}

TEST_F(SessionHistory, TakesBackNewStepsFirst) {
  work_and_close();
  Session session = open();
  sculpt(session, 20, 2);
  EXPECT_EQ(session.sculpture().undo_depth(), 2);
  ASSERT_TRUE(session.sculpture().undo());
  session.record(HistoryStep::undo);
  ASSERT_TRUE(session.deepen());
  EXPECT_EQ(session.sculpture().redo_depth(), 1);
  expect_each_earlier_state(session, 8);
}

TEST_F(SessionHistory, KeepsWhatCanBeRepeated) {
  {
    Session session = create();
    sculpt(session, 0, 3);
    for (int n = 0; n < 2; ++n) sculpt(session, HistoryStep::undo);
    ASSERT_TRUE(session.close());
  }
  Session session = open();
  EXPECT_FALSE(session.sculpture().redo());
  ASSERT_TRUE(session.deepen());
  for (std::size_t n : {2U, 3U}) {
    ASSERT_TRUE(session.sculpture().redo());
    EXPECT_EQ(session.sculpture().hash(), hashes_[n]);
  }
}

TEST_F(SessionHistory, LosesNoUndoOfAKilledSession) {
  work_and_close();
  {
    Session session = open();
    sculpt(session, 20, 1);
    ASSERT_TRUE(session.deepen());
    for (int n = 0; n < 4; ++n) {
      ASSERT_TRUE(session.sculpture().undo());
      session.record(HistoryStep::undo);
    }
    ASSERT_TRUE(session.flush());
  }  // as after a kill
  Session session = open();
  EXPECT_EQ(session.recovered_steps(), 5);
  EXPECT_EQ(session.sculpture().hash(), hashes_[4]);
  expect_each_earlier_state(session, 4);
}

TEST_F(SessionHistory, GoesOnOverManySessions) {
  for (unsigned n = 0; n < 4; ++n) {
    Session session = n == 0 ? create() : open();
    sculpt(session, n, 1);
    // Without the option it goes on where one was kept.
    if (n % 2 == 0) {
      ASSERT_TRUE(session.save());
    }
    ASSERT_TRUE(session.close());
  }
  SessionOptions plain;
  plain.autosave_steps = 0;
  {
    Session session = open(plain);
    sculpt(session, 4, 1);
    ASSERT_TRUE(session.close());
  }
  Session session = open(plain);
  ASSERT_TRUE(session.deepen());
  expect_each_earlier_state(session, 5);
}

TEST_F(SessionHistory, WithoutTheOptionLeavesTheProjectAlone) {
  SessionOptions plain;
  plain.autosave_steps = 0;
  Session session = create(plain);
  sculpt(session, 0, 2);
  ASSERT_TRUE(session.save());
  ASSERT_TRUE(session.close());
  EXPECT_THAT(folder_.names(), ElementsAre("piece.vdb"));
}

TEST_F(SessionHistory, OfNothingIsNothing) {
  {
    Session session = create();
    ASSERT_TRUE(session.close());
  }
  Session session = open();
  EXPECT_FALSE(session.has_older_steps());
  ASSERT_TRUE(session.close());
  EXPECT_THAT(folder_.names(), ElementsAre("piece.vdb"));
}

TEST_F(SessionHistory, OfAProjectThatAnotherProgramReplacedIsPutAside) {
  work_and_close();
  const Clay other = Clay::ball(5.0, {0.4, 0.1}).value();
  ASSERT_TRUE(save_project(file(), other));
  Session session = open();
  EXPECT_THAT(lines_of(session.notes()), HasSubstr("does not belong to 'piece.vdb'"));
  EXPECT_FALSE(session.has_older_steps());
  EXPECT_TRUE(session.deepen());
  EXPECT_EQ(session.clay().hash(), other.hash());
  EXPECT_TRUE(fs::exists(file("piece.journal.jsonl.foreign-1")));
}

TEST_F(SessionHistory, OfAProjectThatAnOlderCopyReplacedIsPutAside) {
  ASSERT_TRUE(save_project(file("old.vdb"), small_clay()));
  work_and_close();
  for (int n = 0; n < 2; ++n) {
    // What it was before its first step, and then, by another session's end, before its last.
    fs::copy_file(file("old.vdb"), file(), fs::copy_options::overwrite_existing);
    EXPECT_FALSE(left_steps(file()).value()) << "no session was killed";
    EXPECT_EQ(open_project(file()).value().recovered_steps, 0);
    Session session = open();
    EXPECT_EQ(session.recovered_steps(), 0);
    EXPECT_EQ(session.clay().hash(), load_project(file("old.vdb")).value().hash());
    EXPECT_THAT(lines_of(session.notes()), HasSubstr("does not belong to 'piece.vdb'"));
    EXPECT_FALSE(session.has_older_steps());
    EXPECT_TRUE(fs::exists(file("piece.journal.jsonl.foreign-" + std::to_string(n + 1))));
    sculpt(session, 30, 1);
    ASSERT_TRUE(session.save());
    fs::copy_file(file(), file("old.vdb"), fs::copy_options::overwrite_existing);
    sculpt(session, 31, 1);
    ASSERT_TRUE(session.save());
    sculpt(session, 32, 1);
    ASSERT_TRUE(n == 0 ? session.discard() : session.close());
  }
}

TEST_F(SessionHistory, ThatIsDamagedIsNotRepeatedOnAnOlderCopyEither) {
  ASSERT_TRUE(save_project(file("old.vdb"), small_clay()));
  work_and_close();
  // The step with the rod cannot be read, nor what is behind it.
  for (const std::string& name : folder_.names()) {
    if (name.starts_with(".piece.solid-")) fs::remove(file(name));
  }
  fs::copy_file(file("old.vdb"), file(), fs::copy_options::overwrite_existing);
  EXPECT_FALSE(left_steps(file()).value());
  EXPECT_EQ(open_project(file()).value().recovered_steps, 0);
  Session session = open();
  EXPECT_EQ(session.clay().hash(), hashes_.front());
  EXPECT_TRUE(fs::exists(file("piece.journal.jsonl.foreign-1")));
}

TEST_F(SessionHistory, FromAnotherOriginIsNeverTaken) {
  work_and_close();
  ASSERT_TRUE(save_project(file(".piece.origin.vdb"), Clay::ball(5.0, {0.4, 0.1}).value()));
  Session session = open();
  sculpt(session, 20, 1);
  const auto deepened = session.deepen();
  ASSERT_FALSE(deepened);
  EXPECT_EQ(deepened.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(deepened.error().message,
              AllOf(HasSubstr("undo ends where 'piece.vdb' was opened"),
                    HasSubstr("'.piece.origin.vdb' is not what they start from")));
  EXPECT_FALSE(session.has_older_steps()) << "said once";
  EXPECT_TRUE(session.deepen());
  EXPECT_EQ(session.clay().hash(), hashes_.back());
  EXPECT_EQ(session.sculpture().undo_depth(), 1);
  ASSERT_TRUE(session.close());
  EXPECT_THAT(folder_.names(), ElementsAre("piece.vdb")) << "said, and nothing stays hidden";
  EXPECT_EQ(load_project(file()).value().hash(), hashes_.back());
}

/// A journal whose first stroke is another, and whose seal says so.
std::string with_another_stroke(const std::string& journal) {
  Stroke stroke;
  stroke.samples = {{0.0, {0.0, 6.0, 0.0}, {}, 1.0}};
  stroke.tool.radii_mm = {2.0, 2.0, 2.0};
  const std::size_t begin = journal.find('\n') + 1;
  return journal.substr(0, begin) + sealed_line(step_line(stroke)) +
         journal.substr(journal.find('\n', begin));
}

TEST_F(SessionHistory, ThatLeadsToAnotherClayIsNeverTaken) {
  work_and_close();
  const std::string whole = content_of(file("piece.journal.jsonl"));
  const std::string other = with_another_stroke(whole);
  ASSERT_NE(other, whole);
  fill(file("piece.journal.jsonl"), other);
  Session session = open();
  EXPECT_THAT(session.notes(), ElementsAre());
  const auto deepened = session.deepen();
  ASSERT_FALSE(deepened);
  EXPECT_THAT(deepened.error().message, HasSubstr("they lead to another clay"));
  EXPECT_EQ(session.clay().hash(), hashes_.back());
  EXPECT_EQ(session.sculpture().undo_depth(), 0);
}

TEST_F(SessionHistory, ThatIsDamagedTakesNothingFromTheStepsBehind) {
  work_and_close();
  const std::string whole = content_of(file("piece.journal.jsonl"));
  {
    Session session = open();
    sculpt(session, 20, 2);
    ASSERT_TRUE(session.flush());
  }
  std::string damaged = content_of(file("piece.journal.jsonl"));
  const std::size_t digit = damaged.find("\"spacing\":0.") + 12;
  ASSERT_LT(digit, whole.size());
  damaged[digit] = damaged[digit] == '3' ? '4' : '3';
  for (const std::string& text : {damaged, damaged.substr(0, damaged.find('\n') + 1) +
                                               damaged.substr(damaged.find('\n', digit) + 1)}) {
    fill(file("piece.journal.jsonl"), text);  // a step is not whole, or gone
    EXPECT_EQ(left_steps(file()).value().value().steps, 2U);
    Session session = open();
    EXPECT_EQ(session.recovered_steps(), 2);
    EXPECT_EQ(session.clay().hash(), hashes_.back());
    EXPECT_FALSE(session.deepen().ok() && session.sculpture().undo_depth() > 2);
    EXPECT_EQ(session.sculpture().undo_depth(), 2);
  }
}

TEST_F(SessionHistory, CutOffAtAnyLengthLosesNoProject) {
  work_and_close();
  const std::string whole = content_of(file("piece.journal.jsonl"));
  const std::string origin = content_of(file(".piece.origin.vdb"));
  for (std::size_t length = 0; length < whole.size(); length += test::effort(293U, 59U)) {
    fill(file("piece.journal.jsonl"), whole.substr(0, length));
    fill(file(".piece.origin.vdb"), origin);
    Session session = open();
    EXPECT_EQ(session.clay().hash(), hashes_.back()) << length;
    if (!session.deepen()) continue;
    EXPECT_EQ(session.clay().hash(), hashes_.back()) << length;
    const auto depth = static_cast<std::size_t>(session.sculpture().undo_depth());
    EXPECT_TRUE(depth == 0 || depth == 7) << "never a part of it: " << length;
    for (const std::string& name : folder_.names()) {
      if (name.find(".foreign-") != std::string::npos) fs::remove(file(name));
    }
  }
}

TEST_F(SessionHistory, ThatIsInterruptedMayBeReadAgain) {
  work_and_close();
  Session session = open();
  int calls = 0;
  const auto stopped = session.deepen([&](std::string_view, double) { return ++calls < 4; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted);
  EXPECT_TRUE(session.has_older_steps());
  EXPECT_EQ(session.clay().hash(), hashes_.back());
  ASSERT_TRUE(session.deepen());
  expect_each_earlier_state(session, 7);
}

TEST_F(SessionHistory, GoesAlongUnderAnotherName) {
  work_and_close();
  {
    Session session = open();
    sculpt(session, 20, 1);
    const auto saved = session.save_as(file("other.vdb"));
    ASSERT_TRUE(saved) << saved.error().message;
    EXPECT_TRUE(saved.value().keeps_undo);
    ASSERT_TRUE(session.close());
  }
  {
    auto other = Session::open(file("other.vdb"), keeping());
    ASSERT_TRUE(other);
    ASSERT_TRUE(other.value().deepen());
    expect_each_earlier_state(other.value(), 8);
  }
  // The old project has its own, up to what it was.
  Session session = open();
  EXPECT_EQ(session.clay().hash(), hashes_[7]);
  EXPECT_EQ(session.recovered_steps(), 0);
  ASSERT_TRUE(session.deepen());
  expect_each_earlier_state(session, 7);
}

TEST_F(SessionHistory, DiscardKeepsThatOfWhatWasSaved) {
  work_and_close();
  {
    Session session = open();
    sculpt(session, 20, 1);
    ASSERT_TRUE(session.save());
    sculpt(session, 21, 1);
    ASSERT_TRUE(session.discard());
  }
  {
    Session session = open();
    EXPECT_EQ(session.clay().hash(), hashes_[8]);
    EXPECT_EQ(session.recovered_steps(), 0);
    sculpt(session, 22, 1);
    ASSERT_TRUE(session.discard());
  }
  Session session = open();
  EXPECT_EQ(session.recovered_steps(), 0);
  ASSERT_TRUE(session.deepen());
  expect_each_earlier_state(session, 8);
}

TEST_F(SessionHistory, OfAReplacedProjectGoesAndLeftStepsStay) {
  work_and_close();
  const Clay other = Clay::ball(5.0, {0.4, 0.1}).value();
  const auto notes = replace_project(file(), other);
  ASSERT_TRUE(notes) << notes.error().message;
  EXPECT_THAT(lines_of(notes.value()),
              HasSubstr("the history of 'piece.vdb' was of the clay before and is gone"));
  EXPECT_THAT(folder_.names(), ElementsAre("piece.vdb"));
  fs::remove(file());
  hashes_.clear();
  work_and_close();
  {
    Session session = open();
    sculpt(session, 20, 1);
  }
  ASSERT_TRUE(replace_project(file(), other));
  EXPECT_TRUE(fs::exists(file("piece.journal.jsonl.replaced-1"))) << "it has a step that none has";
}

TEST_F(SessionHistory, OfTheOneThatIsSavedOverGoes) {
  work_and_close();
  auto session = Session::create(file("new.vdb"), Clay::ball(5.0, {0.4, 0.1}).value(), keeping());
  ASSERT_TRUE(session);
  const auto done = apply_step(session.value().sculpture(), small_stroke(3));
  ASSERT_TRUE(done);
  session.value().record(small_stroke(3));
  const auto saved = session.value().save_as(file());
  ASSERT_TRUE(saved) << saved.error().message;
  EXPECT_THAT(saved.value().notes, ElementsAre());
  for (const std::string& name : folder_.names()) {
    EXPECT_EQ(name.find(".replaced-"), std::string::npos) << name;
  }
  ASSERT_TRUE(session.value().close());
  for (const std::string& name : folder_.names()) EXPECT_FALSE(name.starts_with(".piece.solid-"));
  Session again = open();
  ASSERT_TRUE(again.deepen());
  EXPECT_EQ(again.sculpture().undo_depth(), 1);
}

TEST_F(SessionHistory, LeftStepsThatNobodyWantsGoAloneAndItStays) {
  work_and_close();
  {
    Session session = open();
    sculpt(session, 20, 2);
  }
  EXPECT_EQ(left_steps(file()).value().value().steps, 2U);
  ASSERT_TRUE(put_left_steps_aside(file()));
  EXPECT_TRUE(fs::exists(file("piece.journal.jsonl.left-1")));
  Session session = open();
  EXPECT_EQ(session.recovered_steps(), 0);
  EXPECT_EQ(session.clay().hash(), hashes_[7]);
  ASSERT_TRUE(session.deepen());
  expect_each_earlier_state(session, 7);
}

TEST_F(SessionHistory, LeftStepsAreAScriptForTheProjectAsItIs) {
  work_and_close();
  {
    Session session = open();
    sculpt(session, 20, 2);
  }
  ASSERT_TRUE(put_left_steps_aside(file()));
  fs::copy_file(file(), file("again.vdb"));
  fs::rename(file("piece.journal.jsonl.left-1"), file("again.journal.jsonl"));
  auto again = Session::open(file("again.vdb"), keeping());
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again.value().recovered_steps(), 2);
  EXPECT_EQ(again.value().clay().hash(), hashes_.back());
}

TEST_F(SessionHistory, ThatCannotBeRemovedDoesNotHinderTheEnd) {
  SessionOptions plain;
  plain.autosave_steps = 0;
  Session session = create(plain);
  sculpt(session, 0, 2);
  // The name of a solid that no program can unlink.
  fs::create_directory(file(".piece.solid-0123456789abcdef.ply"));
  const auto closed = session.close();
  ASSERT_TRUE(closed) << closed.error().message;
  EXPECT_FALSE(is_in_session(file()));
  EXPECT_EQ(load_project(file()).value().hash(), hashes_.back());
}

TEST_F(SessionHistory, ThatAPlainSessionBeganGoesOnOnceItWasKept) {
  SessionOptions plain;
  plain.autosave_steps = 0;
  {
    Session session = create(plain);
    sculpt(session, 0, 2);
  }  // as after a kill
  ASSERT_TRUE(open().close());
  ASSERT_TRUE(open(plain).close());
  Session session = open();
  ASSERT_TRUE(session.deepen());
  expect_each_earlier_state(session, 2);
}

TEST_F(SessionHistory, ThatIsForgottenLeavesTheProjectAlone) {
  work_and_close();
  Session session = open();
  sculpt(session, 20, 1);
  const auto forgotten = session.forget_history();
  ASSERT_TRUE(forgotten) << forgotten.error().message;
  EXPECT_THAT(folder_.names(), UnorderedElementsAre("piece.vdb", "piece.lock"));
  EXPECT_EQ(load_project(file()).value().hash(), hashes_.back());
  EXPECT_FALSE(session.has_older_steps());
  EXPECT_EQ(session.sculpture().undo_depth(), 0);
  EXPECT_FALSE(session.sculpture().redo());
  EXPECT_EQ(session.history_size().steps, 0U);
  sculpt(session, 21, 1);
  ASSERT_TRUE(session.close());
  Session again = open();
  ASSERT_TRUE(again.deepen());
  EXPECT_EQ(again.sculpture().undo_depth(), 1);
}

// ---- bounds ------------------------------------------------------------------------------------

SessionOptions bounded(std::size_t steps, std::uint64_t bytes) {
  SessionOptions options;
  options.autosave_steps = 0;
  options.keeps_history = true;
  options.history_steps = steps;
  options.history_bytes = bytes;
  return options;
}

constexpr std::uint64_t kManyBytes = std::uint64_t{1} << 40;

TEST_F(SessionHistory, OfTooManyStepsLosesTheOldest) {
  {
    Session session = create(bounded(8, kManyBytes));
    sculpt(session, 0, 10);
    ASSERT_TRUE(session.close());
  }
  Session session = open();
  EXPECT_EQ(session.history_size().steps, 4U);
  EXPECT_EQ(session.clay().hash(), hashes_[10]);
  ASSERT_TRUE(session.deepen());
  for (std::size_t n = 10; n-- > 6;) {
    ASSERT_TRUE(session.sculpture().undo());
    EXPECT_EQ(session.clay().hash(), hashes_[n]);
  }
  EXPECT_FALSE(session.sculpture().undo());
}

TEST_F(SessionHistory, EndedWhileTheOldestGoHasTheOthers) {
  {
    Session session = create();
    sculpt(session, 0, 10);
    ASSERT_TRUE(session.close());
  }
  const std::string long_journal = content_of(file("piece.journal.jsonl"));
  {
    Session session = open(bounded(8, kManyBytes));
    ASSERT_TRUE(session.deepen());
    ASSERT_TRUE(session.close());
  }
  ASSERT_LT(content_of(file("piece.journal.jsonl")).size(), long_journal.size());
  // The new origin is there, and not yet the journal that starts from it.
  fill(file("piece.journal.jsonl"),
       long_journal + sealed_line(mark_line({hash_text(hashes_[6]), 6})) + "\n");
  Session session = open();
  EXPECT_EQ(session.recovered_steps(), 0);
  ASSERT_TRUE(session.deepen());
  EXPECT_EQ(session.sculpture().undo_depth(), 4);
  for (std::size_t n = 10; n-- > 6;) {
    ASSERT_TRUE(session.sculpture().undo());
    EXPECT_EQ(session.clay().hash(), hashes_[n]);
  }
}

TEST_F(SessionHistory, OfTooManyBytesLosesTheOldest) {
  const auto long_stroke = [](unsigned n) {
    Stroke stroke = small_stroke(n);
    stroke.samples.resize(60, stroke.samples.back());
    return stroke;
  };
  constexpr unsigned kSteps = 10;
  {
    Session session = create(bounded(1000, kManyBytes));
    for (unsigned n = 0; n < kSteps; ++n) sculpt(session, long_stroke(n));
    ASSERT_TRUE(session.close());
  }
  const std::uint64_t whole = fs::file_size(file("piece.journal.jsonl"));
  for (const fs::path& one : {file(), file("piece.journal.jsonl"), file(".piece.origin.vdb")}) {
    fs::remove(one);
  }
  hashes_.clear();
  {
    Session session = create(bounded(kSteps, whole * 9 / 10));
    for (unsigned n = 0; n < kSteps; ++n) sculpt(session, long_stroke(n));
    ASSERT_TRUE(session.close());
  }
  EXPECT_LT(fs::file_size(file("piece.journal.jsonl")), whole / 2);
  Session session = open();
  const std::size_t left = session.history_size().steps;
  EXPECT_GE(left, 3U);
  ASSERT_TRUE(session.deepen());
  for (std::size_t n = kSteps; n-- > kSteps - left;) {
    ASSERT_TRUE(session.sculpture().undo());
    EXPECT_EQ(session.clay().hash(), hashes_[n]);
  }
  EXPECT_FALSE(session.sculpture().undo());
}

TEST_F(SessionHistory, IsCutWhereUndoAndRedoStayWithin) {
  {
    Session session = create(bounded(8, kManyBytes));
    sculpt(session, 0, 6);
    for (int n = 0; n < 2; ++n) sculpt(session, HistoryStep::undo);
    sculpt(session, HistoryStep::redo);  // 5 strokes of 9 steps: no cut between these three
    ASSERT_TRUE(session.close());
  }
  Session session = open();
  ASSERT_TRUE(session.deepen());
  ASSERT_TRUE(session.sculpture().redo());
  EXPECT_EQ(session.clay().hash(), hashes_[6]);
}

TEST_F(SessionHistory, OfManyShortSessionsEndsAtTwiceTheBound) {
  for (unsigned n = 0; n < 20; ++n) {
    Session session = n == 0 ? create(bounded(8, kManyBytes)) : open(bounded(8, kManyBytes));
    sculpt(session, n, 1);
    ASSERT_TRUE(session.close());
    EXPECT_LE(open_project(file()).value().history.steps, 16U);
  }
  Session session = open(bounded(8, kManyBytes));
  ASSERT_TRUE(session.deepen());
  const int depth = session.sculpture().undo_depth();
  EXPECT_GE(depth, 1);
  for (int n = 0; n < depth; ++n) {
    ASSERT_TRUE(session.sculpture().undo());
    EXPECT_EQ(session.clay().hash(), hashes_[static_cast<std::size_t>(19 - n)]);
  }
}

TEST_F(SessionHistory, OfPiecesIsCutOnlyWhereTheActiveOneIsKnown) {
  {
    Session session = create(bounded(6, kManyBytes));
    sculpt(session, 0, 2);
    sculpt(session, PieceEdit{CopyPiece{"Clay", "Other"}});
    sculpt(session, PieceEdit{SelectPiece{"Clay"}});
    sculpt(session, 2, 1);
    sculpt(session, PieceEdit{SelectPiece{"Other"}});
    sculpt(session, 3, 2);
    ASSERT_TRUE(session.close());
  }
  Session session = open();
  ASSERT_TRUE(session.deepen());
  EXPECT_EQ(session.sculpture().hash(), hashes_.back());
  EXPECT_EQ(session.sculpture().undo_depth(), 2);
}

}  // namespace
}  // namespace argil::io
