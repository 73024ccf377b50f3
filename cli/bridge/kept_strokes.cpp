// SPDX-License-Identifier: GPL-3.0-or-later
// Strokes that are shown must be kept: what the journal cannot write is taken back, and no stroke
// begins until it can again.
#include "bridge/kept_strokes.h"

#include <cassert>
#include <cstdio>
#include <utility>

namespace argil::cli::bridge {
namespace {

using Clock = std::chrono::steady_clock;
/// A full disk is asked twice a second: soon enough for a person, seldom enough for the disk.
constexpr std::chrono::milliseconds kTryEvery{500};

}  // namespace

void KeptStrokes::record(const Stroke& stroke) {
  session_.record(stroke);
  assert(unsure_.empty() || unsure_.back() < session_.step_count());  // ascending
  unsure_.push_back(session_.step_count());
}

bool KeptStrokes::look() {
  const haptics::MeshNote before = note_;
  if (!may_begin()) try_again();
  const Result<void> state = session_.journal_state();
  const std::size_t kept = session_.kept_count();
  // Numbers ascend: all up to the first that is not on the disk are kept.
  while (!unsure_.empty() && unsure_.front() <= kept) {
    unsure_.pop_front();
    ++note_.kept;
  }
  if (!state) {
    // A stroke that is under way cannot be undone; at its end it is.
    if (!session_.clay().is_stroke_open()) refuse(state.error());
  } else if (!may_begin()) {
    refusal_.clear();
    std::fprintf(stderr, "argil: strokes are kept again\n");
  }
  if (state) tell_of_autosave();
  note_.text = refusal_;
  return note_ != before;
}

void KeptStrokes::finish() {
  static_cast<void>(session_.flush().ok());  // look() asks how it ended
  look();
}

void KeptStrokes::try_again() {
  if (Clock::now() - tried_ < kTryEvery) return;
  tried_ = Clock::now();
  static_cast<void>(session_.flush().ok());  // look() asks how it ended
}

/// While the journal is written, the only problem there can be.
void KeptStrokes::tell_of_autosave() {
  const Result<void> problem = session_.problem();
  std::string why = problem ? std::string() : problem.error().message;
  if (why == autosave_) return;
  autosave_ = std::move(why);
  if (autosave_.empty()) return;
  std::fprintf(stderr, "argil: the autosave failed, the journal goes on: %s\n", autosave_.c_str());
}

/// Takes back what is not on the disk. The journal is told so: a stroke of which it has a piece, or
/// all where only the sync failed, is followed by its undo.
void KeptStrokes::refuse(const Error& cause) {
  std::size_t taken_back = 0;
  while (!unsure_.empty() && session_.sculpture().undo()) {
    session_.record(io::HistoryStep::undo);
    unsure_.pop_back();
    ++taken_back;
  }
  note_.refused += taken_back;
  if (taken_back == 0 && !may_begin()) return;
  tried_ = Clock::now();
  refusal_ = "strokes are refused until they can be kept: " + cause.message;
  const std::string back = taken_back == 1 ? "; the last one was taken back"
                           : taken_back > 0
                               ? "; the last " + std::to_string(taken_back) + " were taken back"
                               : "";
  std::fprintf(stderr, "argil: %s%s\n", refusal_.c_str(), back.c_str());
}

}  // namespace argil::cli::bridge
