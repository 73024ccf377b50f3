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
  const auto is_there = [&](const PieceState& piece) { return piece.look.name == ui.pieces.other; };
  const bool is_other = ui.pieces.other != list.active_piece().look.name;
  if (is_other && std::any_of(list.pieces.begin(), list.pieces.end(), is_there)) {
    return ui.pieces.other;
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
