// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "argil/io/stroke_script.h"

namespace argil::viewer {

/// The steps that undo and redo walk along, beside the clay's own, which has no names for them.
///
/// Threads  one.
class StepHistory {
 public:
  /// A step that was just applied to the clay: undo and redo move the position in the list;
  /// everything else cuts off what was taken back.
  /// `is_stamp`: a stroke that is called a stamp.
  void record(const io::ScriptStep& step, bool is_stamp = false);

  /// Keeps what the clay can still do: it forgets its oldest steps where its memory ends, and one
  /// that was recovered cannot repeat all that was taken back.
  void keep(std::size_t undo_depth, std::size_t redo_depth);

  void clear() { *this = {}; }

  const std::vector<io::ScriptStep>& steps() const noexcept { return steps_; }  ///< oldest first
  const std::vector<std::string>& names() const noexcept { return names_; }     ///< of each
  std::size_t done() const noexcept { return done_; }  ///< of them; the others were taken back

  /// A number for what the work is at this position of the list: the same whenever undo or redo
  /// comes back to it, and never that of another. 0 only before the first step.
  std::uint64_t state() const noexcept { return done_ > 0 ? states_[done_ - 1] : first_state_; }

 private:
  std::uint64_t& state_here() noexcept { return done_ > 0 ? states_[done_ - 1] : first_state_; }

  std::vector<io::ScriptStep> steps_;
  std::vector<std::string> names_;
  std::vector<std::uint64_t> states_;  // after each
  std::uint64_t first_state_ = 0;
  std::uint64_t last_state_ = 0;  // that was given to one
  std::size_t done_ = 0;
};

/// A step in a word or two: "Draw, 5 mm", "Hollow, wall 2 mm", "Mask cleared".
std::string name_of_step(const io::ScriptStep& step, bool is_stamp = false);

}  // namespace argil::viewer
