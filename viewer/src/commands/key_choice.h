// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "commands/ui_state.h"
#include "input/input_event.h"

namespace argil::viewer {

/// From now on the next key is for this aim, unless its key is fixed.
void wait_for_key(const KeyAim& aim, UiState& ui);

/// A key that goes down while one is waited for: given, asked about where something else has it, or
/// refused with words (KeyChoice). Esc gives up. True: it is taken. Space is not, so that the force
/// is stopped at any time.
bool key_choice_takes(const InputEvent& event, UiState& ui);

/// The answer to what is asked: it is taken from what has it, or nothing changes.
void answer_key_question(bool takes_it, UiState& ui);

/// Whether a text that was typed means the aim: part of its title, its menu or its key, in any
/// case.
bool is_meant_by(const std::string& typed, const KeyAim& aim, const KeyMap& keys);

}  // namespace argil::viewer
