// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/engine/display_surface.h"
#include "argil/engine/sculpture.h"
#include "argil/engine/tool_mesh.h"
#include "argil/io/export.h"
#include "argil/io/session.h"
#include "argil/mesh/check.h"

#include "document/mesh_offer.h"
#include "document/request.h"
#include "picture/renderer.h"

namespace argil::viewer {

// What the document thread reports: copies that any thread may keep.

/// A sentence for the user.
struct Notice {
  enum class Kind { done, warning, error } kind = Kind::done;
  std::string text;
  ErrorKind error = ErrorKind::internal;  ///< of Kind::error
};
inline Notice notice_of(const Error& error) {
  return {Notice::Kind::error, error.message, error.kind};
}

/// A project waits for a decision: a session that was killed left steps beside it, or it has no
/// name and steps beside it that were put aside.
struct LeftQuestion {
  OpenFile asked;      ///< to be sent again, with the decision in OpenFile::left
  io::LeftSteps left;  ///< no steps where they were put aside
};

/// The steps that undo and redo can reach, by name, oldest first.
struct StepNames {
  std::vector<std::string> names;
  std::size_t done = 0;       ///< of these; the others were undone
  std::size_t older = 0;      ///< of these, that are read from the disk when undo comes to them
  bool has_unread = false;    ///< there are others before, whose names are not read yet
  io::HistorySize kept = {};  ///< what lies on the disk for undo
};

/// A mesh to stamp with.
struct Stamp {
  std::string name;
  std::shared_ptr<const ToolMesh> mesh;
};

/// An image to emboss with.
struct Alpha {
  std::string name;
  std::shared_ptr<const AlphaImage> image;
};

/// A piece in the list.
struct PieceState {
  PieceKey key = 0;
  PieceLook look;
  Box3 bounds_mm;  ///< in its own frame, as its last step left it
};

/// The pieces of a sculpture.
struct PieceList {
  std::vector<PieceState> pieces;
  std::size_t active = 0;  ///< of these
  const PieceState& active_piece() const { return pieces[active]; }
};

/// The clay and its document in numbers. What is of one clay is of the active piece.
struct ClayState {
  bool has_clay = false;
  std::int64_t number = 0;       ///< differs from clay to clay; saving under another name keeps it
  std::filesystem::path file;    ///< the project
  bool is_untitled = false;      ///< kept in the home folder until it is saved
  bool is_changed = false;       ///< since it was saved
  int undo_depth = 0;            ///< that memory holds
  bool has_older_steps = false;  ///< and there are others, on the disk
  std::shared_ptr<const StepNames> steps;   ///< null without clay
  std::shared_ptr<const PieceList> pieces;  ///< likewise
  bool has_mask = false;
  bool is_stroke_open = false;
  Box3 bounds_mm;                 ///< in its own frame
  Box3 surface_mm;                ///< likewise, of its surface, as the last step left it
  Box3 all_bounds_mm;             ///< of all visible pieces where they stand
  std::int64_t pieces_added = 0;  ///< so far, as the window shall see at once
  double voxel_mm = 0.0;
  std::vector<LevelStats> levels;
  ClayUse use;
  DisplayStats display;
  std::int64_t dabs = 0;     ///< so far, of all strokes
  std::int64_t strokes = 0;  ///< so far
  std::int64_t changes = 0;  ///< so far: strokes, steps, another clay
  double last_dab_ms = 0.0;  ///< wall time, its surface included
  std::optional<LeftQuestion> left;
  std::shared_ptr<const Stamp> stamp;      ///< the last one that was loaded; null: none
  std::shared_ptr<const Alpha> alpha;      ///< likewise
  std::shared_ptr<const MeshOffer> offer;  ///< the last mesh that was looked at; null: none
};

/// How many steps can be undone, those included that the disk keeps.
inline std::size_t undo_count(const ClayState& state) {
  if (state.has_older_steps && state.steps) return state.steps->done;
  return static_cast<std::size_t>(state.undo_depth);
}

/// Of the piece that strokes go to; nothing without clay.
inline std::optional<PieceKey> active_key(const ClayState& state) {
  if (!state.pieces) return std::nullopt;
  return state.pieces->active_piece().key;
}

/// The verdict on the last CheckPrint or ExportMesh.
struct PrintReport {
  mesh::MeshVerdict verdict;
  std::optional<io::ExportReport> exported;
  std::string printer;
  std::int64_t changes = 0;  ///< ClayState::changes when it was judged
  PieceKey piece = 0;        ///< in whose frame the problems lie
};

/// Long work that is under way.
struct Task {
  bool is_running = false;
  bool has_progress = false;  ///< tells how far it is, and can be stopped
  std::string name;
  double fraction = 0.0;
};

}  // namespace argil::viewer
