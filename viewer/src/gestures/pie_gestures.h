// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "commands/ui_state.h"
#include "document/document_thread.h"
#include "input/input_event.h"

namespace argil::viewer {

/// The ring that was just opened was opened by a key, which is still down: letting go of it chooses
/// where the pointer has moved, and leaves the ring open where it has not.
void hold_pie(const InputEvent& key, UiState& ui);

/// The middle of the ring as it is drawn, in pixels: where it was opened, moved as far as it needs
/// to be seen as a whole. A window smaller than the ring has it in its middle.
Camera::Pixel middle_of_pie(const UiState& ui);

/// The place in whose direction `to` lies from `from`; nothing nearer than kPieMiddle.
std::optional<std::size_t> pie_place(const Camera::Pixel& from, const Camera::Pixel& to,
                                     double scale);

/// Whether a press is for the ring, whatever panel lies below it.
bool is_for_pie(const InputEvent& event, const UiState& ui);

/// An event while the ring is open: marks, chooses or closes. `has_keyboard`: keys go to it, and to
/// no panel. True: it is taken, and does nothing else. The ring is not modal: the wheel and the
/// middle button move the view below it, and any other key does what it does, after which the ring
/// is closed.
///
/// Within a quarter second of opening the direction is that from where it was opened, so that a
/// flick means the same at the edge of a window, where the ring stands aside; later, when a hand
/// can aim at what it sees, that from the ring's middle.
bool pie_takes(const InputEvent& event, bool has_keyboard, UiState& ui, DocumentThread& document);

}  // namespace argil::viewer
