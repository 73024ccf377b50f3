// SPDX-License-Identifier: GPL-3.0-or-later
// A clay with its lock, journal and autosaves. The order of the writes, and why each is safe, is in
// docs/files.md.
#include "argil/io/session.h"

#include <cassert>
#include <cerrno>
#include <chrono>
#include <future>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "argil/core/end_slot.h"
#include "argil/core/hash_text.h"
#include "argil/core/no_throw.h"
#include "argil/engine/sculpture.h"
#include "argil/io/project_file.h"
#include "argil/io/safe_file.h"

#include "file/file_bytes.h"
#include "project/journal.h"
#include "project/journal_writer.h"
#include "project/project_lock.h"
#include "project/recovery.h"
#include "project/session_files.h"
#include "script/step_solid.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

bool is_there(const fs::path& file) {
  std::error_code error;
  return fs::exists(fs::symlink_status(file, error));
}

std::string mark_of(const Sculpture& sculpture, std::size_t steps) {
  return sealed_line(mark_line({hash_text(sculpture.hash()), steps}));
}

/// A journal nobody can go on with is renamed, together with the state it started from.
Result<void> put_aside(const SessionFiles& files, const std::string& word,
                       std::vector<std::string>& notes) {
  for (const fs::path& file : {files.journal, files.origin}) {
    auto aside = keep_aside(file, word);
    if (!aside) return aside.error();
    if (!aside.value()) continue;
    notes.push_back(quoted_name(file) + " is kept as " + quoted_name(*aside.value()));
  }
  return remove_if_there(files.autosave);
}

/// Cuts a journal to its first bytes, keeping a copy when `keep`: steps behind damage are not ours
/// to throw away.
Result<void> cut_journal(const fs::path& journal, std::uint64_t bytes, bool keep,
                         std::vector<std::string>& notes) {
  if (keep) {
    int n = 1;
    const auto name = [&] { return journal.string() + ".damaged-" + std::to_string(n); };
    // Never over an older one.
    while (is_there(name())) ++n;
    if (auto kept = keep_bytes(journal, name()); !kept) return kept;
    notes.push_back("the damaged journal is kept as " + quoted_name(name()));
  }
  if (::truncate(journal.c_str(), static_cast<off_t>(bytes)) == 0) return {};
  return disk_error("write", journal, errno);
}

/// The journal of a session that these steps were told, sealed and ended by the mark of
/// `sculpture`; what the steps work with is stored under its names and added to `solids`. Errors as
/// save_solid.
Result<std::string> journal_text(const Journal& told, const Sculpture& sculpture,
                                 const SessionFiles& files, std::set<std::string>& solids) {
  std::string text = sealed_line(header_line({std::nullopt, told.base_hash})) + "\n";
  for (const ScriptStep& step : told.steps) {
    const auto solid = solid_of(step);
    const SolidName name = solid ? name_of(*solid, files.solid_front) : SolidName();
    if (solid && solids.insert(name.file).second) {
      auto kept = save_solid(files.project.parent_path() / name.file, *solid);
      if (!kept) return kept.error();
    }
    text += sealed_line(step_line(step, name)) + "\n";
  }
  return text + mark_of(sculpture, told.steps.size()) + "\n";
}

/// What save_as has written under the other name.
struct WrittenAs {
  std::string base_hash;  ///< of the journal, as the next two
  std::set<std::string> solids;
  std::uint64_t journal_bytes = 0;  ///< 0: there is none
  bool has_project = false;
  std::string undo_lost;  ///< why there is no journal though there were steps
};

/// All files of a session under another name. The project is the last that takes room; until the
/// journal has its name, too, the others beside the project mean nothing.
Result<void> write_told(const SessionFiles& files, const Sculpture& sculpture, const Journal& told,
                        const fs::path& base, WrittenAs& written) {
  if (auto kept = keep_copy(base, files.origin); !kept) return kept;
  const auto text = journal_text(told, sculpture, files, written.solids);
  if (!text) return text.error();
  auto done = replace_file(files.journal, [&](const fs::path& temporary) -> Result<void> {
    OutputFile out(temporary);
    out.write(text.value());
    if (auto closed = out.close(); !closed) return closed;
    if (auto saved = save_sculpture(files.project, sculpture); !saved) return saved;
    written.has_project = true;
    return {};
  });
  if (!done) return done;
  written.base_hash = told.base_hash;
  written.journal_bytes = text.value().size();
  return {};
}

}  // namespace

