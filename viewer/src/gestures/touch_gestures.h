// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>

#include "commands/ui_state.h"
#include "input/input_event.h"
#include "keys/command_info.h"

namespace argil::viewer {

/// Fingers on a touch screen. One alone is the pointer: the window system makes that of it. Two
/// move the view by their middle and bring it nearer by how far they are apart; a tap of two takes
/// a step back, one of three takes it again.
///
/// Threads  the window's.
class TouchGestures {
 public:
  struct Answer {
    bool begins_view = false;        ///< a second finger has come: what the first has begun is over
    std::optional<Command> command;  ///< what a tap asks for
  };

  explicit TouchGestures(UiState& ui) : ui_(ui) {}

  /// A finger came, moved or left. `is_taken`: the first works a panel, or a dialog asks; then they
  /// are no view until all have left.
  Answer on(const InputEvent& event, bool is_taken);

  /// From the second finger on until all have left: the pointer is one of them, and works nothing.
  bool has_view() const noexcept { return has_view_; }

 private:
  struct Finger {
    Camera::Pixel down;
    Camera::Pixel at;
  };
  /// The middle of all fingers, and how far they are from it on average.
  struct Spread {
    Camera::Pixel middle;
    double radius = 0.0;
  };
  bool press(const InputEvent& event, bool is_taken);
  void move(const InputEvent& event);
  std::optional<Command> lift(const InputEvent& event);
  Spread spread() const;
  bool is_beyond_tap(const Finger& finger) const;

  UiState& ui_;
  std::map<unsigned, Finger> fingers_;  ///< that are down
  std::size_t most_ = 0;                ///< at once, since the first came
  double first_s_ = 0.0;                ///< when that was
  bool has_view_ = false;
  bool is_of_panel_ = false;  ///< until all have left
  bool has_moved_ = false;    ///< farther than in a tap
};

}  // namespace argil::viewer
