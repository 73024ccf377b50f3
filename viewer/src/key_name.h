// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "input_event.h"

namespace argil::viewer {

struct KeyChord {
  int key = 0;
  Modifiers modifiers;
  friend bool operator==(const KeyChord&, const KeyChord&) = default;
};

/// "Ctrl+Shift+Z", as the help shows it; and back, in any case. Nothing for what is no chord.
std::string name_of(const KeyChord& chord);
std::optional<KeyChord> chord_of(std::string_view name);

}  // namespace argil::viewer
