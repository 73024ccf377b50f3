// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "input/input_event.h"
#include "keys/key_map.h"

namespace argil::viewer {

/// What a press over the picture begins.
struct PressMeaning {
  enum class What { work, turn, move } what = What::work;
  What beside = What::turn;  ///< of What::work: where there is no clay under the pointer
  Modifiers held;            ///< of What::work: as Argil's own set has them, Ctrl for the opposite
  bool is_mask = false;      ///< of What::work: paints the mask, whatever the tool
};

/// By the habits of the program that the keys are of. Argil: right, or Alt and left, turn; middle,
/// or Shift and right, or Alt and Shift, move. Blender: middle turns, and moves with Shift; the
/// rest as Argil's, which has the same Ctrl and Shift. ZBrush: right turns, and moves with Alt; on
/// the clay Alt and left do the opposite, Ctrl and left mask (with Alt they unmask); beside it
/// left turns, and moves with Alt.
PressMeaning meaning_of(KeySet set, MouseButton button, const Modifiers& held) noexcept;

/// The same in words, for help and status line: "right: turn".
struct MouseWords {
  const char* turn = "";
  const char* turn_too = "";
  const char* move = "";
  const char* move_too = "";
  const char* opposite = "";
  const char* mask = "";         ///< "": only by the tool
  const char* status_line = "";  ///< what the other buttons do, briefly
};
MouseWords mouse_words(KeySet set) noexcept;

}  // namespace argil::viewer
