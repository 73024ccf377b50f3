// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>

#include "commands/ui_state.h"
#include "document/document_thread.h"
#include "input/input_event.h"

namespace argil::viewer {

/// Fingers on a touch screen. One alone is the pointer: the window system makes that of it. Two
/// move the view by their middle and bring it nearer by how far they are apart; a tap of two takes
/// a step back, one of three takes it again.
///
/// Threads  the window's.
class TouchGestures {
 public:
  TouchGestures(UiState& ui, DocumentThread& document) : ui_(ui), document_(document) {}

  /// A finger came, moved or left. True when it is the second: what the first has begun is over.
  bool on(const InputEvent& event);

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
  bool press(const InputEvent& event);
  void move(const InputEvent& event);
  void lift(const InputEvent& event);
  Spread spread() const;
  bool is_beyond_tap(const Finger& finger) const;

  UiState& ui_;
  DocumentThread& document_;
  std::map<unsigned, Finger> fingers_;  ///< that are down
  std::size_t most_ = 0;                ///< at once, since the first came
  double first_s_ = 0.0;                ///< when that was
  bool has_view_ = false;
  bool has_moved_ = false;  ///< farther than in a tap
};

}  // namespace argil::viewer
