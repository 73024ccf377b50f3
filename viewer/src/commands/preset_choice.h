// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "commands/brush_preset.h"
#include "commands/ui_state.h"
#include "input/input_event.h"

namespace argil::viewer {

/// The preset of that name; null for none.
const BrushPreset* preset_named(const std::string& name, const UiState& ui);

/// The brush works as the preset says from now on, and nothing is measured any more.
void choose_preset(const BrushPreset& preset, UiState& ui);

/// The preset of a key that no command and no tool has; null for none.
const BrushPreset* preset_of(const KeyChord& chord, const UiState& ui);

/// The key that chooses it; "" where it has none, or a command or a tool has it.
std::string preset_key_text(const BrushPreset& preset, const UiState& ui);

/// Keeps the brush under the name that was typed, in the place of one of that name, whose key it
/// takes over. A name that cannot be is refused with words (PresetChoice).
void save_preset(UiState& ui);

/// One that is not built in; a built-in one of its name is there again.
void remove_preset(const std::string& name, UiState& ui);

/// A key that goes down while the chosen preset waits for one: given, or refused with words where
/// it is reserved or does something else. Backspace takes the key away, Esc gives up. True: it is
/// taken. Space is not, so that the force is stopped at any time.
bool preset_key_takes(const InputEvent& event, UiState& ui);

}  // namespace argil::viewer
