// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "argil/core/result.h"

#include "input/input_event.h"

namespace argil::viewer {

// The steps of a script that plays a user (docs/viewer.md). One a frame, so that panels see a
// pointer before it presses; all letters of a text in one.

struct PlayEvent {
  InputEvent event;
};
struct WaitFrames {
  int frames = 1;
};
/// Waits until the clay has done all that was requested, images were read, and it was drawn.
struct Settle {};
/// Moves the pointer to a widget, by its label, once it stays in its place.
struct PointAt {
  std::string label;
};
/// Gives the window another size, as a user who drags its corner.
struct Resize {
  int width = 0;  ///< as ViewOptions
  int height = 0;
};
/// Stores the window as it looks then.
struct Shot {
  std::filesystem::path file;
};
struct ScriptStep {
  int line = 0;
  std::variant<PlayEvent, WaitFrames, Settle, PointAt, Resize, Shot> what;
};

/// Reads a script: a command a line, # begins a comment.
///
///   move X Y                    press|release left|right|middle [ctrl+shift+alt]
///   drag BUTTON X Y X Y [N] [MODIFIERS]      in N moves; usual 12
///   scroll STEPS                key Ctrl+Z                  type TEXT
///   hold KEY                    let KEY                     one that stays down meanwhile
///   click LABEL                 settle                      frames N
///   pen PRESSURE [eraser]       of all that follows, 0 to 1, with its other end
///   puck X Y Z RX RY RZ S       of a 3D mouse, as fractions of its reach (-1 to 1), for S seconds
///                               (0 to 10)
///   finger N X Y                of a touch screen: comes down there, or moves; N from 1 to 10
///   finger N up                 leaves
///   drop FILE                   shot FILE.png               close
///   resize WIDTH HEIGHT         of the window, in pixels of the screen
///
/// X and Y of the pointer reach from -100000 to 100000 pixels, STEPS from -100 to 100, N from 1 to
/// 10000, WIDTH from 320 and HEIGHT from 240 to 8192.
///
/// Errors  bad_input naming line and word, and for a number its range; disk.
Result<std::vector<ScriptStep>> read_input_script(const std::filesystem::path& file);

}  // namespace argil::viewer
