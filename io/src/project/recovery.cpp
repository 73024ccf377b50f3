// SPDX-License-Identifier: GPL-3.0-or-later
// Brings a clay back from its project and journal, whatever a crash left of them. Nothing is
// written here.
#include "project/recovery.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <string_view>
#include <utility>

#include "argil/core/hash_text.h"
#include "argil/io/project_file.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

/// A stored state of the sculpture and how many steps of the journal it holds.
struct Stored {
  fs::path file;
  std::optional<Sculpture> sculpture;  ///< once it is loaded
  std::size_t steps = 0;
  bool was_tried = false;
};

/// Loads it where that was not done yet, and applies the journal's steps behind it.
Result<Repeated> repeat(Stored& stored, const Journal& journal, const Progress& progress) {
  if (!stored.sculpture) {
    auto loaded = load_sculpture(stored.file);
    if (!loaded) return loaded.error();
    stored.sculpture = std::move(loaded).value();
  }
  return repeat_steps(*stored.sculpture, journal, stored.steps, "recover", progress);
}

/// Adds a stored state as often as the journal knows it: a state that the clay had more than once
/// has the same bits each time, but what can be undone or redone from it is not the same.
void add_state(const fs::path& file, Sculpture sculpture, const Journal& journal,
               std::vector<Stored>& states) {
  for (const std::size_t steps : journal.positions_of(hash_text(sculpture.hash()))) {
    states.push_back({file, std::nullopt, steps});
  }
  // Latest first, so that the one tried first need not be loaded again.
  if (!states.empty() && states.back().file == file) states.back().sculpture = std::move(sculpture);
}

/// A file that is not there or damaged is passed over: the project alone is enough, the others make
/// it quick or let undo reach behind.
void add_state(const fs::path& file, const Journal& journal, std::vector<Stored>& states) {
  if (auto loaded = load_sculpture(file)) {
    add_state(file, std::move(loaded).value(), journal, states);
  }
}

void sort_latest_first(std::vector<Stored>& states) {
  std::stable_sort(states.begin(), states.end(),
                   [](const Stored& a, const Stored& b) { return a.steps > b.steps; });
}

void tell(const SessionFiles& files, Recovery& recovery) {
  const Journal& journal = *recovery.journal;
  if (const std::size_t added = recovery.steps - recovery.project_steps; added > 0) {
    recovery.notes.push_back(quoted_name(files.project) + ": recovered " + std::to_string(added) +
                             (added == 1 ? " stroke" : " strokes") + " from its journal");
  }
  if (journal.torn) {
    recovery.notes.push_back("the last line of " + quoted_name(files.journal) +
                             " was cut off when the program ended; it was left out");
  }
  if (!recovery.damage.empty()) {
    recovery.notes.push_back(quoted_name(files.journal) +
                             " is damaged; what is before the damage was used: " + recovery.damage);
  }
}

/// What was tried so far, and which of it brought the sculpture furthest.
struct Tried {
  std::optional<Stored> best;
  Repeated furthest;
};

/// The latest state first, until all can be repeated from one. Undo reaches no further back than a
/// state, so a later one may fail where an earlier one does not. Those among steps that were not
/// read are left out.
Result<void> try_states(std::vector<Stored>& states, const Journal& journal, Tried& tried,
                        const Progress& progress) {
  for (Stored& state : states) {
    if (tried.best && tried.furthest.steps == journal.steps.size()) break;
    if (state.was_tried || state.steps < journal.first_read) continue;
    state.was_tried = true;
    auto repeated = repeat(state, journal, progress);
    if (!repeated) return repeated.error();
    if (!tried.best || repeated.value().steps > tried.furthest.steps) {
      tried.furthest = std::move(repeated).value();
      tried.best = std::move(state);
    }
    state.sculpture.reset();
  }
  return {};
}

/// Reads the steps that were only counted. False where one of them cannot be read.
Result<bool> read_all(const SessionFiles& files, std::string_view text, Journal& journal) {
  if (journal.first_read == 0) return true;
  if (!journal.hole.empty()) return false;
  auto all = parse_journal(files.journal, text);
  if (!all) return all.error();
  // Of fewer a solid is gone that those in question do not need.
  if (all.value().steps.size() < journal.steps.size()) return false;
  journal = std::move(all).value();
  return true;
}

