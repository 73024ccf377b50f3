// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/io/stroke_script.h"

namespace argil::io {

/// What lies beside a project so that steps can be taken back.
struct HistorySize {
  std::size_t steps = 0;    ///< of the journal; undo and redo count, too
  std::uint64_t bytes = 0;  ///< of the journal, the state that it starts from, and solids
};

/// A project as it stands with the strokes of its journal, if a session left one.
struct OpenedProject {
  Sculpture sculpture;
  std::int64_t recovered_steps = 0;  ///< steps of the journal that the file does not hold
  std::vector<std::string> notes;    ///< one sentence for each thing a person should know
  HistorySize history = {};
};

/// Loads a project for reading: recovers in memory, changes no file, takes no lock.
/// Errors  as load_project; interrupted.
Result<OpenedProject> open_project(const std::filesystem::path& file,
                                   const Progress& progress = {});

/// What a session that was killed left beside its project.
struct LeftSteps {
  std::size_t steps = 0;                         ///< of the journal, that the project has not
  std::chrono::system_clock::time_point newest;  ///< when the last of them was written
};

/// Nothing where no steps are left. Reads the project and its journal, repeats nothing and takes no
/// lock, so it cannot tell whose steps those of a session that goes on are: ask is_in_session
/// first. Errors  as load_project, where the journal does not say itself that it has none.
Result<std::optional<LeftSteps>> left_steps(const std::filesystem::path& file);

/// Whether a program is sculpting the project now, this one included.
bool is_in_session(const std::filesystem::path& file);

/// Renames the journal, so that the next session starts from the project as it was saved; what
/// became of it comes back as notes, a sentence each. Of a history that was kept, those steps alone
/// go, into a copy.
/// Errors  bad_input when another program has the project; disk.
Result<std::vector<std::string>> put_left_steps_aside(const std::filesystem::path& file);

/// Removes a project and all that sessions kept beside it: left steps, also those put aside,
/// autosave, origin and solids. The project goes last: ended before, it opens as it was saved.
/// Errors  bad_input when another program has the project; disk.
Result<void> remove_project(const std::filesystem::path& file);

struct SessionOptions {
  /// A copy of the clay is saved in the background after so many steps, and after an operation that
  /// is slow to repeat, so that a recovery has less to repeat; 0: never. Small costs disk and
  /// processor, large costs time after a kill.
  int autosave_steps = 500;
  double autosave_seconds = 300.0;  ///< or after so long, with the next step

  /// Leaves of 2 KB that one step copies for the autosave at most (a little more, whole nodes).
  std::size_t autosave_leaves = 2000;

  std::size_t queue_lines = 64;  ///< steps the disk may be behind

  /// close() leaves what undo needs, so that the next session can take back steps of this one
  /// (deepen). Where a session before did so, it goes on also without.
  bool keeps_history = false;

  /// When it has more than so many steps at its end, or journal and solids have more bytes, the
  /// oldest go at close(): half of it is left, or what memory can take back; of a session that
  /// went on with an older one perhaps only its own steps, and none where no cut fits.
  /// A step is repeated in the time it took the first time, without the hand's: 500 strokes are
  /// some 20 s at the first undo. 500 strokes of 10 s, by a pen that tells 100 samples a second,
  /// are 50 MB (bench_history).
  std::size_t history_steps = 500;
  std::uint64_t history_bytes = std::uint64_t{256} << 20;

  /// Until it is saved, a forced end (safe_file.h) takes everything back, as discard() does: for
  /// commands that write all or nothing. Else what was recorded comes back when the project is
  /// opened.
  bool is_all_or_nothing = false;

  ClayLimits limits = {};  ///< of the clay
};

/// How a project went on under another name.
struct SavedAs {
  /// False: the steps so far could not be read again, so that undo and redo end at the save.
  bool keeps_undo = true;
  std::vector<std::string> notes;  ///< one sentence for each thing a person should know
};

/// Sculpting a project without losing a finished step, whatever ends the program: what record()
/// was told (strokes, undo and redo, operations) goes to a journal beside the project and is on the
/// disk soon after, certainly when flush() has returned success (SessionKills.*). The files and why
/// every order of writing is safe: docs/files.md, "A session".
///
/// Threads  the clay's, except where a member says any. Writing is done by threads of its own:
///          record() waits for the disk only when it is queue_lines steps behind.
/// Errors   a disk that fails or is full takes nothing from the clay in memory: work goes on, lines
///          wait and are tried again with every record() and flush().
class Session {
 public:
  /// Opens a project for writing, with the strokes of a journal that an earlier session left.
  /// Errors  bad_input when another program has it; as load_project; disk.
  static Result<Session> open(const std::filesystem::path& file, const SessionOptions& options = {},
                              const Progress& progress = {});

