// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "input/input_event.h"

namespace argil::viewer {

struct KeyChord {
  int key = 0;
  Modifiers modifiers;
  friend bool operator==(const KeyChord&, const KeyChord&) = default;
};

/// Reads "Ctrl+Shift+Z" or "ctrl+z": names of keys in any case. Nothing for what is no chord.
std::optional<KeyChord> chord_of(std::string_view name);

/// The same as text, "Ctrl+Shift+Alt+F5"; "" for a key without a name, as that of a modifier.
std::string text_of(const KeyChord& chord);

}  // namespace argil::viewer