/// From the project or an autosave, and where that is not enough from every state there is.
Result<Recovery> repeat_from_best(const SessionFiles& files, std::string_view text,
                                  Recovery recovery, const Progress& progress) {
  Journal& journal = *recovery.journal;
  std::vector<Stored> states;
  const bool has_left = recovery.project_steps < journal.steps.size();
  add_state(files.project, std::move(recovery.sculpture), journal, states);
  if (has_left) add_state(files.autosave, journal, states);
  sort_latest_first(states);
  Tried tried;
  if (auto done = try_states(states, journal, tried, progress); !done) return done.error();
  assert(tried.best);
  if (tried.furthest.steps < journal.steps.size()) {
    const auto are_all_read = read_all(files, text, journal);
    if (!are_all_read) return are_all_read.error();
    add_state(files.origin, journal, states);
    sort_latest_first(states);
    if (are_all_read.value()) {
      if (auto done = try_states(states, journal, tried, progress); !done) return done.error();
    }
  }
  recovery.first_step = tried.best->steps;
  recovery.sculpture = *std::move(tried.best->sculpture);
  recovery.steps = tried.furthest.steps;
  recovery.damage = journal.damage.empty() ? tried.furthest.stopped_by : journal.damage;
  assert(recovery.steps <= journal.steps.size());
  recovery.project_steps = std::min(recovery.project_steps, recovery.steps);
  tell(files, recovery);
  return recovery;
}

Result<Recovery> recover_once(const SessionFiles& files, const Progress& progress) {
  // The journal first: should a session end meanwhile, its project is newer, never older.
  const auto bytes = read_journal_bytes(files.journal);
  if (!bytes) return bytes.error();
  auto loaded = load_sculpture(files.project);
  if (!loaded) return loaded.error();
  Recovery recovery{std::move(loaded).value(), std::nullopt, false, 0, 0, 0, {}, {}};
  if (!bytes.value()) return recovery;
  const std::string_view text = text_of(*bytes.value());
  const std::string hash = hash_text(recovery.sculpture.hash());
  auto journal = parse_journal(files.journal, text, hash);
  if (!journal) return journal.error();
  const Journal& read = journal.value();
  // Ended before its first line was whole: nothing was finished.
  if (read.base_hash.empty() && read.damage.empty() && read.hole.empty()) return recovery;
  const auto steps = read.position_of_project(hash);
  if (!steps) {
    recovery.notes.push_back(
        quoted_name(files.journal) + " does not belong to " + quoted_name(files.project) +
        (read.base_hash.empty() ? ": " + read.damage
                                : ", which has the hash " + hash + ": the file was replaced"));
    recovery.is_foreign = true;
    return recovery;
  }
  recovery.journal = std::move(journal).value();
  recovery.project_steps = *steps;
  return repeat_from_best(files, text, std::move(recovery), progress);
}

}  // namespace

Result<Repeated> repeat_steps(Sculpture& sculpture, const Journal& journal, std::size_t first,
                              std::string_view stage, const Progress& progress) {
  assert(journal.first_read <= first && first <= journal.steps.size());
  const auto count = static_cast<double>(journal.steps.size() - first);
  for (std::size_t i = first; i < journal.steps.size(); ++i) {
    const auto within = [&](std::string_view, double fraction) {
      return !progress || progress(stage, (static_cast<double>(i - first) + fraction) / count);
    };
    const auto applied = within("", 0.0) ? repeat_step(sculpture, journal.steps[i], within)
                                         : Result<StrokeReport>(Error{ErrorKind::interrupted, ""});
    if (applied) continue;
    if (applied.error().kind == ErrorKind::interrupted) {
      return Error{ErrorKind::interrupted,
                   "interrupted while repeating steps; nothing was changed"};
    }
    if (applied.error().kind != ErrorKind::bad_input) return applied.error();
    return Repeated{i, "step " + std::to_string(i + 1) + ": " + applied.error().message};
  }
  return Repeated{journal.steps.size(), ""};
}

Result<Recovery> recover(const SessionFiles& files, const Progress& progress) {
  auto recovery = recover_once(files, progress);
  if (!recovery || !recovery.value().is_foreign) return recovery;
  // Whoever reads without the lock may have met a session between its journal and its project.
  return recover_once(files, progress);
}

}  // namespace argil::io
