// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "commands/favourites.h"
#include "commands/ui_state.h"

namespace argil::viewer {

/// Its place in the ring; nothing for what has none.
std::optional<std::size_t> place_of(const Favourite& favourite, const UiState& ui);

/// Gives it the first free place, or takes it out of the one that it has; says which. A ring
/// without a free place, and what can have none, is said too.
void toggle_favourite(const Favourite& favourite, UiState& ui);

/// Does what a place holds, or chooses its tool or brush. A brush that is gone is said.
void do_favourite(std::size_t place, UiState& ui, DocumentThread& document);

/// Whether that does anything now: nothing is there, a command may have to wait, a brush be gone.
bool can_do(const std::optional<Favourite>& favourite, const UiState& ui);

}  // namespace argil::viewer
