// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "argil/core/vec3.h"

namespace argil::viewer {

/// Keys that text input does not name: the numbers are GLFW's (window.cpp checks some). Letters and
/// digits are their upper-case ASCII.
enum Key : int {
  kKeySpace = 32,
  kKeyApostrophe = 39,
  kKeyComma = 44,
  kKeyMinus = 45,
  kKeyPeriod = 46,
  kKeySlash = 47,
  kKeySemicolon = 59,
  kKeyEqual = 61,
  kKeyLeftBracket = 91,
  kKeyBackslash = 92,
  kKeyRightBracket = 93,
  kKeyGrave = 96,
  kKeyEscape = 256,
  kKeyEnter = 257,
  kKeyTab = 258,
  kKeyBackspace = 259,
  kKeyInsert = 260,
  kKeyDelete = 261,
  kKeyRight = 262,
  kKeyLeft = 263,
  kKeyDown = 264,
  kKeyUp = 265,
  kKeyPageUp = 266,
  kKeyPageDown = 267,
  kKeyHome = 268,
  kKeyEnd = 269,
  kKeyPause = 284,
  kKeyF1 = 290,
  kKeyF12 = 301,
  kKeyPad0 = 320,
  kKeyPad9 = 329,
  kKeyPadPeriod = 330,
  kKeyPadDivide = 331,
  kKeyPadTimes = 332,
  kKeyPadMinus = 333,
  kKeyPadPlus = 334,
  kKeyPadEnter = 335
};

struct Modifiers {
  bool shift = false;
  bool ctrl = false;
  bool alt = false;
  friend bool operator==(const Modifiers&, const Modifiers&) = default;
};

enum class MouseButton { left, right, middle };

/// One thing that the user, or a script, did to the window.
struct InputEvent {
  enum class Kind {
    move,
    press,
    release,
    scroll,
    puck,
    finger_down,
    finger_move,
    finger_up,
    key_down,
    key_up,
    text,
    drop,
    away,  ///< another window has the keyboard from now on; keys that are down are let go next
    close
  };
  Kind kind = Kind::move;
  double time_s = 0.0;  ///< of the window's clock
  double x = 0.0;       ///< of the pointer in pixels from the upper left, always the newest
  double y = 0.0;
  double pressure = 1.0;   ///< of a pen, 0 to 1
  bool is_eraser = false;  ///< it is held the other way round
  MouseButton button = MouseButton::left;
  double steps = 0.0;  ///< scroll: positive away from the user
  /// puck, of a 3D mouse: how far it is pushed, to the right, up and away from the user, and how
  /// far turned about these, as fractions of its reach; and how long so.
  Vec3 puck_shift;
  Vec3 puck_turn;
  double puck_s = 0.0;
  unsigned finger =
      0;  ///< on a touch screen, whose place x and y are then: its own until it leaves
  int key = 0;
  bool is_repeat = false;
  Modifiers modifiers;
  unsigned character = 0;          ///< text: Unicode
  std::vector<std::string> files;  ///< drop
};

}  // namespace argil::viewer
