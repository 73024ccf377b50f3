// SPDX-License-Identifier: GPL-3.0-or-later
// A clay with its lock, journal and autosaves. The order of the writes, and why each is safe, is in
// docs/files.md.
#include "argil/io/session.h"

#include <algorithm>
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
#include "project/session_state.h"
#include "script/step_solid.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

/// The marks of a state after so many steps.
std::string marks_after(const Journal& told, std::size_t steps) {
  std::set<std::string> hashes;
  for (const HashMark& mark : told.marks) {
    if (mark.after == steps) hashes.insert(mark.hash);
  }
  std::string text;
  for (const std::string& hash : hashes) text += mark_of(hash, steps) + "\n";
  return text;
}

/// The journal of a session that these steps were told, sealed, with its marks, and ended by that
/// of `sculpture`; what the steps work with is stored under its names and added to `solids`.
/// Errors as save_solid.
Result<std::string> journal_text(const Journal& told, bool keeps_history,
                                 const Sculpture& sculpture, const SessionFiles& files,
                                 std::set<std::string>& solids) {
  std::string text = sealed_line(header_line({std::nullopt, told.base_hash, keeps_history})) + "\n";
  for (std::size_t n = 0; n < told.steps.size(); ++n) {
    const ScriptStep& step = told.steps[n];
    const auto solid = solid_of(step);
    const SolidName name = solid ? name_of(*solid, files.solid_front) : SolidName();
    if (solid && solids.insert(name.file).second) {
      auto kept = save_solid(files.project.parent_path() / name.file, *solid);
      if (!kept) return kept.error();
    }
    text += sealed_line(step_line(step, name)) + "\n" + marks_after(told, n + 1);
  }
  return text + mark_of(sculpture, told.steps.size()) + "\n";
}

