// SPDX-License-Identifier: GPL-3.0-or-later
// What a session keeps for undo beyond its end, and how the next one reads it. docs/files.md says
// why every order of the writes is safe.
#include <cassert>
#include <system_error>
#include <utility>

#include "argil/core/hash_text.h"
#include "argil/core/no_throw.h"
#include "argil/io/project_file.h"
#include "argil/io/safe_file.h"

#include "project/history_cut.h"
#include "project/session_state.h"
#include "script/step_solid.h"

namespace argil::io {
namespace fs = std::filesystem;

Result<void> write_journal_text(const fs::path& file, const std::string& text) {
  return replace_file(file, [&](const fs::path& temporary) -> Result<void> {
    OutputFile out(temporary);
    out.write(text);
    return out.close();
  });
}

namespace {

/// For each step the bytes of the solid that it works with and no later one does: what goes when
/// the journal is cut behind it.
std::vector<std::uint64_t> solid_bytes_of_steps(const Journal& journal, const SessionFiles& files) {
  std::vector<std::uint64_t> bytes(journal.steps.size(), 0);
  std::set<std::string> later;
  for (std::size_t n = journal.steps.size(); n-- > 0;) {
    const auto solid = solid_of(journal.steps[n]);
    if (!solid) continue;
    const std::string name = name_of(*solid, files.solid_front).file;
    if (later.insert(name).second) bytes[n] = bytes_of_file(files.project.parent_path() / name);
  }
  return bytes;
}

/// Files of what the steps from `first` on work with.
std::set<std::string> solids_of_steps(const Journal& journal, std::size_t first,
                                      const std::string& front) {
  std::set<std::string> solids;
  for (std::size_t n = first; n < journal.steps.size(); ++n) {
    if (const auto solid = solid_of(journal.steps[n])) solids.insert(name_of(*solid, front).file);
  }
  return solids;
}

}  // namespace

std::string mark_of(const std::string& hash, std::size_t steps) {
  return sealed_line(mark_line({hash, steps}));
}

std::string mark_of(const Sculpture& sculpture, std::size_t steps) {
  return mark_of(hash_text(sculpture.hash()), steps);
}

Error history_is_lost(const fs::path& project, const std::string& why) {
  return {ErrorKind::bad_input,
          "undo ends where " + quoted_name(project) +
              " was opened; the steps before cannot be repeated, and go when it is closed: " + why};
}

Result<std::vector<FileAside>> put_aside(const SessionFiles& files, const std::string& word,
                                         std::vector<std::string>& notes) {
  std::vector<FileAside> names;
  for (const fs::path& file : {files.journal, files.origin}) {
    auto aside = keep_aside(file, word);
    if (!aside) return aside.error();
    if (!aside.value()) continue;
    notes.push_back(quoted_name(file) + " is kept as " + quoted_name(*aside.value()));
    names.push_back({file, *std::move(aside).value()});
  }
  if (auto removed = remove_if_there(files.autosave); !removed) return removed.error();
  return names;
}

// ---- reading -----------------------------------------------------------------------------------

bool Session::has_older_steps() const noexcept {
  return state_->first_step > 0 && state_->history_lost.empty();
}

HistorySize Session::history_size() const {
  return {state_->steps, state_->journal->durable_bytes() + state_->beside_bytes};
}

Result<std::vector<ScriptStep>> Session::told_steps() {
  return no_throw(state_->files.project.string(), [&]() -> Result<std::vector<ScriptStep>> {
    if (state_->steps == 0) return std::vector<ScriptStep>();
    auto told = state_->told();
    if (!told) return told.error();
    return std::move(told.value().steps);
  });
}

namespace {

/// The sculpture that the steps lead to from the state that they start from, or, as a message, why
/// there is none.
struct MadeAnew {
  std::optional<Sculpture> sculpture;
  std::string problem;
};

/// Errors  what another try may bring: memory, interrupted, disk.
Result<MadeAnew> make_anew(const fs::path& base, const Journal& journal, std::uint64_t hash,
                           const ClayLimits& limits, const Progress& progress) {
  MadeAnew made;
  // A state that was there twice: what can be undone or redone from it is not the same.
  for (std::size_t n = 0;; ++n) {
    auto origin = load_sculpture(base);
    if (!origin && origin.error().kind != ErrorKind::bad_input) return origin.error();
    if (!origin) return MadeAnew{std::nullopt, origin.error().message};
    Sculpture& sculpture = origin.value();
    const auto from = journal.positions_of(hash_text(sculpture.hash()));
    if (n == 0 && from.empty()) made.problem = quoted_name(base) + " is not what they start from";
    if (n == from.size()) return made;
    if (auto set = sculpture.set_limits(limits); !set) return set.error();
    auto repeated = repeat_steps(sculpture, journal, from[n], "read the history", progress);
    if (!repeated) return repeated.error();
    const bool is_whole = repeated.value().steps == journal.steps.size();
    if (is_whole && sculpture.hash() == hash) return MadeAnew{std::move(sculpture), {}};
    made.problem = is_whole ? "they lead to another clay" : repeated.value().stopped_by;
  }
}

}  // namespace

/// Steps that lead to the sculpture as it is are its history.
Result<void> Session::State::deepen(const Progress& progress) {
  const auto lost = [&](std::string why) {
    history_lost = std::move(why);
    return history_is_lost(files.project, history_lost);
  };
  const auto all = told();
  if (!all) {
    if (all.error().kind != ErrorKind::bad_input) return all.error();
    return lost(all.error().message);
  }
  auto made = make_anew(base(), all.value(), sculpture.hash(), options.limits, progress);
  if (!made) return made.error();
  if (!made.value().sculpture) return lost(std::move(made.value().problem));
  // An autosave that has begun knows pieces by their numbers, which are others now.
  copy.reset();
  sculpture.take_history(*std::move(made.value().sculpture));
  first_step = 0;
  return {};
}

Result<void> Session::deepen(const Progress& progress) {
  if (!has_older_steps() || clay().is_stroke_open()) return {};
  return no_throw(state_->files.project.string(), [&] { return state_->deepen(progress); });
}

// ---- keeping -----------------------------------------------------------------------------------

void Session::State::weigh_history() {
  beside_bytes = bytes_of_file(files.origin) + bytes_of_solids(files);
}

/// The journal first: without it the others mean nothing, without them it would mean less.
Result<void> Session::State::remove_history() {
  for (const fs::path& file : {files.journal, files.autosave, files.origin}) {
    if (auto removed = remove_if_there(file); !removed) return removed;
  }
  return remove_solids(files, {});
}

/// Once the project holds every step.
Result<void> Session::State::end_history() {
  assert(steps == saved_steps);
  if (!keeps_history() || steps == 0 || !is_there(files.origin)) return remove_history();
  // Told when it was found. The project has all that these steps led to.
  if (!history_lost.empty()) return remove_history();
  if (auto removed = remove_if_there(files.autosave); !removed) return removed;
  mark_as_closed();
  return shorten_history();
}

/// So that an older copy of the project, put in its place, is not taken for one that lacks steps.
/// Where the disk refuses that, all else still holds.
void Session::State::mark_as_closed() {
  if (is_closed) return;
  const std::string hash = saved_hash.empty() ? hash_text(sculpture.hash()) : saved_hash;
  journal->push_mark(sealed_line(mark_line({hash, saved_steps, true})));
  static_cast<void>(journal->flush().ok());
}

/// From too much history the oldest steps go: half of what it may be is left, so that this is rare.
/// The state it starts from then is where undo leads, which is as exact as the steps and takes a
/// moment; it reaches no further back than memory does. So a history that is mostly of earlier
/// sessions may grow to twice the bound first.
Result<void> Session::State::shorten_history() {
  const std::uint64_t bytes = journal->durable_bytes() + bytes_of_solids(files);
  const std::size_t most = options.history_steps;
  if (steps <= most && bytes <= options.history_bytes) return {};
  const bool is_far_too_much = steps > 2 * most || bytes > 2 * options.history_bytes;
  const auto text = read_journal_bytes(files.journal);
  if (!text) return text.error();
  if (!text.value()) return {};
  const auto whole = parse_journal(files.journal, text_of(*text.value()));
  if (!whole) return whole.error();
  if (whole.value().steps.size() != steps || !whole.value().damage.empty()) return remove_history();
  // Those of steps that are no more first: they may be what weighs.
  if (auto removed = remove_solids(files, whole.value().solids); !removed) return removed;
  const auto solid_bytes = solid_bytes_of_steps(whole.value(), files);
  const int undos = sculpture.undo_depth();
  auto cut = history_cut(whole.value(), solid_bytes, {most / 2, options.history_bytes / 2, undos});
  // One of few heavy steps may have none within the half.
  if (!cut) cut = history_cut(whole.value(), solid_bytes, {most, options.history_bytes, undos});
  const bool is_enough = cut && steps - cut->first >= most / 4;
  if (!is_enough && !is_far_too_much) return {};
  if (!cut) return remove_history();
  if (cut->first == 0) return {};
  cut_history(whole.value(), text_of(*text.value()), *cut);
  return {};
}

/// Takes the sculpture back to the cut: the session is over. What the disk refuses leaves the
/// history as long as it is.
void Session::State::cut_history(const Journal& whole, std::string_view text,
                                 const HistoryCut& cut) {
  const std::string end_hash = hash_text(sculpture.hash());
  for (int n = 0; n < cut.undos; ++n) {
    if (!sculpture.undo()) return;
  }
  const std::string base_hash = hash_text(sculpture.hash());
  // The mark before the new origin, so that both journals know it.
  journal->push_mark(mark_of(base_hash, cut.first));
  if (!journal->flush()) return;
  if (!save_sculpture(files.origin, sculpture)) return;
  const std::string left = shortened(whole, text, cut.first, base_hash, end_hash);
  if (!write_journal_text(files.journal, left)) return;
  const auto wanted = solids_of_steps(whole, cut.first, files.solid_front);
  static_cast<void>(remove_solids(files, wanted).ok());
}

Result<void> Session::forget_history() {
  return no_throw(state_->files.project.string(), [&]() -> Result<void> {
    if (clay().is_stroke_open()) {
      return Error{ErrorKind::bad_input, "a stroke is open; end it before the history goes"};
    }
    if (auto saved = state_->save(false); !saved) return saved;
    return state_->forget_history();
  });
}

/// Once the project holds every step. Without their journal the other files mean nothing.
Result<void> Session::State::forget_history() {
  const std::uint64_t bytes = journal->durable_bytes();
  journal.reset();
  if (auto removed = remove_if_there(files.journal); !removed) {
    start_journal("", bytes);
    return removed;
  }
  static_cast<void>(remove_history().ok());
  sculpture.forget_history();
  steps = saved_steps = autosaved_steps = 0;
  opened_bytes = saved_bytes = 0;
  had_origin = false;
  first_step = 0;
  history_lost.clear();
  solids.clear();
  opened_solids.clear();
  saved_solids.clear();
  weigh_history();
  start_journal(hash_text(sculpture.hash()), 0);
  return {};
}

}  // namespace argil::io
