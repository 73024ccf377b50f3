// SPDX-License-Identifier: GPL-3.0-or-later
// Projects that no session is open on: what was left beside them, and how they are read, replaced
// and removed.
#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

#include "argil/core/hash_text.h"
#include "argil/core/no_throw.h"
#include "argil/io/project_file.h"

#include "file/file_bytes.h"
#include "project/history_cut.h"
#include "project/session_state.h"
#include "vdb/project_header.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

/// A journal that belongs to its project, and how many of its steps that has.
struct OwnJournal {
  Journal journal;
  std::size_t project_steps = 0;
  std::string hash;  ///< of the project
  std::size_t left() const { return journal.steps.size() - project_steps; }
};

/// Nothing where there is none. Errors  as load_project.
Result<std::optional<OwnJournal>> read_own_journal(const SessionFiles& files) {
  const auto bytes = read_journal_bytes(files.journal);
  if (!bytes) return bytes.error();
  const auto sculpture = load_sculpture(files.project);
  if (!sculpture) return sculpture.error();
  if (!bytes.value()) return std::optional<OwnJournal>();
  const std::string hash = hash_text(sculpture.value().hash());
  auto journal = parse_journal(files.journal, text_of(*bytes.value()), hash);
  if (!journal) return journal.error();
  const auto steps = journal.value().position_of_project(hash);
  if (!steps) return std::optional<OwnJournal>();
  return std::optional(OwnJournal{std::move(journal).value(), *steps, hash});
}

}  // namespace

/// By what the project says of itself: loading it takes a second.
bool is_history_alone(const SessionFiles& files) {
  const std::string hash = stated_hash(files.project);
  if (hash.empty()) return false;
  const auto bytes = read_journal_bytes(files.journal);
  if (!bytes || !bytes.value()) return false;
  const auto journal = parse_journal(files.journal, text_of(*bytes.value()), hash);
  if (!journal || !journal.value().damage.empty() || journal.value().torn) return false;
  return journal.value().position_of(hash) == journal.value().steps.size();
}

Result<std::optional<LeftSteps>> left_steps(const fs::path& file) {
  return no_throw(file.string(), [&]() -> Result<std::optional<LeftSteps>> {
    const SessionFiles files = session_files(file);
    if (is_history_alone(files)) return std::optional<LeftSteps>();
    const auto own = read_own_journal(files);
    if (!own) return own.error();
    // A journal of another project is nobody's left steps.
    if (!own.value() || own.value()->left() == 0) return std::optional<LeftSteps>();
    std::error_code error;
    const auto written = fs::last_write_time(files.journal, error);
    if (error) return disk_error("read", files.journal, error.value());
    return std::optional(LeftSteps{own.value()->left(), std::chrono::file_clock::to_sys(written)});
  });
}

bool is_in_session(const fs::path& file) {
  const auto lock = ProjectLock::take(session_files(file).lock, file);
  return !lock && lock.error().kind == ErrorKind::bad_input;
}

namespace {

/// Steps behind a history go into a journal of their own, which starts from the project as it is;
/// the history stays.
Result<void> put_behind_history_aside(const SessionFiles& files, const OwnJournal& own,
                                      std::vector<std::string>& notes) {
  const auto bytes = read_journal_bytes(files.journal);
  if (!bytes) return bytes.error();
  if (!bytes.value()) return disk_error("read", files.journal, ENOENT);
  const fs::path aside = free_aside(files.journal, "left");
  const std::string left = steps_from(own.journal, text_of(*bytes.value()), own.project_steps,
                                      {std::nullopt, own.hash, false});
  if (auto kept = write_journal_text(aside, left); !kept) return kept;
  notes.push_back("the steps that were left are kept as " + quoted_name(aside));
  if (auto removed = remove_if_there(files.autosave); !removed) return removed;
  return cut_journal(files.journal, own.journal.begins[own.project_steps],
                     !own.journal.damage.empty(), notes);
}

}  // namespace

Result<std::vector<std::string>> put_left_steps_aside(const fs::path& file) {
  return no_throw(file.string(), [&]() -> Result<std::vector<std::string>> {
    const SessionFiles files = session_files(file);
    const auto lock = ProjectLock::take(files.lock, file);
    if (!lock) return lock.error();
    std::vector<std::string> notes;
    const auto own = read_own_journal(files);
    const bool has_history = own && own.value() && own.value()->journal.keeps_history &&
                             own.value()->project_steps > 0 && own.value()->left() > 0;
    if (has_history) {
      auto aside = put_behind_history_aside(files, *own.value(), notes);
      return aside ? Result<std::vector<std::string>>(notes) : aside.error();
    }
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
    HistorySize history;
    if (recovery.journal) {
      history = {
          recovery.journal->steps.size(),
          recovery.journal->whole_bytes + bytes_of_file(files.origin) + bytes_of_solids(files)};
    }
    return OpenedProject{std::move(recovery.sculpture), added, std::move(recovery.notes), history};
  });
}

namespace {

template <class Save>
Result<std::vector<std::string>> replace_by(const fs::path& file, Save save) {
  return no_throw(file.string(), [&]() -> Result<std::vector<std::string>> {
    const SessionFiles files = session_files(file);
    const auto lock = ProjectLock::take(files.lock, file);
    if (!lock) return lock.error();
    const bool drops = is_history_alone(files);
    if (Result<void> saved = save(); !saved) return saved.error();
    std::vector<std::string> notes;
    if (drops) {
      // Of another clay: nothing that the project does not tell better is lost with it.
      if (auto removed = remove_if_there(files.journal); !removed) return removed.error();
      for (const fs::path& one : {files.autosave, files.origin}) {
        if (auto removed = remove_if_there(one); !removed) return removed.error();
      }
      if (auto removed = remove_solids(files, {}); !removed) return removed.error();
      notes.push_back("the history of " + quoted_name(file) +
                      " was of the clay before and is gone");
      return notes;
    }
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
