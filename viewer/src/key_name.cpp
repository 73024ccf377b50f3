// SPDX-License-Identifier: GPL-3.0-or-later
#include "key_name.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

namespace argil::viewer {
namespace {

constexpr std::pair<int, std::string_view> kNames[] = {{kKeySpace, "Space"},
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

std::string key_text(int key) {
  for (const auto& [number, name] : kNames) {
    if (number == key) return std::string(name);
  }
  if (key >= kKeyF1 && key <= kKeyF12)
    return std::string(1, 'F').append(std::to_string(key - kKeyF1 + 1));
  if (key >= kKeyPad0 && key <= kKeyPad9)
    return std::string("Num").append(std::to_string(key - kKeyPad0));
  return std::string(1, static_cast<char>(key));
}

int key_of(const std::string& lowered) {
  for (const auto& [number, name] : kNames) {
    if (lower(name) == lowered) return number;
  }
  if (lowered.size() == 1 && std::isalnum(static_cast<unsigned char>(lowered[0])) != 0) {
    return std::toupper(static_cast<unsigned char>(lowered[0]));
  }
  for (int key = kKeyF1; key <= kKeyF12; ++key) {
    if (lower(key_text(key)) == lowered) return key;
  }
  for (int key = kKeyPad0; key <= kKeyPad9; ++key) {
    if (lower(key_text(key)) == lowered) return key;
  }
  return 0;
}

}  // namespace

std::string name_of(const KeyChord& chord) {
  std::string text;
  if (chord.modifiers.ctrl) text += "Ctrl+";
  if (chord.modifiers.shift) text += "Shift+";
  if (chord.modifiers.alt) text += "Alt+";
  return text.append(key_text(chord.key));
}

std::optional<KeyChord> chord_of(std::string_view name) {
  KeyChord chord;
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
