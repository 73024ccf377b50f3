// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/piece_edits.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace argil::viewer {

void edit_piece(PieceEdit edit, DocumentThread& document) {
  document.send(DoStep{std::move(edit)});
}

std::string other_piece(const UiState& ui) {
  if (!ui.clay.pieces || ui.clay.pieces->pieces.size() < 2) return "";
  const PieceList& list = *ui.clay.pieces;
  for (const PieceState& piece : list.pieces) {
    const bool is_active = piece.key == list.active_piece().key;
    if (piece.key == ui.pieces.other && !is_active) return piece.look.name;
  }
  return list.pieces[(list.active + 1) % list.pieces.size()].look.name;
}

void merge_pieces(CombineKind kind, const UiState& ui, DocumentThread& document) {
  assert(ui.clay.pieces);
  edit_piece(MergePiece{ui.clay.pieces->active_piece().look.name, other_piece(ui), kind,
                        ui.pieces.keeps_other},
             document);
}

}  // namespace argil::viewer
