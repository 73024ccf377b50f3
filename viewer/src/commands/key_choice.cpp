// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/key_choice.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <string_view>

#include "keys/command_info.h"

namespace argil::viewer {
namespace {

/// Ctrl, Shift, Alt, Super, left and right: GLFW's numbers 340 to 347.
bool is_modifier_key(int key) { return key >= 340 && key <= 347; }

bool contains_any_case(std::string_view text, std::string_view part) {
  const auto is_same = [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b);
  };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), is_same) != text.end();
}

}  // namespace

void wait_for_key(const KeyAim& aim, UiState& ui) {
  const std::string filter = ui.key_choice.filter;
  ui.key_choice = {};
  ui.key_choice.filter = filter;
  if (!is_fixed(aim)) ui.key_choice.waiting = aim;
}

bool key_choice_takes(const InputEvent& event, UiState& ui) {
  assert(event.kind == InputEvent::Kind::key_down);
  KeyChoice& choice = ui.key_choice;
  if (!ui.panels.has_keys || !choice.waiting) return false;
  if (event.is_repeat || is_modifier_key(event.key)) return true;
  if (event.key == kKeyEscape) {
    choice.waiting.reset();
    choice.wanted.reset();
    choice.refused.clear();
    return true;
  }
  const KeyChord chord{event.key, event.modifiers};
  choice.wanted.reset();
  choice.refused = why_reserved(chord);
  if (!choice.refused.empty()) return event.key != kKeySpace;
  if (text_of(chord).empty()) {
    choice.refused = "this key has no name to be kept by; take another";
    return true;
  }
  const auto owner = ui.keys.aim_of(chord);
  if (owner && owner != choice.waiting) {
    choice.wanted = chord;
    return true;
  }
  ui.keys.give(*choice.waiting, chord);
  choice.waiting.reset();
  return true;
}

void answer_key_question(bool takes_it, UiState& ui) {
  KeyChoice& choice = ui.key_choice;
  assert(choice.waiting && choice.wanted);
  if (takes_it) ui.keys.give(*choice.waiting, choice.wanted);
  choice.waiting.reset();
  choice.wanted.reset();
}

bool is_meant_by(const std::string& typed, const KeyAim& aim, const KeyMap& keys) {
  const auto* command = std::get_if<Command>(&aim);
  const char* const menu = command != nullptr ? info_of(*command).menu : "Tool";
  return contains_any_case(title_of(aim), typed) || contains_any_case(menu, typed) ||
         contains_any_case(keys.text_of(aim), typed);
}

}  // namespace argil::viewer