/// All files of a session under another name. The project is the last that takes room; until the
/// journal has its name, too, the others beside the project mean nothing.
Result<void> write_told(const SessionFiles& files, const Sculpture& sculpture, const Journal& told,
                        bool keeps_history, const fs::path& base, WrittenAs& written) {
  if (auto kept = keep_copy(base, files.origin); !kept) return kept;
  const auto text = journal_text(told, keeps_history, sculpture, files, written.solids);
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

// ---- opening -----------------------------------------------------------------------------------

/// Makes the files fit what was recovered, so that the journal can be gone on with.
Result<void> Session::State::take_over(const Recovery& recovery) {
  remove_stale_temporaries(files);
  if (recovery.is_foreign) {
    if (auto aside = put_aside(files, "foreign", notes); !aside) return aside.error();
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
      cut_short ? (recovery.steps == 0 ? 0 : read.begins[recovery.steps]) : read.whole_bytes;
  if (read.torn || !recovery.damage.empty()) {
    if (auto cut = cut_journal(files.journal, opened_bytes, !recovery.damage.empty(), notes); !cut)
      return cut;
  }
  steps = recovery.steps;
  saved_steps = recovery.project_steps;
  autosaved_steps = steps;
  recovered = static_cast<std::int64_t>(steps - saved_steps);
  had_origin = is_there(files.origin);
  had_history = read.keeps_history;
  first_step = recovery.first_step;
  is_closed = std::any_of(read.marks.begin(), read.marks.end(), [this](const HashMark& mark) {
    return mark.is_closing && mark.after == steps;
  });
  history_lost = read.hole;
  if (!history_lost.empty()) notes.push_back(history_is_lost(files.project, read.hole).message);
  saved_bytes = opened_bytes;
  solids = read.solids;
  opened_solids = solids_beside(files);
  weigh_history();
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
  journal = std::make_unique<JournalWriter>(JournalWriter::Start{
      files.journal, sealed_line(header_line({std::nullopt, base_hash, keeps_history()})),
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
    return (add != nullptr && add->mesh != nullptr) || std::holds_alternative<MergePiece>(*edit) ||
           std::holds_alternative<SplitPiece>(*edit);
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
  is_closed = false;
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
  // Where the project was removed meanwhile, there is nothing to keep.
  if (keep_origin && !is_there(files.origin) && is_there(files.project)) {
    if (auto kept = keep_copy(files.project, files.origin); !kept) return kept;
  }
  const std::string hash = hash_text(sculpture.hash());
  journal->push_mark(mark_of(hash, steps));
  if (auto flushed = journal->flush(); !flushed) return flushed;
  // The mark before the project: a crash between the two leaves a journal that knows both states.
  if (auto replaced = save_sculpture(files.project, sculpture); !replaced) return replaced;
  saved_steps = steps;
  saved = true;
  saved_hash = hash;
  saved_bytes = journal->durable_bytes();
  saved_solids = solids;  // nobody writes any while no line waits
  weigh_history();
  return {};
}

Result<void> Session::save() {
  return no_throw(state_->files.project.string(), [&] { return state_->save(true); });
}

Result<void> Session::close() {
  return no_throw(state_->files.project.string(), [&]() -> Result<void> {
    if (auto saved = state_->save(state_->keeps_history()); !saved) return saved.error();
    // The project has every step. What cannot be kept or removed from here on is undo's alone, and
    // the sculpture may be an earlier one meanwhile: nobody may go on with that.
    static_cast<void>(no_throw("the history", [&] { return state_->end_history(); }).ok());
    state_.reset();
    return {};
  });
}

/// Leaves the files as they were when the session began, or when it saved last.
Result<void> Session::State::leave(bool removes_created) {
  end_autosave();
  journal.reset();
  // What was saved is in the project: as after a close, all or what undo of it needs.
  const bool keeps_saved = saved && keeps_history() && is_there(files.origin);
  if (saved && !keeps_saved) return remove_history();
  const std::uint64_t kept_bytes = saved ? saved_bytes : opened_bytes;
  std::vector<fs::path> unwanted;
  if (kept_bytes == 0) unwanted.push_back(files.journal);
  if (!saved && created && removes_created) unwanted.push_back(files.project);
  unwanted.push_back(files.autosave);
  if (!saved && !had_origin) unwanted.push_back(files.origin);
  if (kept_bytes > 0) {
    if (auto cut = cut_journal(files.journal, kept_bytes, false, notes); !cut) return cut;
  }
  for (const fs::path& file : unwanted) {
    if (auto removed = remove_if_there(file); !removed) return removed;
  }
  std::set<std::string> wanted = opened_solids;
  if (saved) {
    start_journal("", saved_bytes);
    mark_as_closed();
    wanted.insert(saved_solids.begin(), saved_solids.end());
  }
  return remove_solids(files, wanted);
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
/// Errors  bad_input: not all of them are to be had any more, which no other try changes; disk;
///         memory.
Result<Journal> Session::State::told() {
  if (auto flushed = journal->flush(); !flushed) return flushed.error();
  auto read = read_journal(files.journal);
  if (!read) return read.error();
  if (!read.value() || !is_there(base())) {
    return Error{ErrorKind::disk, quoted_name(files.journal) + " or what it starts from is gone"};
  }
  if (read.value()->steps.size() != steps) {
    const std::string& damage = read.value()->damage;
    return Error{ErrorKind::bad_input,
                 damage.empty() ? quoted_name(files.journal) + " was changed" : damage};
  }
  return *std::move(read).value();
}

/// Errors  what lay there lies there.
Result<WrittenAs> Session::State::write_as(const SessionFiles& to) {
  WrittenAs written;
  Result<void> done;
  if (steps > 0) {
    const auto all = told();
    if (all) done = write_told(to, sculpture, all.value(), keeps_history(), base(), written);
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
  saved_solids = solids = written.solids;
  saved_bytes = written.journal_bytes;
  saved_hash = hash_text(sculpture.hash());
  start_journal(written.base_hash, written.journal_bytes);
  weigh_history();
}

namespace {

/// As far as it goes: what is not back has its other name.
void put_back(const std::vector<FileAside>& files) {
  for (const FileAside& one : files) {
    std::error_code ignored;
    if (!is_there(one.file)) fs::rename(one.aside, one.file, ignored);
  }
}

/// The history of a project that was replaced. What stays does no harm.
void remove_aside(const std::vector<FileAside>& files) {
  for (const FileAside& one : files) static_cast<void>(remove_if_there(one.aside).ok());
}

}  // namespace

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
    const bool drops = is_history_alone(files);
    std::vector<std::string> aside_notes;
    const auto aside = put_aside(files, "replaced", aside_notes);
    if (!aside) return aside.error();
    const auto written = state_->write_as(files);
    if (!written) {
      if (drops) put_back(aside.value());
      return written.error();
    }
    if (!drops) result.notes = std::move(aside_notes);
    if (drops) {
      remove_aside(aside.value());
      static_cast<void>(remove_solids(files, written.value().solids).ok());
    }
    const std::string& undo_lost = written.value().undo_lost;
    result.keeps_undo = undo_lost.empty();
    if (!result.keeps_undo) result.notes.push_back("undo ends at the save: " + undo_lost);
    auto next = std::make_unique<State>(
        files, std::move(lock).value(), state_->options,
        // Undo without its journal could not be repeated after a crash: then the clay
        // goes on without.
        result.keeps_undo ? std::move(state_->sculpture) : copy_of(state_->sculpture));
    next->had_history = state_->had_history;
    if (result.keeps_undo) {
      next->first_step = state_->first_step;
      next->history_lost = state_->history_lost;
    }
    next->go_on(written.value(), state_->steps);
    std::swap(state_, next);
    if (auto left = next->leave(false); !left) result.notes.push_back(left.error().message);
    return result;
  });
}

}  // namespace argil::io