  /// Starts a project that must not exist: saves `clay` and sculpts on.
  static Result<Session> create(const std::filesystem::path& file, Clay clay,
                                const SessionOptions& options = {});
  static Result<Session> create(const std::filesystem::path& file, Sculpture sculpture,
                                const SessionOptions& options = {});

  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  /// Leaves the journal: as after a kill, but that all steps are tried to be written first.
  ~Session();

  Sculpture& sculpture() noexcept;
  /// Of its active piece.
  Clay& clay() noexcept;
  std::int64_t recovered_steps() const noexcept;
  const std::vector<std::string>& notes() const noexcept;

  /// Steps the journal holds or will hold, recovered ones included.
  std::size_t step_count() const noexcept;

  /// Whether the journal has steps that sculpture() cannot take back or repeat before deepen():
  /// those of before it was opened.
  bool has_older_steps() const noexcept;

  /// Makes sculpture() able to take back and repeat all steps of the journal, as far as
  /// SessionOptions::limits let it: repeats them on a second clay, and takes over its history once
  /// its hash is that of this one. Bits, clays and surfaces stay as they are (SessionHistory.*).
  /// Nothing where there are none, or while a stroke is open.
  /// Errors  interrupted, memory, disk: nothing was changed, and may be tried again; bad_input: the
  ///         steps cannot be repeated; has_older_steps() is false then, and close() removes them
  ///         and those since: the project has what they led to.
  /// Cost    what the steps took, without the hand's time; the memory of a second clay and
  ///         of its history meanwhile.
  Result<void> deepen(const Progress& progress = {});

  /// All steps of the journal. Errors  bad_input: not to be had any more; disk; memory.
  Result<std::vector<ScriptStep>> told_steps();

  /// What is on the disk now. Threads  the clay's.
  HistorySize history_size() const;

  /// Saves, and forgets every step: undo and redo begin anew.
  /// Errors  as save; disk: nothing was forgotten.
  Result<void> forget_history();

  /// Keeps a step, as validate_step wants it, that was just applied to sculpture() (apply_step, or
  /// to clay() a live stroke as a whole: what ClayWorkerOptions::on_stroke tells). The mesh or clay
  /// that it works with is kept in a file of its own and must not change meanwhile.
  void record(const ScriptStep& step);

  /// Waits until every step recorded is on the disk.
  /// Errors  disk: not all are; nothing is lost while the program runs.
  Result<void> flush();

  /// Of step_count(), those that are on the disk.
  std::size_t kept_count() const;

  /// How the last try to write steps ended; success before the first. Any thread.
  Result<void> journal_state() const;

  /// What the writing threads last failed at, at steps or an autosave, to be shown while sculpting.
  /// Any thread.
  Result<void> problem() const;

  /// Saves the whole clay as the project. The journal stays, for undo may reach behind the save.
  /// Errors  disk, interrupted: the project file is as it was.
  Result<void> save();

  /// Saves the whole clay as another project, over one of that name if there is one, and goes on
  /// there with all that can be undone. The old project is left as it was saved last, or opened or
  /// created. Ended at any time, the old one has every step, or both are whole (SessionKills.*).
  /// Errors  bad_input when another program has the other project; disk, interrupted: the session
  ///         goes on as before and what lay under the name is as it was, but that a journal left
  ///         beside that may have another name (NAME.journal.jsonl.replaced-N).
  /// Cost    a save, and every step so far is read and written; where no second name can be given
  ///         to a file, a copy of the project as it was before the first step.
  Result<SavedAs> save_as(const std::filesystem::path& file);

  /// Saves what is not saved and removes journal, autosave and lock, or leaves of these what undo
  /// needs (SessionOptions::keeps_history); the session is over.
  /// Errors  as save; the session then goes on. Files that stay behind the save are no error.
  Result<void> close();

  /// Forgets every step since open or create and leaves the files as they were then; the session is
  /// over. After a save: forgets every step since the last one, and the project stays as saved,
  /// with its history where that is kept.
  Result<void> discard();

 private:
  struct State;
  explicit Session(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Saves `clay` as a project that no session is sculpting, over a file of that name if there is
/// one. A journal of the old file is renamed, one that was kept for undo alone is removed, and that
/// is told in the notes that come back.
/// Errors  bad_input when another program has the project; as save_project.
Result<std::vector<std::string>> replace_project(const std::filesystem::path& file,
                                                 const Clay& clay);
Result<std::vector<std::string>> replace_project(const std::filesystem::path& file,
                                                 const Sculpture& sculpture);

}  // namespace argil::io
