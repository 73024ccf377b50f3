// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "argil/core/vec3.h"

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

/// What tells that drains and the path of guidance, which lie on the active piece in its own frame,
/// no longer lie on it.
struct MarkedClay {
  Box3 surface_mm;  ///< ClayState::surface_mm
  double voxel_mm = 0.0;
  std::size_t pieces = 0;  ///< how many there are
};

/// What was done to the active piece from one state to the other: drains and path are scaled with a
/// piece that is (the width of a drain stays), and cleared where a piece was split. Either is told
/// in UiState::notices. Resampling moves nothing.
void follow_marks(const MarkedClay& before, const MarkedClay& now, UiState& ui);

}  // namespace argil::viewer
