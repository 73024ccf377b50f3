// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/key_name.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <iterator>
#include <utility>

namespace argil::viewer {
namespace {

/// Keys that are neither letters, digits, F keys nor digits of the numpad.
constexpr std::pair<int, std::string_view> kNames[] = {{kKeySpace, "Space"},
                                                       {kKeyApostrophe, "'"},
                                                       {kKeyComma, ","},
                                                       {kKeyMinus, "-"},
                                                       {kKeySlash, "/"},
                                                       {kKeySemicolon, ";"},
                                                       {kKeyEqual, "="},
                                                       {kKeyBackslash, "\\"},
                                                       {kKeyGrave, "`"},
                                                       {kKeyInsert, "Insert"},
                                                       {kKeyPageUp, "PageUp"},
                                                       {kKeyPageDown, "PageDown"},
                                                       {kKeyPause, "Pause"},
                                                       {kKeyPadDivide, "NumDivide"},
                                                       {kKeyPadTimes, "NumTimes"},
                                                       {kKeyPadMinus, "NumMinus"},
                                                       {kKeyPadPlus, "NumPlus"},
                                                       {kKeyPeriod, "."},
                                                       {kKeyLeftBracket, "["},
                                                       {kKeyRightBracket, "]"},
                                                       {kKeyEscape, "Esc"},
                                                       {kKeyEnter, "Enter"},
                                                       {kKeyTab, "Tab"},
                                                       {kKeyBackspace, "Backspace"},
                                                       {kKeyDelete, "Delete"},
                                                       {kKeyRight, "Right"},
                                                       {kKeyLeft, "Left"},
                                                       {kKeyDown, "Down"},
                                                       {kKeyUp, "Up"},
                                                       {kKeyHome, "Home"},
                                                       {kKeyEnd, "End"},
                                                       {kKeyPadPeriod, "Num."},
                                                       {kKeyPadEnter, "NumEnter"}};

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// GLFW's number of a key by its name; 0: no such key.
int key_of(const std::string& lowered) {
  assert(lowered == lower(lowered));
  for (const auto& [number, name] : kNames) {
    if (lower(name) == lowered) return number;
  }
  if (lowered.size() == 1 && std::isalnum(static_cast<unsigned char>(lowered[0])) != 0) {
    return std::toupper(static_cast<unsigned char>(lowered[0]));
  }
  for (int key = kKeyF1; key <= kKeyF12; ++key) {
    if (lowered == "f" + std::to_string(key - kKeyF1 + 1)) return key;
  }
  for (int key = kKeyPad0; key <= kKeyPad9; ++key) {
    if (lowered == "num" + std::to_string(key - kKeyPad0)) return key;
  }
  return 0;
}

/// The name by which key_of() finds it; "" where it does not.
std::string key_text(int key) {
  for (const auto& [number, name] : kNames) {
    if (number == key) return std::string(name);
  }
  if ((key >= 'A' && key <= 'Z') || (key >= '0' && key <= '9')) {
    return std::string(1, static_cast<char>(key));
  }
  if (key >= kKeyF1 && key <= kKeyF12) return "F" + std::to_string(key - kKeyF1 + 1);
  if (key >= kKeyPad0 && key <= kKeyPad9) return "Num" + std::to_string(key - kKeyPad0);
  return {};
}

}  // namespace

std::string text_of(const KeyChord& chord) {
  const std::string key = key_text(chord.key);
  if (key.empty()) return {};
  const Modifiers& held = chord.modifiers;
  std::string text = held.ctrl ? "Ctrl+" : "";
  if (held.shift) text += "Shift+";
  if (held.alt) text += "Alt+";
  return text + key;
}

std::optional<KeyChord> chord_of(std::string_view name) {
  KeyChord chord;
  // What stands before a plus is a modifier; the plus itself names no key.
  std::string rest = lower(name);
  for (std::size_t plus = rest.find('+'); plus != std::string::npos; plus = rest.find('+')) {
    const std::string modifier = rest.substr(0, plus);
    rest.erase(0, plus + 1);
    if (modifier == "ctrl") {
      chord.modifiers.ctrl = true;
    } else if (modifier == "shift") {
      chord.modifiers.shift = true;
    } else if (modifier == "alt") {
      chord.modifiers.alt = true;
    } else {
      return std::nullopt;
    }
  }
  chord.key = key_of(rest);
  if (chord.key == 0) return std::nullopt;
  return chord;
}

}  // namespace argil::viewer
