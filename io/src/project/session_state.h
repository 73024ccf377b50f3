// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "argil/core/end_slot.h"
#include "argil/engine/sculpture.h"
#include "argil/io/session.h"

#include "project/journal.h"
#include "project/journal_writer.h"
#include "project/project_lock.h"
#include "project/recovery.h"
#include "project/session_files.h"

namespace argil::io {

struct HistoryCut;

/// What save_as has written under the other name.
struct WrittenAs {
  std::string base_hash;  ///< of the journal, as the next two
  std::set<std::string> solids;
  std::uint64_t journal_bytes = 0;  ///< 0: there is none
  bool has_project = false;
  std::string undo_lost;  ///< why there is no journal though there were steps
};

/// A whole journal at once. Errors  as replace_file.
Result<void> write_journal_text(const std::filesystem::path& file, const std::string& text);

/// The sealed line of a mark.
std::string mark_of(const std::string& hash, std::size_t steps);
std::string mark_of(const Sculpture& sculpture, std::size_t steps);

/// A name that a file was put aside under, and its own.
struct FileAside {
  std::filesystem::path file;
  std::filesystem::path aside;
};

/// Renames a journal that nobody can go on with, together with the state it started from, and tells
/// it in the notes. Errors  disk.
Result<std::vector<FileAside>> put_aside(const SessionFiles& files, const std::string& word,
                                         std::vector<std::string>& notes);

/// Whether a journal lies there for undo alone: the project has all that it tells.
bool is_history_alone(const SessionFiles& files);

/// Why undo does not reach behind the opening of a project.
Error history_is_lost(const std::filesystem::path& project, const std::string& why);

/// A session in its folder. Its parts are in session.cpp, what is kept for undo beyond its end in
/// session_history.cpp.
struct Session::State {
  using Clock = std::chrono::steady_clock;

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
  /// Whether what undo needs stays when the session ends.
  bool keeps_history() const noexcept { return options.keeps_history || had_history; }
  Result<void> remove_history();
  Result<void> end_history();
  void mark_as_closed();
  Result<void> shorten_history();
  void cut_history(const Journal& whole, std::string_view text, const HistoryCut& cut);
  Result<void> forget_history();
  Result<void> deepen(const Progress& progress);
  void weigh_history();
  Result<Journal> told();
  const std::filesystem::path& base() const;
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
  bool had_history = false;            // the journal was kept for undo
  std::size_t first_step = 0;          // of the journal, that the sculpture may take back
  std::string history_lost;            // why those before it cannot be repeated; empty
  bool is_closed = false;              // the journal says so, and nothing came behind
  std::string saved_hash;              // of the project, once this session has saved it
  std::uint64_t saved_bytes = 0;       // of the journal, whose end the project is
  std::set<std::string> saved_solids;  // that were there then
  std::uint64_t beside_bytes = 0;      // of origin and solids, when they were last looked at
  bool created = false;
  bool saved = false;

  std::optional<SculptureCopy> copy;  // of an autosave that has begun
  std::size_t autosaved_steps = 0;
  Clock::time_point autosaved_at = Clock::now();
  std::future<Result<void>> autosave;
  mutable std::mutex problem_mutex;
  Result<void> autosave_problem;
};

}  // namespace argil::io
