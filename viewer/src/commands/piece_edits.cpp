// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/piece_edits.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

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

void follow_marks(const MarkedClay& before, const MarkedClay& now, UiState& ui) {
  std::vector<Drain>& drains = ui.operation.drains;
  std::vector<Vec3>& path = ui.haptics.guidance.path_mm;
  if (drains.empty() && path.empty()) return;
  if (before.surface_mm.empty() || now.surface_mm.empty() || !(before.voxel_mm > 0.0)) return;
  const bool is_same_surface =
      before.surface_mm.min == now.surface_mm.min && before.surface_mm.max == now.surface_mm.max;
  if (now.pieces > before.pieces && !is_same_surface) {
    drains.clear();
    path.clear();
    ui.notices.push_back({Notice::Kind::warning,
                          "the piece was split: its drains and the path of guidance are gone"});
    return;
  }
  // Scaled, the surface has grown as its voxels have; resampled, it is where it was.
  const double factor = now.voxel_mm / before.voxel_mm;
  if (factor == 1.0) return;
  const Vec3 former = before.surface_mm.size();
  const Vec3 size = now.surface_mm.size();
  if (!(length(size - factor * former) < length(size - former))) return;
  for (Drain& drain : drains) drain.point_mm = factor * drain.point_mm;
  for (Vec3& point : path) point = factor * point;
  ui.notices.push_back(
      {Notice::Kind::done,
       "the drains and the path of guidance were scaled with the piece; a drain's width stays"});
}

}  // namespace argil::viewer
