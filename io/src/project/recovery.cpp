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
};

/// How far the steps could be repeated, and why not further.
struct Repeated {
  std::size_t steps = 0;
  std::string stopped_by;
};

/// Applies the journal's steps from `stored.steps` on.
Result<Repeated> repeat(Stored& stored, const Journal& journal, const Progress& progress) {
  if (!stored.sculpture) {
    auto loaded = load_sculpture(stored.file);
    if (!loaded) return loaded.error();
    stored.sculpture = std::move(loaded).value();
  }
  assert(stored.steps <= journal.steps.size());
  const std::size_t first = stored.steps;
  const auto count = static_cast<double>(journal.steps.size() - first);
  for (std::size_t i = first; i < journal.steps.size(); ++i) {
    const auto within = [&](std::string_view, double fraction) {
      return !progress || progress("recover", (static_cast<double>(i - first) + fraction) / count);
    };
    const auto applied = within("", 0.0) ? repeat_step(*stored.sculpture, journal.steps[i], within)
                                         : Result<StrokeReport>(Error{ErrorKind::interrupted, ""});
    if (applied) continue;
    if (applied.error().kind == ErrorKind::interrupted) {
      return Error{ErrorKind::interrupted, "interrupted while recovering; nothing was changed"};
    }
    if (applied.error().kind != ErrorKind::bad_input) return applied.error();
    return Repeated{i, "step " + std::to_string(i + 1) + ": " + applied.error().message};
  }
  return Repeated{journal.steps.size(), ""};
}

/// The stored states that the journal knows, the latest first. A file that is not there or damaged
/// is passed over: the project alone is enough, the others make it quick or let undo reach behind.
/// A state that the clay had more than once is there more than once: its bits are the same each
/// time, but what can be undone or redone from it is not.
std::vector<Stored> stored_states(const SessionFiles& files, const Journal& journal,
                                  Sculpture project) {
  std::vector<Stored> states;
  const auto add = [&](const fs::path& file, Sculpture sculpture) {
    for (const std::size_t steps : journal.positions_of(hash_text(sculpture.hash()))) {
      states.push_back({file, std::nullopt, steps});
    }
    // Latest first, so that the one tried first need not be loaded again.
    if (!states.empty() && states.back().file == file)
      states.back().sculpture = std::move(sculpture);
  };
  add(files.project, std::move(project));
  for (const fs::path& file : {files.autosave, files.origin}) {
    if (auto loaded = load_sculpture(file)) add(file, std::move(loaded).value());
  }
  std::stable_sort(states.begin(), states.end(),
                   [](const Stored& a, const Stored& b) { return a.steps > b.steps; });
  return states;
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

/// From the latest state from which all can be repeated. Undo reaches no further back than a state,
/// so a later one may fail where an earlier one does not.
Result<Recovery> repeat_from_best(const SessionFiles& files, Recovery recovery,
                                  const Progress& progress) {
  const Journal& journal = *recovery.journal;
  auto states = stored_states(files, journal, std::move(recovery.sculpture));
  std::optional<std::size_t> best;
  Repeated furthest;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (best && furthest.steps == journal.steps.size()) break;
    auto repeated = repeat(states[i], journal, progress);
    if (!repeated) return repeated.error();
    if (best && repeated.value().steps <= furthest.steps) continue;
    best = i;
    furthest = std::move(repeated).value();
  }
  recovery.sculpture = *std::move(states[best.value_or(0)].sculpture);
  recovery.steps = furthest.steps;
  recovery.damage = journal.damage.empty() ? furthest.stopped_by : journal.damage;
  assert(recovery.steps <= journal.steps.size());
  recovery.project_steps = std::min(recovery.project_steps, recovery.steps);
  tell(files, recovery);
  return recovery;
}

Result<Recovery> recover_once(const SessionFiles& files, const Progress& progress) {
  // The journal first: should a session end meanwhile, its project is newer, never older.
  auto journal = read_journal(files.journal);
  if (!journal) return journal.error();
  auto loaded = load_sculpture(files.project);
  if (!loaded) return loaded.error();
  Recovery recovery{std::move(loaded).value(), std::move(journal).value(), false, 0, 0, {}, {}};
  if (!recovery.journal) return recovery;
  Journal& read = *recovery.journal;
  if (read.base_hash.empty() && read.damage.empty()) {
    recovery.journal.reset();  // ended before its first line was whole: nothing was finished
    return recovery;
  }
  const std::string hash = hash_text(recovery.sculpture.hash());
  const auto steps = read.position_of(hash);
  if (!steps) {
    recovery.notes.push_back(
        quoted_name(files.journal) + " does not belong to " + quoted_name(files.project) +
        (read.base_hash.empty() ? ": " + read.damage
                                : ", which has the hash " + hash + ": the file was replaced"));
    recovery.journal.reset();
    recovery.is_foreign = true;
    return recovery;
  }
  recovery.project_steps = *steps;
  return repeat_from_best(files, std::move(recovery), progress);
}

}  // namespace

Result<Recovery> recover(const SessionFiles& files, const Progress& progress) {
  auto recovery = recover_once(files, progress);
  if (!recovery || !recovery.value().is_foreign) return recovery;
  // Whoever reads without the lock may have met a session between its journal and its project.
  return recover_once(files, progress);
}

}  // namespace argil::io
