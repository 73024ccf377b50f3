// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "commands/search_choice.h"
#include "commands/ui_state.h"
#include "document/document_thread.h"
#include "input/input_event.h"

namespace argil::viewer {

struct SearchEntry {
  KeyAim aim;
  std::string title;
  std::string place;  ///< the menu that lists it, or "Tool"
  std::string chord;  ///< "" none
};

/// How well a text is meant by what was typed: its letters must stand there in their order, in any
/// case, blanks left out. More for those that follow each other and those that begin a word; below
/// zero where one is missing.
int match_of(std::string_view typed, std::string_view text);

/// All commands but the search itself, and all tools; those that match, the best first. Without a
/// text those that were done last come first, then all in the order of the menus. With the keys
/// that they have.
std::vector<SearchEntry> found_entries(const SearchChoice& choice, const KeyMap& keys);

/// Whether a key tells a letter too, or another character: those without Ctrl and Alt that are no
/// F keys and the like.
bool types_letter(const KeyChord& chord) noexcept;

/// A key or a letter while the search is open: types, moves, does what is marked (with Ctrl makes
/// it a favourite, or none any more), or closes it. True: it is taken.
bool search_takes(const InputEvent& event, UiState& ui, DocumentThread& document);

/// Whether it can be done now.
bool is_possible(const SearchEntry& entry, const UiState& ui);
/// Closes the search and does it; what cannot be done now leaves the search open.
void do_found(const SearchEntry& entry, UiState& ui, DocumentThread& document);

}  // namespace argil::viewer