struct Session::State {
  State(SessionFiles session_files, ProjectLock project_lock, const SessionOptions& session_options,
        Sculpture session_sculpture)
      : files(std::move(session_files)),
        lock(std::move(project_lock)),
        options(session_options),
        sculpture(std::move(session_sculpture)) {}
  ~State() { end_autosave(); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  Result<void> take_over(const Recovery& recovery);
  void take_back_when_ended();
  void start_journal(const std::string& base_hash, std::uint64_t good_bytes);
  Result<void> save(bool keep_origin);
  Result<Journal> told();
  const fs::path& base() const;
  Result<WrittenAs> write_as(const SessionFiles& to);
  void go_on(const WrittenAs& written, std::size_t done_steps);
  Result<void> leave(bool removes_created);
  void keep(const ScriptStep& step);
  Result<void> store_solid(const std::string& name, const Solid& solid);
  void autosave_a_little(bool slow_step);
  void end_autosave();

  SessionFiles files;
  ProjectLock lock;
  SessionOptions options;
  Sculpture sculpture;
  std::vector<std::string> notes;
  std::set<std::string> solids;            // that the disk has; of the journal's thread
  std::vector<EndSlot> taken_back;         // of what is all or nothing
  std::vector<EndSlot> taken_back_solids;  // of the journal's thread
  std::unique_ptr<JournalWriter> journal;  // null when the session is over
  std::size_t steps = 0;                   // of the journal
  std::size_t saved_steps = 0;             // of these in the project
  std::int64_t recovered = 0;
  std::uint64_t opened_bytes = 0;       // of the journal
  std::set<std::string> opened_solids;  // that it names
  bool had_origin = false;
  bool created = false;
  bool saved = false;

  std::optional<SculptureCopy> copy;  // of an autosave that has begun
  std::size_t autosaved_steps = 0;
  Clock::time_point autosaved_at = Clock::now();
  std::future<Result<void>> autosave;
  mutable std::mutex problem_mutex;
  Result<void> autosave_problem;
};

// ---- opening -----------------------------------------------------------------------------------

/// Makes the files fit what was recovered, so that the journal can be gone on with.
Result<void> Session::State::take_over(const Recovery& recovery) {
  remove_stale_temporaries(files);
  if (recovery.is_foreign) {
    if (auto aside = put_aside(files, "foreign", notes); !aside) return aside;
  }
  if (!recovery.journal) {
    for (const fs::path& file : {files.journal, files.autosave, files.origin}) {
      if (auto removed = remove_if_there(file); !removed) return removed;
    }
    if (auto removed = remove_solids(files, {}); !removed) return removed;
    take_back_when_ended();
    start_journal(hash_text(sculpture.hash()), 0);
    return {};
  }
  const Journal& read = *recovery.journal;
  const bool cut_short = recovery.steps < read.steps.size();
  opened_bytes =
      cut_short ? (recovery.steps == 0 ? 0 : read.ends[recovery.steps - 1]) : read.whole_bytes;
  if (read.torn || !recovery.damage.empty()) {
    if (auto cut = cut_journal(files.journal, opened_bytes, !recovery.damage.empty(), notes); !cut)
      return cut;
  }
  steps = recovery.steps;
  saved_steps = recovery.project_steps;
  autosaved_steps = steps;
  recovered = static_cast<std::int64_t>(steps - saved_steps);
  had_origin = is_there(files.origin);
  opened_solids = solids = read.solids;
  take_back_when_ended();
  start_journal(read.base_hash, opened_bytes);
  return {};
}

/// Once the journal is as the session finds it, before it writes there. A project that was replaced
/// is saved, and the others belong to it.
void Session::State::take_back_when_ended() {
  if (!options.is_all_or_nothing) return;
  const fs::path& witness = files.project;
  if (created) taken_back.emplace_back(files.project, 0, witness);
  taken_back.emplace_back(files.journal, opened_bytes, witness);
  taken_back.emplace_back(files.autosave, 0, witness);
  if (!had_origin) taken_back.emplace_back(files.origin, 0, witness);
}

void Session::State::start_journal(const std::string& base_hash, std::uint64_t good_bytes) {
  journal = std::make_unique<JournalWriter>(
      JournalWriter::Start{files.journal, sealed_line(header_line({std::nullopt, base_hash})),
                           good_bytes, options.queue_lines});
}

Result<Session> Session::open(const fs::path& file, const SessionOptions& options,
                              const Progress& progress) {
  return no_throw(file.string(), [&]() -> Result<Session> {
    SessionFiles files = session_files(file);
    auto lock = ProjectLock::take(files.lock, file);
    if (!lock) return lock.error();
    auto recovered = recover(files, progress);
    if (!recovered) return recovered.error();
    Recovery& recovery = recovered.value();
    auto state = std::make_unique<State>(std::move(files), std::move(lock).value(), options,
                                         std::move(recovery.sculpture));
    state->notes = std::move(recovery.notes);
    if (auto ok = state->sculpture.set_limits(options.limits); !ok) return ok.error();
    if (auto taken = state->take_over(recovery); !taken) return taken.error();
    return Session(std::move(state));
  });
}

Result<Session> Session::create(const fs::path& file, Clay clay, const SessionOptions& options) {
  return create(file, Sculpture(std::move(clay)), options);
}

Result<Session> Session::create(const fs::path& file, Sculpture sculpture,
                                const SessionOptions& options) {
  return no_throw(file.string(), [&]() -> Result<Session> {
    SessionFiles files = session_files(file);
    auto lock = ProjectLock::take(files.lock, file);
    if (!lock) return lock.error();
    if (is_there(files.project)) {
      return Error{ErrorKind::bad_input, quoted_name(file) + " exists; open it instead"};
    }
    auto state = std::make_unique<State>(std::move(files), std::move(lock).value(), options,
                                         std::move(sculpture));
    if (auto aside = put_aside(state->files, "foreign", state->notes); !aside) return aside.error();
    if (auto saved = save_sculpture(state->files.project, state->sculpture); !saved)
      return saved.error();
    state->created = true;
    if (auto ok = state->sculpture.set_limits(options.limits); !ok) return ok.error();
    state->take_back_when_ended();
    state->start_journal(hash_text(state->sculpture.hash()), 0);
    return Session(std::move(state));
  });
}

Session::Session(std::unique_ptr<State> state) : state_(std::move(state)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Clay& Session::clay() noexcept { return state_->sculpture.clay(); }
Sculpture& Session::sculpture() noexcept { return state_->sculpture; }
std::int64_t Session::recovered_steps() const noexcept { return state_->recovered; }
const std::vector<std::string>& Session::notes() const noexcept { return state_->notes; }
std::size_t Session::step_count() const noexcept { return state_->steps; }

// ---- while sculpting ---------------------------------------------------------------------------

/// Whether repeating the step takes longer than an autosave does: it measures a surface, or brings
/// another solid onto the lattice. A cut only pays for what it changes.
bool is_slow(const ScriptStep& step) {
  if (const auto* edit = std::get_if<PieceEdit>(&step)) {
    const auto* add = std::get_if<AddPiece>(edit);
    return (add != nullptr && add->mesh != nullptr) || std::holds_alternative<MergePiece>(*edit);
  }
  const auto* operation = std::get_if<Operation>(&step);
  return operation != nullptr && !std::holds_alternative<Cut>(*operation);
}

/// On the journal's thread. What was stored once is there until the session is over.
Result<void> Session::State::store_solid(const std::string& name, const Solid& solid) {
  return no_throw(name, [&]() -> Result<void> {
    if (solids.contains(name)) return {};
    const fs::path file = files.project.parent_path() / name;
    if (options.is_all_or_nothing) taken_back_solids.emplace_back(file, 0, files.project);
    if (auto kept = save_solid(file, solid); !kept) return kept;
    solids.insert(name);
    return {};
  });
}

void Session::State::keep(const ScriptStep& step) {
  const auto solid = solid_of(step);
  if (!solid) {
    journal->push_step(sealed_line(step_line(step)));
  } else {
    const SolidName name = name_of(*solid, files.solid_front);
    journal->push_step(sealed_line(step_line(step, name)),
                       [this, file = name.file, kept = *solid] { return store_solid(file, kept); });
  }
  ++steps;
}

void Session::record(const ScriptStep& step) {
  assert(validate_step(step).ok());
  state_->keep(step);
  state_->autosave_a_little(is_slow(step));
}

Result<void> Session::flush() { return state_->journal->flush(); }

Result<void> Session::journal_state() const { return state_->journal->state(); }

std::size_t Session::kept_count() const { return state_->steps - state_->journal->waiting_steps(); }

Result<void> Session::problem() const {
  if (auto state = journal_state(); !state) return state;
  const std::lock_guard held(state_->problem_mutex);
  return state_->autosave_problem;
}

/// Begins a copy when one is due, copies its next piece, hands a complete one to a thread. After a
/// slow step one is due at once and copied whole: that is a small part of what the step took.
void Session::State::autosave_a_little(bool slow_step) {
  if (options.autosave_steps == 0 || sculpture.clay().is_stroke_open()) return;
  if (autosave.valid()) {
    if (autosave.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    end_autosave();
  }
  if (!copy) {
    const std::chrono::duration<double> since = Clock::now() - autosaved_at;
    const bool due = slow_step ||
                     steps - autosaved_steps >= static_cast<std::size_t>(options.autosave_steps) ||
                     since.count() >= options.autosave_seconds;
    if (!due) return;
    copy.emplace(sculpture);
  }
  const std::size_t most = slow_step ? SculptureCopy::kAllLeaves : options.autosave_leaves;
  if (!copy->advance(sculpture, most)) return;
  autosaved_steps = steps;
  autosaved_at = Clock::now();
  autosave =
      std::async(std::launch::async, [this, after = steps, copied = std::move(*copy)]() mutable {
        return no_throw(files.autosave.string(), [&]() -> Result<void> {
          const Sculpture then = std::move(copied).take();
          // The mark first: an autosave that the journal does not know would be of no use.
          journal->push_mark(mark_of(then, after));
          if (auto flushed = journal->flush(); !flushed) return flushed;
          return save_sculpture(files.autosave, then);
        });
      });
  copy.reset();
}

void Session::State::end_autosave() {
  if (!autosave.valid()) return;
  Result<void> ended = autosave.get();
  const std::lock_guard held(problem_mutex);
  autosave_problem = std::move(ended);
}

// ---- saving and ending -------------------------------------------------------------------------

Result<void> Session::State::save(bool keep_origin) {
  end_autosave();
  copy.reset();
  if (auto flushed = journal->flush(); !flushed) return flushed;
  // The project has all of it.
  if (steps == saved_steps) return {};
  if (keep_origin && !is_there(files.origin)) {
    if (auto kept = keep_copy(files.project, files.origin); !kept) return kept;
  }
  journal->push_mark(mark_of(sculpture, steps));
  if (auto flushed = journal->flush(); !flushed) return flushed;
  // The mark before the project: a crash between the two leaves a journal that knows both states.
  if (auto replaced = save_sculpture(files.project, sculpture); !replaced) return replaced;
  saved_steps = steps;
  saved = true;
  return {};
}

Result<void> Session::save() {
  return no_throw(state_->files.project.string(), [&] { return state_->save(true); });
}

Result<void> Session::close() {
  return no_throw(state_->files.project.string(), [&]() -> Result<void> {
    if (auto saved = state_->save(false); !saved) return saved;
    const SessionFiles& files = state_->files;
    // The journal first: without it the other two mean nothing, without them it would mean less.
    for (const fs::path& file : {files.journal, files.autosave, files.origin}) {
      if (auto removed = remove_if_there(file); !removed) return removed;
    }
    if (auto removed = remove_solids(files, {}); !removed) return removed;
    state_.reset();
    return {};
  });
}

/// Leaves the files as they were when the session began, or when it saved last.
Result<void> Session::State::leave(bool removes_created) {
  end_autosave();
  journal.reset();
  std::vector<fs::path> unwanted;
  if (saved) {
    // What was saved is in the project: as after a close. The journal first, as there.
    unwanted = {files.journal, files.autosave, files.origin};
  } else {
    if (opened_bytes == 0) unwanted.push_back(files.journal);
    if (created && removes_created) unwanted.push_back(files.project);
    unwanted.push_back(files.autosave);
    if (!had_origin) unwanted.push_back(files.origin);
  }
  if (!saved && opened_bytes > 0) {
    if (auto cut = cut_journal(files.journal, opened_bytes, false, notes); !cut) return cut;
  }
  for (const fs::path& file : unwanted) {
    if (auto removed = remove_if_there(file); !removed) return removed;
  }
  return remove_solids(files, saved ? std::set<std::string>() : opened_solids);
}

Result<void> Session::discard() {
  return no_throw(state_->files.project.string(), [&]() -> Result<void> {
    if (auto left = state_->leave(true); !left) return left;
    state_.reset();
    return {};
  });
}

// ---- under another name ------------------------------------------------------------------------

/// The file that the journal starts from.
const fs::path& Session::State::base() const {
  return is_there(files.origin) ? files.origin : files.project;
}

/// Every step so far.
/// Errors  disk: not all of them are to be had any more, or not what they start from.
Result<Journal> Session::State::told() {
  if (auto flushed = journal->flush(); !flushed) return flushed.error();
  auto read = read_journal(files.journal);
  if (!read) return read.error();
  if (!read.value() || read.value()->steps.size() != steps || !is_there(base())) {
    return Error{ErrorKind::disk, quoted_name(files.journal) + " or what it starts from is gone"};
  }
  return *std::move(read).value();
}

/// Errors  what lay there lies there.
Result<WrittenAs> Session::State::write_as(const SessionFiles& to) {
  WrittenAs written;
  Result<void> done;
  if (steps > 0) {
    const auto all = told();
    if (all) done = write_told(to, sculpture, all.value(), base(), written);
    if (all && done) return written;
    written.undo_lost = all ? done.error().message : all.error().message;
  }
  // Without a journal they mean nothing, and do no harm where they cannot be removed.
  static_cast<void>(remove_if_there(to.origin).ok());
  static_cast<void>(remove_solids(to, {}).ok());
  written.solids.clear();
  if (written.has_project) return written;
  if (done) done = save_sculpture(to.project, sculpture);
  if (!done) return done.error();
  return written;
}

/// Begins with the files that save_as has written, as after a save.
void Session::State::go_on(const WrittenAs& written, std::size_t done_steps) {
  saved = true;
  if (written.journal_bytes == 0) return start_journal(hash_text(sculpture.hash()), 0);
  steps = saved_steps = autosaved_steps = done_steps;
  solids = written.solids;
  start_journal(written.base_hash, written.journal_bytes);
}

Result<SavedAs> Session::save_as(const fs::path& file) {
  return no_throw(file.string(), [&]() -> Result<SavedAs> {
    const SessionFiles files = session_files(file);
    if (files.project == state_->files.project) {
      if (auto saved = save(); !saved) return saved.error();
      return SavedAs{};
    }
    auto lock = ProjectLock::take(files.lock, file);
    if (!lock) return lock.error();
    state_->end_autosave();
    state_->copy.reset();
    remove_stale_temporaries(files);
    SavedAs result;
    if (auto aside = put_aside(files, "replaced", result.notes); !aside) return aside.error();
    const auto written = state_->write_as(files);
    if (!written) return written.error();
    const std::string& undo_lost = written.value().undo_lost;
    result.keeps_undo = undo_lost.empty();
    if (!result.keeps_undo) result.notes.push_back("undo ends at the save: " + undo_lost);
    auto next = std::make_unique<State>(
        files, std::move(lock).value(), state_->options,
        // Undo without its journal could not be repeated after a crash: then the clay
        // goes on without.
        result.keeps_undo ? std::move(state_->sculpture) : copy_of(state_->sculpture));
    next->go_on(written.value(), state_->steps);
    std::swap(state_, next);
    if (auto left = next->leave(false); !left) result.notes.push_back(left.error().message);
    return result;
  });
}

// ---- without a session -------------------------------------------------------------------------

Result<std::optional<LeftSteps>> left_steps(const fs::path& file) {
  return no_throw(file.string(), [&]() -> Result<std::optional<LeftSteps>> {
    const SessionFiles files = session_files(file);
    const auto sculpture = load_sculpture(files.project);
    if (!sculpture) return sculpture.error();
    const auto journal = read_journal(files.journal);
    if (!journal) return journal.error();
    if (!journal.value()) return std::optional<LeftSteps>();
    // A journal of another project is nobody's left steps.
    const std::size_t all = journal.value()->steps.size();
    const std::size_t steps =
        all - journal.value()->position_of(hash_text(sculpture.value().hash())).value_or(all);
    if (steps == 0) return std::optional<LeftSteps>();
    std::error_code error;
    const auto written = fs::last_write_time(files.journal, error);
    if (error) return disk_error("read", files.journal, error.value());
    return std::optional(LeftSteps{steps, std::chrono::file_clock::to_sys(written)});
  });
}

bool is_in_session(const fs::path& file) {
  const auto lock = ProjectLock::take(session_files(file).lock, file);
  return !lock && lock.error().kind == ErrorKind::bad_input;
}

Result<std::vector<std::string>> put_left_steps_aside(const fs::path& file) {
  return no_throw(file.string(), [&]() -> Result<std::vector<std::string>> {
    const SessionFiles files = session_files(file);
    const auto lock = ProjectLock::take(files.lock, file);
    if (!lock) return lock.error();
    std::vector<std::string> notes;
    if (auto aside = put_aside(files, "left", notes); !aside) return aside.error();
    return notes;
  });
}

Result<void> remove_project(const fs::path& file) {
  return no_throw(file.string(), [&]() -> Result<void> {
    const SessionFiles files = session_files(file);
    const auto lock = ProjectLock::take(files.lock, file);
    if (!lock) return lock.error();
    if (auto removed = remove_if_there(files.journal); !removed) return removed;
    if (auto removed = remove_kept_aside(files); !removed) return removed;
    if (auto removed = remove_solids(files, {}); !removed) return removed;
    for (const fs::path& one : {files.autosave, files.origin, files.project}) {
      if (auto removed = remove_if_there(one); !removed) return removed;
    }
    remove_stale_temporaries(files);
    return {};
  });
}

Result<OpenedProject> open_project(const fs::path& file, const Progress& progress) {
  return no_throw(file.string(), [&]() -> Result<OpenedProject> {
    SessionFiles files = session_files(file);
    files.project = file;  // messages name the file as it was given
    auto recovered = recover(files, progress);
    if (!recovered) return recovered.error();
    Recovery& recovery = recovered.value();
    const auto added = static_cast<std::int64_t>(recovery.steps - recovery.project_steps);
    return OpenedProject{std::move(recovery.sculpture), added, std::move(recovery.notes)};
  });
}

namespace {

template <class Save>
Result<std::vector<std::string>> replace_by(const fs::path& file, Save save) {
  return no_throw(file.string(), [&]() -> Result<std::vector<std::string>> {
    const SessionFiles files = session_files(file);
    const auto lock = ProjectLock::take(files.lock, file);
    if (!lock) return lock.error();
    if (Result<void> saved = save(); !saved) return saved.error();
    std::vector<std::string> notes;
    if (auto aside = put_aside(files, "replaced", notes); !aside) return aside.error();
    return notes;
  });
}

}  // namespace

Result<std::vector<std::string>> replace_project(const fs::path& file, const Clay& clay) {
  return replace_by(file, [&] { return save_project(file, clay); });
}

Result<std::vector<std::string>> replace_project(const fs::path& file, const Sculpture& sculpture) {
  return replace_by(file, [&] { return save_sculpture(file, sculpture); });
}

}  // namespace argil::io
