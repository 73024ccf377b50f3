// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "commands/ui_state.h"
#include "document/document_thread.h"

namespace argil::viewer {

/// One step: the list of pieces changes so.
void edit_piece(PieceEdit edit, DocumentThread& document);

/// The piece that the active one is merged with, or cut by: the chosen one, else the next in the
/// list; "" where there is no other.
std::string other_piece(const UiState& ui);

/// Combines the active piece with that one.
void merge_pieces(CombineKind kind, const UiState& ui, DocumentThread& document);

}  // namespace argil::viewer
