// SPDX-License-Identifier: GPL-3.0-or-later
#include "keys/mouse_habit.h"

namespace argil::viewer {
namespace {

PressMeaning as_zbrush(MouseButton button, const Modifiers& held) noexcept {
  using What = PressMeaning::What;
  PressMeaning meaning;
  if (button == MouseButton::middle) meaning.what = What::move;
  if (button == MouseButton::right) meaning.what = held.alt ? What::move : What::turn;
  if (button != MouseButton::left) return meaning;
  if (held.alt) meaning.beside = What::move;
  meaning.is_mask = held.ctrl && !held.shift;
  // With Ctrl and Shift a lasso masks, as in the other sets.
  meaning.held = {held.shift, held.ctrl && held.shift ? true : held.alt, false};
  return meaning;
}

}  // namespace

PressMeaning meaning_of(KeySet set, MouseButton button, const Modifiers& held) noexcept {
  using What = PressMeaning::What;
  if (set == KeySet::zbrush) return as_zbrush(button, held);
  PressMeaning meaning;
  meaning.held = held;
  const bool is_middle = button == MouseButton::middle;
  const bool turns_by_middle = set == KeySet::blender && is_middle && !held.shift;
  // Alt stands in for the right button on trackpads and pens.
  const bool is_right = button == MouseButton::right || held.alt;
  if (!turns_by_middle && (is_middle || (is_right && held.shift))) {
    meaning.what = What::move;
  } else if (turns_by_middle || is_right) {
    meaning.what = What::turn;
  }
  return meaning;
}

MouseWords mouse_words(KeySet set) noexcept {
  switch (set) {
    case KeySet::blender:
      return {"Middle",
              "Right",
              "Shift+Middle",
              "Shift+Right",
              "Ctrl+Left",
              "",
              "middle: turn, with Shift: move"};
    case KeySet::zbrush:
      return {"Right",
              "Left beside it",
              "Alt+Right",
              "Middle",
              "Alt+Left",
              "Ctrl+Left",
              "right: turn, with Alt: move"};
    case KeySet::argil:
      break;
  }
  return {
      "Right", "Alt+Left", "Middle", "Shift+Right", "Ctrl+Left", "", "middle: move, right: turn"};
}

}  // namespace argil::viewer
