// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "argil/haptics/bridge/bridge_mesh.h"
#include "argil/io/session.h"

namespace argil::cli::bridge {

/// The strokes of a session of which nobody looks at a screen: one that the disk does not take is
/// taken back, so that what is felt is what is kept, and no other may begin until the disk takes
/// what it is given. Both are said on standard error. So is that an autosave failed, which costs no
/// stroke: without it a recovery only takes longer.
///
/// Threads  the clay's.
class KeptStrokes {
 public:
  /// `session` must outlive it.
  explicit KeptStrokes(io::Session& session) noexcept : session_(session) {}

  /// Keeps a stroke that was just worked, as io::Session::record.
  void record(const Stroke& stroke);

  /// Whether a stroke may begin.
  bool may_begin() const noexcept { return refusal_.empty(); }

  /// Between strokes: looks at what became of them. A disk that failed is tried again every half
  /// second. True when the note is another than before.
  bool look();

  /// Waits for the disk, and looks for the last time.
  void finish();

  /// What became of the strokes so far.
  const haptics::MeshNote& note() const noexcept { return note_; }

 private:
  void refuse(const Error& cause);
  void try_again();
  void tell_of_autosave();

  io::Session& session_;
  std::deque<std::size_t> unsure_;  ///< of each stroke that may be on the disk or not: step_count()
  std::string refusal_;             ///< why none may begin; "": one may
  std::string autosave_;            ///< why the last one failed, as it was said; "": it did not
  std::chrono::steady_clock::time_point tried_;
  haptics::MeshNote note_;
};

}  // namespace argil::cli::bridge
